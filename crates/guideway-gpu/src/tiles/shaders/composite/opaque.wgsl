// Composites the tiles of opaque paths in many colors, front to back.
//
// Bindings: frame, tile_lists, references, lines, line_ranks, styles -> pixels, counters. One
// workgroup per tile; a thread owns one sample row and writes one pixel.

// import: composite/rank_batch.wgsl
// import: composite/rows_{rows}.wgsl
// import: composite/loop_count.wgsl

@group(0) @binding(7) var<storage, read_write> counters: CounterBuffer;

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    own: Thread,
) {
    let index = workgroup_index(id, group_count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let thread = row_of_thread(own);
    let tile = tile_of(index);
    let list = tile_list(index);
    if thread == 0u {
        count_reads(2u);
    }
    if list.x >= list.y {
        write_pixel(tile, thread, frame.background);
        report_work();
        return;
    }
    begin_loop_count(thread);
    init_row(tile, thread);
    var remaining = list_remaining(thread, list);
    var is_open = true;
    while is_open && remaining.is_any {
        let count = next_batch(thread, list, &remaining);
        is_open = composite_batch(own, tile, count, !remaining.is_any);
        // Iterations of loading a batch.
        loops += 64u;
    }
    resolve_rows(tile, thread);
    fold_loop_count();
    workgroupBarrier();
    report_loop_count(thread);
    report_work();
}
