// Covers the tiles of a scene of one opaque color.
//
// Bindings: frame, tile_lists, references, lines, line_ranks, styles -> pixels, tile_counts,
// counters. One workgroup per tile; a thread loads one line per batch of the list, and covers its
// share of the sample rows of these lines (`distribute_rows.wgsl`).

// import: cover/cover_tile.wgsl

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
