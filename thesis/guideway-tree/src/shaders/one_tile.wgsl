// The pixels of a tile walk together: all threads of a workgroup read the same nodes, compute the
// lines of a segment together, and test them each for its own pixel.

// Longest possible: 63 lines per segment.
var<workgroup> ends_m: array<vec2f, 64>;
// Ranks below which all pixels are covered, for segments in turn: while one is in use, the other
// is reset.
var<workgroup> floors: array<atomic<u32>, 2>;

fn synchronize() {
    workgroupBarrier();
}

// Once per tile.
fn count_bytes(pixel: ptr<function, Pixel>, bytes: u32) {
    if COUNT && (*pixel).thread == 0u {
        (*pixel).bytes += bytes;
    }
}

fn cover_segment(pixel: ptr<function, Pixel>, segment: u32) {
    count_bytes(pixel, 44u);
    let thread = (*pixel).thread;
    if thread <= LINES {
        ends_m[thread] = end_of_line(curve_of(segment), thread);
    }
    workgroupBarrier();
    let turn = (*pixel).covered_segments & 1u;
    (*pixel).covered_segments += 1u;
    if (*pixel).is_inside {
        let rank = segments[segment].y;
        for (var i = 0u; i < LINES; i++) {
            test_line(pixel, vec4f(ends_m[i], ends_m[i + 1u]), rank);
        }
        if EXIT {
            atomicMin(&floors[turn], floor_of(pixel));
        }
    }
    if EXIT && thread == 0u {
        atomicStore(&floors[1u - turn], FULL);
    }
    workgroupBarrier();
    if EXIT {
        (*pixel).floor = atomicLoad(&floors[turn]);
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
    if pixel.thread == 0u {
        atomicStore(&floors[0], FULL);
    }
    // Rows of pixels go down, world coordinates up.
    let corner = pixel_of(tile, vec2u(0u));
    let opposite = pixel_of(tile, vec2u(TILE_PX - 1u));
    let low_m = vec2f(corner.point_m.x, opposite.point_m.y);
    let high_m = vec2f(opposite.point_m.x, corner.point_m.y);
    draw(&pixel, corner.index, low_m, high_m);
}
