// A workgroup sorts the list of one tile by draw rank, the highest first (Batcher's bitonic sort in the form
// in which all comparisons point the same way, so that a list of any length behaves as if it ended in
// entries that never move).

override THREADS: u32;

@group(0) @binding(1) var<storage, read> lists: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> references: array<u32>;
@group(0) @binding(3) var<storage, read> line_ranks: array<u32>;
@group(0) @binding(4) var<storage, read_write> found: Found;

// Of a list that is short, with ranks near each other: how far each rank is above the lowest, and its place
// in the list in the lowest bits.
const SHORT: u32 = 1u << PLACE_BITS;
const MOST_ABOVE: u32 = 0xffffffffu >> PLACE_BITS;
var<workgroup> keys: array<u32, SHORT>;
var<workgroup> lowest: atomic<u32>;
var<workgroup> highest: atomic<u32>;
var<workgroup> ends: vec2u;

// The lowest and the highest rank of a short list, whose keys are its ranks from here on.
fn load_ranks(thread: u32, start: u32, count: u32) -> vec2u {
    if thread == 0u {
        atomicStore(&lowest, 0xffffffffu);
        atomicStore(&highest, 0u);
    }
    workgroupBarrier();
    for (var i = thread; i < count; i += THREADS) {
        let rank = line_ranks[references[start + i]];
        reads(2u);
        keys[i] = rank;
        atomicMin(&lowest, rank);
        atomicMax(&highest, rank);
    }
    workgroupBarrier();
    if thread == 0u {
        ends = vec2u(atomicLoad(&lowest), atomicLoad(&highest));
    }
    return workgroupUniformLoad(&ends);
}

fn order_keys(low: u32, high: u32) {
    let a = keys[low];
    let b = keys[high];
    if a < b {
        keys[low] = b;
        keys[high] = a;
    }
}

fn order_references(low: u32, high: u32) {
    let a = references[low];
    let b = references[high];
    reads(4u);
    if line_ranks[a] < line_ranks[b] {
        references[low] = b;
        references[high] = a;
        writes(2u);
    }
}

// Brings the references of a short list into the order of its keys.
fn follow_keys(thread: u32, start: u32, count: u32) {
    var held: array<u32, SHORT / 64u>;
    var number = 0u;
    for (var i = thread; i < count; i += THREADS) {
        held[number] = references[start + (keys[i] & (SHORT - 1u))];
        reads(1u);
        number++;
    }
    storageBarrier();
    number = 0u;
    for (var i = thread; i < count; i += THREADS) {
        references[start + i] = held[number];
        writes(1u);
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
    let start = lists[index].x;
    let end = lists[index].y;
    if thread == 0u {
        reads(2u);
    }
    let count = end - start;
    if end > frame.reference_room || count <= 1u << ABOVE_BITS || (!TAKES_ALL && count > SHORT) {
        report_work();
        return;
    }
    var is_short = count <= SHORT;
    if is_short {
        let ranks = load_ranks(thread, start, count);
        is_short = ranks.y - ranks.x <= MOST_ABOVE;
        for (var i = thread; is_short && i < count; i += THREADS) {
            keys[i] = ((keys[i] - ranks.x) << PLACE_BITS) | i;
        }
        workgroupBarrier();
    }
    // Blocks of two to the power of `block`, steps likewise.
    for (var block = 1u; (1u << (block - 1u)) < count; block++) {
        // The first half of a block against the mirrored second half, then ever closer pairs.
        for (var step = block; step > 0u; step--) {
            let half = 1u << (step - 1u);
            for (var pair = thread; pair * 2u < count + (1u << block); pair += THREADS) {
                let low = ((pair & ~(half - 1u)) << 1u) | (pair & (half - 1u));
                let high = select(low + half, low ^ ((1u << block) - 1u), step == block);
                if high < count {
                    if is_short {
                        order_keys(low, high);
                    } else {
                        order_references(start + low, start + high);
                    }
                }
            }
            workgroupBarrier();
            if !is_short {
                storageBarrier();
            }
        }
    }
    if is_short {
        follow_keys(thread, start, count);
    }
    report_work();
}
