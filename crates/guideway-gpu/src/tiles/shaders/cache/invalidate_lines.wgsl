// Invalidates the cached lines of clusters that an edit changed, and lists these clusters, so that
// the flatten kernel writes their new lines.
//
// Bindings: frame, clusters, dirty_clusters -> counters, lines. One workgroup per dirty cluster; a
// thread clears every THREADS-th line of each block.

// import: flatten/visible_clusters.wgsl
// import: shared/line.wgsl
// import: cache/line_blocks.wgsl

@group(0) @binding(3) var<storage, read_write> lines: array<u32>;
@group(0) @binding(4) var<storage, read> dirty_clusters: array<u32>;

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let number = workgroup_index(id, count);
    if number >= frame.dirty_clusters {
        return;
    }
    let index = dirty_clusters[number];
    var block = atomicLoad(&counters.clusters[index].block);
    while block != NO_BLOCK {
        let head = (block - 1u) * LINE_WORDS;
        let lines_there = lines[head + 2u];
        for (var line = thread; line < lines_there; line += THREADS) {
            lines[(block + line) * LINE_WORDS] = NO_LINE;
        }
        block = lines[head + 1u];
    }
    workgroupBarrier();
    if thread == 0u {
        atomicStore(&counters.clusters[index].block, NO_BLOCK);
        append_visible_cluster(index);
    }
}
