// Coverage by sub-samples (thesis, 6.1.2). What a pixel remembers from pass to pass is a bit for each of
// its samples: whether a line covers it.

// Half of a pixel's diagonal.
const CORNER_PX: f32 = 0.70711;

const NOTHING: u32 = 0u;
const ALL: u32 = 0xffffffffu;

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
    let along_m = line_m.zw - line_m.xy;
    let length_squared = max(dot(along_m, along_m), LEAST_SQUARED);
    let line = Line(point_m - line_m.xy, along_m, length_squared);
    // Written out: a loop in a loop would count as the outer one's rounds.
    return seen | four(line, 0u) | four(line, 4u) | four(line, 8u) | four(line, 12u)
        | four(line, 16u) | four(line, 20u) | four(line, 24u) | four(line, 28u);
}

// A line as a pixel sees it.
struct Line {
    // From its start to the middle of the pixel.
    from_start_m: vec2f,
    along_m: vec2f,
    length_squared: f32,
}

// The bits of four samples from `first` on. There is one sample in each of 32 columns and of 32 rows: the
// points of Hammersley.
fn four(line: Line, first: u32) -> u32 {
    let i = first + vec4u(0u, 1u, 2u, 3u);
    let x = line.from_start_m.x + ((vec4f(i) + 0.5) / 32.0 - 0.5) * view.m_per_px;
    let y = line.from_start_m.y + ((vec4f(reverseBits(i) >> vec4u(27u)) + 0.5) / 32.0 - 0.5) * view.m_per_px;
    let along = x * line.along_m.x + y * line.along_m.y;
    let fraction = clamp(along / line.length_squared, vec4f(0.0), vec4f(1.0));
    let apart_x = x - line.along_m.x * fraction;
    let apart_y = y - line.along_m.y * fraction;
    let apart_squared = apart_x * apart_x + apart_y * apart_y;
    let is_covered = apart_squared <= vec4f(view.radius_m * view.radius_m);
    return dot(select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), is_covered), vec4u(1u)) << first;
}

fn is_full(seen: u32) -> bool {
    return seen == ALL;
}

fn coverage(seen: u32) -> f32 {
    return f32(countOneBits(seen)) / 32.0;
}
