// Phase 3 as in the thesis (4.3.4, figure 4.6): every cell sums all cells before it. The parts of
// `items` are ranges of these cells.

@group(0) @binding(1) var<storage, read> counts: array<u32>;
@group(0) @binding(2) var<storage, read_write> starts: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let cell = item_of(workgroup, workgroups, thread);
    if cell >= items.end {
        return;
    }
    var sum = 0u;
    for (var before = items.first_part; before < min(cell, items.end_part); before++) {
        sum += counts[before];
    }
    starts[cell] += sum;
}
