// Tiles of opaque paths in many colors, whose lines come in falling draw rank: each is laid below all that are there.

@group(0) @binding(7) var<storage, read_write> found: Found;

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
    let thread = number_of(own);
    let tile = tile_of(index);
    let list = list_of(index);
    if thread == 0u {
        reads(2u);
    }
    if list.x >= list.y {
        write(tile, thread, frame.background);
        report_work();
        return;
    }
    begin_rounds(thread);
    begin_row(tile, thread);
    var left = left_of(thread, list);
    var is_open = true;
    while is_open && left.is_any {
        let count = take_portion(thread, list, &left);
        is_open = lay_portion(own, tile, count, !left.is_any);
        // Of a portion.
        rounds += 64u;
    }
    show(tile, thread);
    end_rounds();
    workgroupBarrier();
    tell_rounds(thread);
    report_work();
}
