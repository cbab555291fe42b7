// One workgroup: where the list of each tile starts.

override THREADS: u32;

@group(0) @binding(1) var<storage, read> counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> starts: array<u32>;
@group(0) @binding(3) var<storage, read_write> filled: array<u32>;
@group(0) @binding(4) var<storage, read_write> found: Counters;

var<workgroup> sums: array<u32, THREADS>;

// A full tile needs no list.
fn count_of(tile: u32) -> u32 {
    return select(counts[tile], 0u, (counts[tile] & FULL) != 0u);
}

@compute @workgroup_size(THREADS)
fn main(@builtin(local_invocation_index) thread: u32) {
    let tiles = frame.columns * frame.rows;
    let share = (tiles + THREADS - 1u) / THREADS;
    let first = min(thread * share, tiles);
    let end = min(first + share, tiles);
    var sum = 0u;
    var longest = 0u;
    for (var tile = first; tile < end; tile++) {
        let count = count_of(tile);
        sum += count;
        longest = max(longest, count);
    }
    atomicMax(&found.longest, longest);
    sums[thread] = sum;
    workgroupBarrier();
    for (var step = 1u; step < THREADS; step *= 2u) {
        var more = 0u;
        if thread >= step {
            more = sums[thread - step];
        }
        workgroupBarrier();
        sums[thread] += more;
        workgroupBarrier();
    }
    var start = sums[thread] - sum;
    for (var tile = first; tile < end; tile++) {
        starts[tile] = start;
        filled[tile] = start | (counts[tile] & FULL);
        start += count_of(tile);
    }
    if thread == THREADS - 1u {
        starts[tiles] = start;
        atomicMax(&found.references, start);
    }
}
