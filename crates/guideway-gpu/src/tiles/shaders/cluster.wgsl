// Strokes that lie near each other, and where they are seen.

struct Cluster {
    // Where its coordinates have their origin, in two parts.
    origin_high_m: vec2f,
    origin_low_m: vec2f,
    // The box of its control points, from there.
    low_m: vec2f,
    high_m: vec2f,
    // The greatest width of its strokes; below zero if none has one of its own.
    widest_m: f32,
    // What its points are multiples of; zero if they are exact.
    step_m: f32,
    // Its control points, in their buffer, and its strokes.
    first_point: u32,
    points: u32,
    first_stroke: u32,
    strokes: u32,
}

const CLUSTER_WORDS: u32 = 14u;

// From the middle of the level to the origin of a cluster. Near parts cancel without loss.
fn offset_m(cluster: Cluster) -> vec2f {
    return (cluster.origin_high_m - frame.center_high_m) + (cluster.origin_low_m - frame.center_low_m);
}

// Half the width of its widest stroke, in the picture.
fn widest_px(cluster: Cluster) -> f32 {
    return max(frame.radius_px, radius_px(cluster.widest_m));
}

// Its box in the level: upper left and lower right corner.
fn box_px(cluster: Cluster) -> vec4f {
    let offset = offset_m(cluster);
    let a = level_px(cluster.low_m + offset);
    let b = level_px(cluster.high_m + offset);
    return vec4f(min(a, b), max(a, b));
}
