// The form that the thesis means: every pixel walks alone, and tests each line of a segment.

fn synchronize() {}

fn count_bytes(pixel: ptr<function, Pixel>, bytes: u32) {
    if COUNT {
        (*pixel).bytes += bytes;
    }
}

fn cover_segment(pixel: ptr<function, Pixel>, segment: u32) {
    count_bytes(pixel, 44u);
    let curve = curve_of(segment);
    let rank = segments[segment].y;
    var start_m = end_of_line(curve, 0u);
    for (var i = 1u; i <= LINES; i++) {
        let end_m = end_of_line(curve, i);
        test_line(pixel, vec4f(start_m, end_m), rank);
        start_m = end_m;
    }
    if EXIT {
        (*pixel).floor = floor_of(pixel);
    }
}

@compute @workgroup_size(TILE_PX, TILE_PX)
fn main(
    @builtin(workgroup_id) workgroup: vec3u,
    @builtin(num_workgroups) workgroups: vec3u,
    @builtin(local_invocation_id) thread: vec3u,
) {
    let tile = view.first_tile + workgroup.y * workgroups.x + workgroup.x;
    if tile >= view.end_tile {
        return;
    }
    var pixel = pixel_of(tile, thread.xy);
    if pixel.is_inside {
        draw(&pixel, pixel.index, pixel.point_m, pixel.point_m);
    }
}
