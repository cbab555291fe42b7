// Reserves the list of each tile. The order of the lists does not matter.
//
// Bindings: frame, tile_counts -> tile_lists, list_cursors, counters. One thread per tile.

// import: shared/frame.wgsl
// import: shared/counters.wgsl

override THREADS: u32;

@group(0) @binding(1) var<storage, read> tile_counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> tile_lists: array<vec2u>;
@group(0) @binding(3) var<storage, read_write> list_cursors: array<u32>;
@group(0) @binding(4) var<storage, read_write> counters: CounterBuffer;

var<workgroup> group_references: atomic<u32>;
var<workgroup> group_longest: atomic<u32>;
var<workgroup> group_start: u32;

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        atomicStore(&group_references, 0u);
        atomicStore(&group_longest, 0u);
    }
    workgroupBarrier();
    let tile = workgroup_index(id, group_count) * THREADS + thread;
    let is_tile = tile < frame.columns * frame.rows;
    var marked = 0u;
    if is_tile {
        marked = tile_counts[tile];
        count_reads(1u);
    }
    // A full tile needs no list.
    let count = select(marked, 0u, (marked & FULL) != 0u);
    let before = atomicAdd(&group_references, count);
    atomicMax(&group_longest, count);
    workgroupBarrier();
    if thread == 0u {
        group_start = atomicAdd(&counters.totals.references, atomicLoad(&group_references));
        atomicMax(&counters.totals.longest_list, atomicLoad(&group_longest));
        count_atomics(2u);
    }
    let start = workgroupUniformLoad(&group_start) + before;
    if is_tile {
        tile_lists[tile] = vec2u(start, start + count);
        list_cursors[tile] = start | (marked & FULL);
        count_writes(3u);
    }
    report_work();
}
