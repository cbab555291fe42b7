// Phase 4 (thesis, 4.3.5): copies every line into the lists of its cells.

@group(0) @binding(3) var<storage, read> starts: array<u32>;
// Lines per list so far.
@group(0) @binding(4) var<storage, read_write> filled: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read_write> lists_m: array<vec4f>;

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
    let line_m = lines_m[line];
    let cells = cells_of(line_m);
    for (var y = cells.low.y; y <= cells.high.y; y++) {
        for (var x = cells.low.x; x <= cells.high.x; x++) {
            let cell = y * CELLS + x;
            lists_m[starts[cell] + atomicAdd(&filled[cell], 1u)] = line_m;
        }
    }
}
