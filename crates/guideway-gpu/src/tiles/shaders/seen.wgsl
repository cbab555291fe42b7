// Which clusters lines are made of.

override WORKGROUP: u32;

@group(0) @binding(1) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(2) var<storage, read_write> found: Found;

// Lists a cluster if lines are made of it, by the points that it is drawn from.
fn list_cluster(index: u32) {
    let cluster = clusters[index];
    reads(CLUSTER_WORDS);
    if is_made(box_px(cluster), reach_of(widest_px(cluster))) {
        if cluster.step_m > 0.0 && cluster.step_m <= frame.most_step_m {
            found.places[atomicAdd(&found.counters.rounded, 1u)].seen = index;
        } else {
            found.places[frame.clusters - 1u - atomicAdd(&found.counters.exact, 1u)].seen = index;
        }
        atomics(1u);
        writes(1u);
    }
}
