// A cluster: up to 64 neighboring strokes with a common origin. Rust: `Cluster`.

// import: shared/frame.wgsl
// import: shared/view.wgsl

struct Cluster {
    // Origin of its coordinates, split into two floats.
    origin_high_m: vec2f,
    origin_low_m: vec2f,
    // Bounding box of its control points, relative to the origin.
    low_m: vec2f,
    high_m: vec2f,
    // Greatest width of its strokes; negative if none has its own.
    widest_m: f32,
    // Quantization step of its points as they are shown; 0 if they are exact.
    step_m: f32,
    // Its range of control points in their buffer, and its range of strokes.
    first_point: u32,
    points: u32,
    first_stroke: u32,
    strokes: u32,
    // Quantization step of its points as they are stored.
    stored_step_m: f32,
    // 1 if the map of a gesture turns, mirrors or scales its points about the origin.
    is_mapped: u32,
}

const CLUSTER_WORDS: u32 = 16u;

// Frames without such a map compile it away.
override MAPS: bool = false;

// Returns whether the map of a gesture turns the points of a cluster.
fn is_turned(is_mapped: u32) -> bool {
    return MAPS && is_mapped != 0u;
}

// Maps a vector from the origin of a cluster to where a gesture shows it.
fn shown_vector(is_mapped: u32, v: vec2f) -> vec2f {
    if is_turned(is_mapped) {
        return rounded2(frame.map_x * v.x) + rounded2(frame.map_y * v.y);
    }
    return v;
}

// Vector from the LOD center to the origin of a cluster. Subtracting the high parts is exact.
fn cluster_offset_m(cluster: Cluster) -> vec2f {
    return (cluster.origin_high_m - frame.center_high_m)
        + (cluster.origin_low_m - frame.center_low_m);
}

// Greatest radius of its strokes in picture pixels.
fn cluster_radius_px(cluster: Cluster) -> f32 {
    return max(frame.radius_px, radius_px(cluster.widest_m));
}

// Its box in LOD pixels: minimum and maximum corner.
fn cluster_box_px(cluster: Cluster) -> vec4f {
    let offset = cluster_offset_m(cluster);
    let a = lod_from_m(cluster.low_m + offset);
    let b = lod_from_m(cluster.high_m + offset);
    return vec4f(min(a, b), max(a, b));
}
