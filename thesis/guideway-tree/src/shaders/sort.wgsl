// One digit of a stable radix sort of keys with their segments (Satish, Harris and Garland 2009).
// Each workgroup sorts a block by the digit, bit by bit. The first run counts the keys per digit
// and block; after a scan of the counts the second one moves the keys.

// Threads per workgroup: one per key of a block.
override SORT_THREADS: u32;
override MOVES: bool;

const DIGITS: u32 = 16u;
const DIGIT_BITS: u32 = 4u;

struct Digit {
    keys: u32,
    shift: u32,
    blocks: u32,
}

@group(0) @binding(0) var<uniform> digit: Digit;
@group(0) @binding(1) var<storage, read> keys: array<u32>;
@group(0) @binding(2) var<storage, read> order: array<u32>;
// Per digit and block: the number of keys, or the place of the first one.
@group(0) @binding(3) var<storage, read_write> blocks: array<u32>;
@group(0) @binding(4) var<storage, read_write> sorted_keys: array<u32>;
@group(0) @binding(5) var<storage, read_write> sorted_order: array<u32>;

var<workgroup> shared_keys: array<u32, SORT_THREADS>;
var<workgroup> shared_order: array<u32, SORT_THREADS>;
var<workgroup> sums: array<u32, SORT_THREADS>;
// Places of the first and one past the last key of each digit in the block.
var<workgroup> starts: array<u32, DIGITS>;
var<workgroup> ends: array<u32, DIGITS>;

@compute @workgroup_size(SORT_THREADS)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let block = workgroup.y * workgroups.x + workgroup.x;
    let first = block * SORT_THREADS;
    if block >= digit.blocks {
        return;
    }
    let count = min(digit.keys - first, SORT_THREADS);
    // Threads without a key have the highest one and stay behind all others.
    var key = 0xffffffffu;
    var segment = 0u;
    if thread < count {
        key = keys[first + thread];
        segment = order[first + thread];
    }
    if thread < DIGITS {
        starts[thread] = 0u;
        ends[thread] = 0u;
    }
    for (var bit = 0u; bit < DIGIT_BITS; bit++) {
        let is_zero = 1u - ((key >> (digit.shift + bit)) & 1u);
        sums[thread] = is_zero;
        workgroupBarrier();
        var sum = is_zero;
        for (var step = 1u; step < SORT_THREADS; step *= 2u) {
            if thread >= step {
                sum += sums[thread - step];
            }
            workgroupBarrier();
            sums[thread] = sum;
            workgroupBarrier();
        }
        let zeros = sums[SORT_THREADS - 1u];
        let place = select(zeros + thread - sum, sum - is_zero, is_zero == 1u);
        shared_keys[place] = key;
        shared_order[place] = segment;
        workgroupBarrier();
        key = shared_keys[thread];
        segment = shared_order[thread];
        workgroupBarrier();
    }
    let own = (key >> digit.shift) & (DIGITS - 1u);
    if thread < count {
        if thread == 0u || ((shared_keys[thread - 1u] >> digit.shift) & (DIGITS - 1u)) != own {
            starts[own] = thread;
        }
        let next = min(thread + 1u, SORT_THREADS - 1u);
        let next_digit = (shared_keys[next] >> digit.shift) & (DIGITS - 1u);
        if thread + 1u == count || next_digit != own {
            ends[own] = thread + 1u;
        }
    }
    workgroupBarrier();
    if MOVES {
        if thread < count {
            let place = blocks[own * digit.blocks + block] + thread - starts[own];
            sorted_keys[place] = key;
            sorted_order[place] = segment;
        }
    } else if thread < DIGITS {
        blocks[thread * digit.blocks + block] = ends[thread] - starts[thread];
    }
}
