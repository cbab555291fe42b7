// Coverage from the distance to the nearest line (thesis, 4.3.6). The state of a pixel between
// passes is the squared distance in meters, as bits: bits of positive floats sort like the floats.

// Smooths edges.
override SMOOTH: bool;
// Half the width of a smoothed edge, in pixels.
override HALF_EDGE_PX: f32;

// The state before any line: the largest finite float.
const EMPTY: u32 = 0x7f7fffffu;

fn cover(state: u32, point_m: vec2f, line_m: vec4f) -> u32 {
    return min(state, bitcast<u32>(distance_squared(point_m, line_m)));
}

fn is_full(state: u32) -> bool {
    let inside_m = view.radius_m - select(0.0, HALF_EDGE_PX * view.m_per_px, SMOOTH);
    return inside_m >= 0.0 && bitcast<f32>(state) <= inside_m * inside_m;
}

fn coverage(state: u32) -> f32 {
    let distance_px = sqrt(bitcast<f32>(state)) * view.px_per_m;
    let radius_px = view.radius_m * view.px_per_m;
    if !SMOOTH {
        return select(0.0, 1.0, distance_px <= radius_px);
    }
    // The difference of both edges: a line thinner than a smoothed edge fades with its width.
    return edge(distance_px + radius_px) - edge(distance_px - radius_px);
}

fn edge(distance_px: f32) -> f32 {
    return smoothstep(-HALF_EDGE_PX, HALF_EDGE_PX, distance_px);
}
