// Coverage by the nearest line (thesis, 4.3.6). What a pixel remembers from pass to pass is the square of
// its distance in meters, as bits: those of positive numbers are in the order of the numbers.

// Whether edges are smooth.
override SMOOTH: bool;
// Half of what an edge is smoothed over, in pixels.
override HALF_EDGE_PX: f32;

// Farther than any line.
const NOTHING: u32 = 0x7f7fffffu;

fn cover(seen: u32, point_m: vec2f, line_m: vec4f) -> u32 {
    return min(seen, bitcast<u32>(distance_squared(point_m, line_m)));
}

fn is_full(seen: u32) -> bool {
    let inside_m = view.radius_m - select(0.0, HALF_EDGE_PX * view.m_per_px, SMOOTH);
    return inside_m >= 0.0 && bitcast<f32>(seen) <= inside_m * inside_m;
}

fn coverage(seen: u32) -> f32 {
    let distance_px = sqrt(bitcast<f32>(seen)) * view.px_per_m;
    let radius_px = view.radius_m * view.px_per_m;
    if !SMOOTH {
        return select(0.0, 1.0, distance_px <= radius_px);
    }
    // Of both edges: a line thinner than an edge is smooth fades as its area does.
    return edge(distance_px + radius_px) - edge(distance_px - radius_px);
}

fn edge(distance_px: f32) -> f32 {
    return smoothstep(-HALF_EDGE_PX, HALF_EDGE_PX, distance_px);
}
