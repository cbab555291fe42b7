// One thread a tile: reserves a place for its list. It does not matter where.

override THREADS: u32;

@group(0) @binding(1) var<storage, read> counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> lists: array<vec2u>;
@group(0) @binding(3) var<storage, read_write> filled: array<u32>;
@group(0) @binding(4) var<storage, read_write> found: Found;

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
        marked = counts[tile];
        reads(1u);
    }
    // A full tile needs no list.
    let count = select(marked, 0u, (marked & FULL) != 0u);
    let before = atomicAdd(&group_references, count);
    atomicMax(&group_longest, count);
    workgroupBarrier();
    if thread == 0u {
        group_start = atomicAdd(&found.counters.references, atomicLoad(&group_references));
        atomicMax(&found.counters.longest, atomicLoad(&group_longest));
        atomics(2u);
    }
    let start = workgroupUniformLoad(&group_start) + before;
    if is_tile {
        lists[tile] = vec2u(start, start + count);
        filled[tile] = start | (marked & FULL);
        writes(3u);
    }
    report_work();
}
