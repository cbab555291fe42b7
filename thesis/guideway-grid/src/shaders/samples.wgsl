// Coverage from 32 samples per pixel (thesis, 6.1.2). The state of a pixel between passes is one
// bit per sample, set when a line covers it.

// derived: half the diagonal of a pixel, rounded up.
const CORNER_PX: f32 = 0.70711;

const EMPTY: u32 = 0u;
const ALL: u32 = 0xffffffffu;

fn cover(state: u32, point_m: vec2f, line_m: vec4f) -> u32 {
    let squared = distance_squared(point_m, line_m);
    let outside_m = view.radius_m + CORNER_PX * view.m_per_px;
    if squared > outside_m * outside_m {
        return state;
    }
    let inside_m = view.radius_m - CORNER_PX * view.m_per_px;
    if inside_m > 0.0 && squared <= inside_m * inside_m {
        return ALL;
    }
    let along_m = line_m.zw - line_m.xy;
    let length_squared = max(dot(along_m, along_m), MIN_LENGTH_SQUARED);
    let line = Line(point_m - line_m.xy, along_m, length_squared);
    // Unrolled: an inner loop would count towards the iteration limit of a thread.
    return state | four_samples(line, 0u) | four_samples(line, 4u)
        | four_samples(line, 8u) | four_samples(line, 12u)
        | four_samples(line, 16u) | four_samples(line, 20u)
        | four_samples(line, 24u) | four_samples(line, 28u);
}

// A line relative to a pixel.
struct Line {
    // From the start of the line to the center of the pixel.
    from_start_m: vec2f,
    along_m: vec2f,
    length_squared: f32,
}

// The bits of the four samples from `first` on. The samples are Hammersley points: one in each of
// 32 columns and 32 rows of the pixel.
fn four_samples(line: Line, first: u32) -> u32 {
    let i = first + vec4u(0u, 1u, 2u, 3u);
    let x = line.from_start_m.x + ((vec4f(i) + 0.5) / 32.0 - 0.5) * view.m_per_px;
    let row = vec4f(reverseBits(i) >> vec4u(27u));
    let y = line.from_start_m.y + ((row + 0.5) / 32.0 - 0.5) * view.m_per_px;
    let along = x * line.along_m.x + y * line.along_m.y;
    let fraction = clamp(along / line.length_squared, vec4f(0.0), vec4f(1.0));
    let offset_x = x - line.along_m.x * fraction;
    let offset_y = y - line.along_m.y * fraction;
    let offset_squared = offset_x * offset_x + offset_y * offset_y;
    let is_covered = offset_squared <= vec4f(view.radius_m * view.radius_m);
    return dot(select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), is_covered), vec4u(1u)) << first;
}

fn is_full(state: u32) -> bool {
    return state == ALL;
}

fn coverage(state: u32) -> f32 {
    return f32(countOneBits(state)) / 32.0;
}
