// Sorts tile lists by falling draw rank: Batcher's bitonic sort with all comparisons in the same
// direction, so that a list of any length behaves as if padded with entries that never move.
//
// Bindings: frame, tile_lists, line_ranks -> references, counters. One workgroup per tile; a thread
// compares every THREADS-th pair. Sorts lists of more than 2^MIN_COUNT_BITS lines, and those of
// more than 2^INDEX_BITS only with SORTS_LONG_LISTS.

// import: shared/frame.wgsl
// import: shared/counters.wgsl

override THREADS: u32;

@group(0) @binding(1) var<storage, read> tile_lists: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> references: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read_write> counters: CounterBuffer;

// Keys of a short list: the rank relative to the lowest, and the list index in the low INDEX_BITS.
const MAX_SHARED_KEYS: u32 = 1u << INDEX_BITS;
const MAX_RANK_SPAN: u32 = 0xffffffffu >> INDEX_BITS;
var<workgroup> keys: array<u32, MAX_SHARED_KEYS>;
var<workgroup> lowest: atomic<u32>;
var<workgroup> highest: atomic<u32>;
var<workgroup> rank_range: vec2u;

// Loads the ranks of a short list as keys. Returns the lowest and the highest.
fn load_ranks(thread: u32, start: u32, count: u32) -> vec2u {
    if thread == 0u {
        atomicStore(&lowest, 0xffffffffu);
        atomicStore(&highest, 0u);
    }
    workgroupBarrier();
    for (var i = thread; i < count; i += THREADS) {
        let rank = line_ranks[references[start + i]];
        count_reads(2u);
        keys[i] = rank;
        atomicMin(&lowest, rank);
        atomicMax(&highest, rank);
    }
    workgroupBarrier();
    if thread == 0u {
        rank_range = vec2u(atomicLoad(&lowest), atomicLoad(&highest));
    }
    return workgroupUniformLoad(&rank_range);
}

fn swap_keys(low: u32, high: u32) {
    let a = keys[low];
    let b = keys[high];
    if a < b {
        keys[low] = b;
        keys[high] = a;
    }
}

fn swap_references(low: u32, high: u32) {
    let a = references[low];
    let b = references[high];
    count_reads(4u);
    if line_ranks[a] < line_ranks[b] {
        references[low] = b;
        references[high] = a;
        count_writes(2u);
    }
}

// Permutes the references of a short list into the order of its keys.
fn permute_references(thread: u32, start: u32, count: u32) {
    var held: array<u32, MAX_SHARED_KEYS / 64u>;
    var number = 0u;
    for (var i = thread; i < count; i += THREADS) {
        held[number] = references[start + (keys[i] & (MAX_SHARED_KEYS - 1u))];
        count_reads(1u);
        number++;
    }
    storageBarrier();
    number = 0u;
    for (var i = thread; i < count; i += THREADS) {
        references[start + i] = held[number];
        count_writes(1u);
        number++;
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, group_count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let start = tile_lists[index].x;
    let end = tile_lists[index].y;
    if thread == 0u {
        count_reads(2u);
    }
    let count = end - start;
    let is_skipped = !SORTS_LONG_LISTS && count > MAX_SHARED_KEYS;
    if end > frame.reference_capacity || count <= 1u << MIN_COUNT_BITS || is_skipped {
        report_work();
        return;
    }
    var has_keys = count <= MAX_SHARED_KEYS;
    if has_keys {
        let ranks = load_ranks(thread, start, count);
        has_keys = ranks.y - ranks.x <= MAX_RANK_SPAN;
        for (var i = thread; has_keys && i < count; i += THREADS) {
            keys[i] = ((keys[i] - ranks.x) << INDEX_BITS) | i;
        }
        workgroupBarrier();
    }
    // Blocks have 2^block entries, steps likewise.
    for (var block = 1u; (1u << (block - 1u)) < count; block++) {
        // First half of a block against the mirrored second half, then ever closer pairs.
        for (var step = block; step > 0u; step--) {
            let half = 1u << (step - 1u);
            for (var pair = thread; pair * 2u < count + (1u << block); pair += THREADS) {
                let low = ((pair & ~(half - 1u)) << 1u) | (pair & (half - 1u));
                let high = select(low + half, low ^ ((1u << block) - 1u), step == block);
                if high < count {
                    if has_keys {
                        swap_keys(low, high);
                    } else {
                        swap_references(start + low, start + high);
                    }
                }
            }
            workgroupBarrier();
            if !has_keys {
                storageBarrier();
            }
        }
    }
    if has_keys {
        permute_references(thread, start, count);
    }
    report_work();
}
