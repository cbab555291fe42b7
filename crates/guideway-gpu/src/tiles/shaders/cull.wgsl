// One thread a cluster: lists those that lines are made of.

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
    if frame.keeps_lines != 0u {
        atomicStore(&found.places[index].block, NO_BLOCK);
    }
    list_cluster(index);
    report_work();
}
