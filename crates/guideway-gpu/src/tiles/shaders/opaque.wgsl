// Tiles of opaque paths in many colours, whose lines come in falling draw rank: each is laid below all that are there. Some lines at a
// time are looked at, and each row of samples goes through those that reach into open pixels of its row of pixels.

var<workgroup> capsules: array<Capsule, TURN>;
// Their first row of samples, and from bit 16 on the one behind their last.
var<workgroup> touched: array<u32, TURN>;
var<workgroup> colors: array<u32, TURN>;

@group(0) @binding(7) var<storage, read_write> found: Found;

// Brings some lines together, each for the rows in which it may show.
fn gather(tile: Tile, thread: u32, first: u32, end: u32) {
    clear_rows(thread);
    if thread < TURN && first + thread < end {
        let line = portion[first + thread];
        let capsule = capsule_of_line(tile, line);
        let rows = rows_touched(capsule);
        capsules[thread] = capsule;
        touched[thread] = rows.x | (rows.y << 16u);
        colors[thread] = style_of(rank_of(line)).color;
        enter_rows(thread, capsule);
    }
    workgroupBarrier();
}

// Lays the lines that were gathered on a row, each below those before.
fn lay_lines(row: u32) {
    var full = ALL;
    for (var word = 0u; word < WORDS; word++) {
        full &= covered[word];
    }
    if full == ALL {
        return;
    }
    for (var word = 0u; word < TURN_WORDS; word++) {
        var left = lines_through(row, word);
        for (; left != 0u; left &= left - 1u) {
            rounds += 1u + WORDS;
            let line = word * 32u + firstTrailingBit(left);
            if row >= (touched[line] & 0xffffu) && row < (touched[line] >> 16u) {
                lay_line(colors[line], span_of(capsules[line], row));
            }
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) group_count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, group_count);
    if index >= frame.columns * frame.rows {
        return;
    }
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
    open_all(tile, thread);
    covered = beyond(tile, thread);
    var left = left_of(thread, list);
    var is_open = true;
    while is_open && left.is_any {
        let count = take_portion(thread, list, &left);
        for (var first = 0u; is_open && first < count; first += TURN) {
            gather(tile, thread, first, count);
            lay_lines(thread);
            is_open = stays_open(thread);
            // Of a turn, and of gathering.
            rounds += 1u + TURN_WORDS + 2u * TILE_PX;
        }
        // Of a portion.
        rounds += 64u;
    }
    show(tile, thread);
    end_rounds();
    workgroupBarrier();
    tell_rounds(thread);
    report_work();
}
