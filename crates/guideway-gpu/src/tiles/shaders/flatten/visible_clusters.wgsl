// Appends a cluster to the list of visible clusters.

// import: shared/frame.wgsl
// import: shared/counters.wgsl
// import: shared/view.wgsl
// import: flatten/cluster.wgsl

override THREADS: u32;

@group(0) @binding(1) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(2) var<storage, read_write> counters: CounterBuffer;

// Appends a cluster if it intersects the area to flatten: clusters drawn from rounded points to the
// front of the slots, the others to the back.
fn append_visible_cluster(index: u32) {
    let cluster = clusters[index];
    count_reads(CLUSTER_WORDS);
    if intersects_flatten_area(cluster_box_px(cluster), lod_reach(cluster_radius_px(cluster))) {
        if cluster.step_m > 0.0 && cluster.step_m <= frame.max_step_m {
            let slot = atomicAdd(&counters.totals.rounded_clusters, 1u);
            counters.clusters[slot].visible = index;
        } else {
            let slot = frame.clusters - 1u - atomicAdd(&counters.totals.exact_clusters, 1u);
            counters.clusters[slot].visible = index;
        }
        count_atomics(1u);
        count_writes(1u);
    }
}
