// A workgroup covers one tile.

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    own: Thread,
) {
    let index = workgroup_index(id, count);
    if index < frame.columns * frame.rows {
        cover_tile(own, index);
        report_work();
    }
}
