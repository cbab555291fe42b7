// Phase 2 (thesis, 4.3.3): counts the lines of each cell.

@group(0) @binding(3) var<storage, read_write> counts: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let line = item_of(workgroup, workgroups, thread);
    if line >= items.end {
        return;
    }
    let cells = cells_of(lines_m[line]);
    for (var y = cells.low.y; y <= cells.high.y; y++) {
        for (var x = cells.low.x; x <= cells.high.x; x++) {
            atomicAdd(&counts[y * CELLS + x], 1u);
        }
    }
}
