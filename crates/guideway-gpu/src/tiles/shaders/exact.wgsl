// Control points of two floats each. Where they are those of clusters seen from near, each cluster has a word first.

@group(0) @binding(2) var<storage, read> points: array<vec2u>;

// The stroke that a thread works on: where its control points begin, and from the middle of the level to the origin that
// they count from.
struct Curve {
    first_point: u32,
    offset_m: vec2f,
}

fn curve_of(cluster: Cluster, first_point: u32) -> Curve {
    return Curve(first_point, offset_m(cluster));
}

fn clusters_of_kind() -> u32 {
    return atomicLoad(&found.counters.exact);
}

fn cluster_of_kind(number: u32) -> u32 {
    return found.places[frame.clusters - 1u - number].seen;
}

// Where the points of a cluster begin; of one seen from near zero if they are not there.
fn first_point_of_cluster(cluster: Cluster, index: u32) -> u32 {
    if chunk.is_near == 0u {
        return cluster.first_point;
    }
    reads(1u);
    return points[index / 2u][index % 2u];
}

// Read anew each time: caches hold them, and a workgroup that shared them would leave room for few others.
fn control_px(curve: Curve, index: u32) -> vec2f {
    reads(2u);
    return level_px(bitcast<vec2f>(points[curve.first_point + index]) + curve.offset_m);
}
