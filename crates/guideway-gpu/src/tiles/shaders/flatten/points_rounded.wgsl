// Control points quantized to the step of their cluster: two signed 16-bit numbers per word.
// Variant `rounded` of the points interface; the other is `points_exact.wgsl`.

// import: flatten/bindings.wgsl

@group(0) @binding(2) var<storage, read> points: array<u32>;

// A stroke: its first control point, and its cluster's origin and step in LOD pixels.
struct Curve {
    first_point: u32,
    origin_px: vec2f,
    step_px: vec2f,
    is_mapped: u32,
}

fn stroke_curve(cluster: Cluster, first_point: u32) -> Curve {
    let origin_px = lod_from_m(cluster_offset_m(cluster));
    let step_px = lod_from_m(vec2f(cluster.stored_step_m));
    return Curve(first_point, origin_px, step_px, cluster.is_mapped);
}

fn visible_cluster_count() -> u32 {
    return atomicLoad(&counters.totals.rounded_clusters);
}

fn visible_cluster(number: u32) -> u32 {
    return counters.clusters[number].visible;
}

// First control point of a cluster.
fn cluster_first_point(cluster: Cluster, index: u32) -> u32 {
    return cluster.first_point;
}

// Read again each time: caches hold the points, and workgroup memory would lower the occupancy.
fn control_px(curve: Curve, index: u32) -> vec2f {
    let word = bitcast<i32>(points[curve.first_point + index]);
    count_reads(1u);
    let steps = vec2i(word << 16u, word) >> vec2u(16u);
    return curve.origin_px + curve.step_px * shown_vector(curve.is_mapped, vec2f(steps));
}
