// Control points of two floats each. In the buffer for near views one word per cluster precedes
// them: the index of its first point. Variant `exact` of the points interface; the other is
// `points_rounded.wgsl`.

// import: flatten/bindings.wgsl

@group(0) @binding(2) var<storage, read> points: array<vec2u>;

// A stroke: its first control point, the vector from the LOD center to its cluster's
// origin, and the flag of its cluster.
struct Curve {
    first_point: u32,
    cluster_offset_m: vec2f,
    is_mapped: u32,
}

fn stroke_curve(cluster: Cluster, first_point: u32) -> Curve {
    return Curve(first_point, cluster_offset_m(cluster), cluster.is_mapped);
}

fn visible_cluster_count() -> u32 {
    return atomicLoad(&counters.totals.exact_clusters);
}

fn visible_cluster(number: u32) -> u32 {
    return counters.clusters[frame.clusters - 1u - number].visible;
}

// First control point of a cluster; 0 if a near cluster has no exact points on the device.
fn cluster_first_point(cluster: Cluster, index: u32) -> u32 {
    if dispatch.is_near == 0u {
        return cluster.first_point;
    }
    count_reads(1u);
    return points[index / 2u][index % 2u];
}

// Read again each time: caches hold the points, and workgroup memory would lower the occupancy.
fn control_px(curve: Curve, index: u32) -> vec2f {
    count_reads(2u);
    let local_m = bitcast<vec2f>(points[curve.first_point + index]);
    return lod_from_m(shown_vector(curve.is_mapped, local_m) + curve.cluster_offset_m);
}
