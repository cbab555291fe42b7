// Phase 1 (thesis, 4.3.2): splits every segment into lines between uniform samples.

// Lines per segment.
override LINES: u32;

@group(0) @binding(1) var<storage, read> points_m: array<vec2f>;
// Index of the first of the four control points of each segment.
@group(0) @binding(2) var<storage, read> first_points: array<u32>;
@group(0) @binding(3) var<storage, read_write> line_count: atomic<u32>;
// Start and end of each line.
@group(0) @binding(4) var<storage, read_write> lines_m: array<vec4f>;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let segment = item_of(workgroup, workgroups, thread);
    if segment >= items.end {
        return;
    }
    let first = first_points[segment];
    // Relative to one control point, rounding scales with the segment and not with the scene.
    let base_m = points_m[first + 1u];
    let p0 = points_m[first] - base_m;
    let p2 = points_m[first + 2u] - base_m;
    let p3 = points_m[first + 3u] - base_m;

    let first_line = atomicAdd(&line_count, LINES);
    var start_m = base_m + point(p0, p2, p3, 0.0);
    for (var i = 0u; i < LINES; i++) {
        let end_m = base_m + point(p0, p2, p3, f32(i + 1u) / f32(LINES));
        lines_m[first_line + i] = vec4f(start_m, end_m);
        start_m = end_m;
    }
}
