// Control points quantized to the step of their cluster: two signed 16-bit numbers per word.
// Variant `rounded` of the points interface; the other is `points_exact.wgsl`.

// import: flatten/bindings.wgsl

@group(0) @binding(2) var<storage, read> points: array<u32>;

// A stroke: its first control point, and the place of its cluster. Numbers of steps count from the
// lowest, so that a clamp to 0..1 of their share of the cluster's span rounds products.
struct Curve {
    first_point: u32,
    // The point whose numbers are lowest; the origin if a gesture turns the cluster.
    low_px: vec2f,
    // A power of two, above the size of 2^16 steps in LOD pixels; and one step as a share of it.
    span_px: f32,
    step: f32,
    is_mapped: u32,
}

// The lowest number of steps.
const LOWEST: f32 = -32768.0;

fn stroke_curve(cluster: Cluster, first_point: u32) -> Curve {
    let step_px = rounded(cluster.stored_step_m * frame.lod_px_per_m);
    let exponent = bitcast<u32>(step_px) & 0x7f800000u;
    let span_px = bitcast<f32>(exponent + (17u << 23u));
    let step = exact(step_px * bitcast<f32>(0x7f000000u - bitcast<u32>(span_px)));
    var low_px = lod_from_m(cluster_offset_m(cluster));
    if !is_turned(cluster.is_mapped) {
        low_px += exact2(vec2f(LOWEST, -LOWEST) * step_px);
    }
    return Curve(first_point, low_px, span_px, step, cluster.is_mapped);
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
    let word = points[curve.first_point + index] ^ 0x80008000u;
    count_reads(1u);
    let numbers = vec2f(vec2u(word & 0xffffu, word >> 16u));
    if is_turned(curve.is_mapped) {
        let shown = shown_vector(curve.is_mapped, numbers + LOWEST);
        let step_px = curve.step * curve.span_px;
        return curve.low_px + rounded2(vec2f(shown.x, -shown.y) * step_px);
    }
    let shares = clamp(numbers * curve.step, vec2f(0.0), vec2f(1.0));
    return curve.low_px + exact2(shares * vec2f(curve.span_px, -curve.span_px));
}
