// Control points in steps of their cluster, two numbers of 16 bits in a word.

@group(0) @binding(2) var<storage, read> points: array<u32>;

// The stroke that a thread works on: where its control points begin, and in pixels of the level the origin and the steps of its cluster.
struct Curve {
    first_point: u32,
    origin_px: vec2f,
    step_px: vec2f,
}

fn curve_of(cluster: Cluster, first_point: u32) -> Curve {
    return Curve(first_point, level_px(offset_m(cluster)), level_px(vec2f(cluster.step_m)));
}

fn clusters_of_kind() -> u32 {
    return atomicLoad(&found.counters.rounded);
}

fn cluster_of_kind(number: u32) -> u32 {
    return found.places[number].seen;
}

// Where the points of a cluster begin.
fn first_point_of_cluster(cluster: Cluster, index: u32) -> u32 {
    return cluster.first_point;
}

// Read anew each time: caches hold them, and a workgroup that shared them would leave room for few others.
fn control_px(curve: Curve, index: u32) -> vec2f {
    let word = bitcast<i32>(points[curve.first_point + index]);
    reads(1u);
    let steps = vec2i(word << 16u, word) >> vec2u(16u);
    return curve.origin_px + curve.step_px * vec2f(steps);
}
