// One thread a cluster: lists those that lines are made of, by the points that they are drawn from.

override WORKGROUP: u32;

@group(0) @binding(1) var<storage, read> clusters: array<Cluster>;
@group(0) @binding(2) var<storage, read_write> found: Found;

@compute @workgroup_size(WORKGROUP)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, count) * WORKGROUP + thread;
    if index >= frame.clusters {
        return;
    }
    let cluster = clusters[index];
    reads(CLUSTER_WORDS);
    if is_made(box_px(cluster), reach_of(widest_px(cluster))) {
        if cluster.step_m > 0.0 && cluster.step_m <= frame.most_step_m {
            found.seen[atomicAdd(&found.counters.rounded, 1u)] = index;
        } else {
            found.seen[frame.clusters - 1u - atomicAdd(&found.counters.exact, 1u)] = index;
        }
        atomics(1u);
        writes(1u);
    }
    report_work();
}
