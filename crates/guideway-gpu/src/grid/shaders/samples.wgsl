// Coverage by sub-samples (thesis, 6.1.2). What a pixel remembers from chunk to chunk is a bit for each of
// its samples: whether a line covers it.

// Half of a pixel's diagonal.
const CORNER_PX: f32 = 0.70711;

const NOTHING: u32 = 0u;
const ALL: u32 = 0xffffffffu;

// One sample in each of 32 columns and of 32 rows: the points of Hammersley. In pixels from the middle.
fn sample_px(i: u32) -> vec2f {
    return (vec2f(vec2u(i, reverseBits(i) >> 27u)) + 0.5) / 32.0 - 0.5;
}

fn cover(seen: u32, point_m: vec2f, line_m: vec4f) -> u32 {
    let apart_squared = distance_squared(point_m, line_m);
    let outside_m = view.radius_m + CORNER_PX * view.m_per_px;
    if apart_squared > outside_m * outside_m {
        return seen;
    }
    let inside_m = view.radius_m - CORNER_PX * view.m_per_px;
    if inside_m > 0.0 && apart_squared <= inside_m * inside_m {
        return ALL;
    }
    var covered = seen;
    for (var i = 0u; i < 32u; i++) {
        let sample_m = point_m + sample_px(i) * view.m_per_px;
        let is_covered = distance_squared(sample_m, line_m) <= view.radius_m * view.radius_m;
        covered |= select(0u, 1u, is_covered) << i;
    }
    return covered;
}

fn is_full(seen: u32) -> bool {
    return seen == ALL;
}

fn coverage(seen: u32) -> f32 {
    return f32(countOneBits(seen)) / 32.0;
}
