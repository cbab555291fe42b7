// Culls clusters: lists those that intersect the area to flatten, and clears their line blocks.
//
// Bindings: frame, clusters -> counters. One thread per cluster.

// import: flatten/visible_clusters.wgsl
// import: cache/line_blocks.wgsl

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, count) * THREADS + thread;
    if index >= frame.clusters {
        return;
    }
    if frame.caches_lines != 0u {
        atomicStore(&counters.clusters[index].block, NO_BLOCK);
    }
    append_visible_cluster(index);
    report_work();
}
