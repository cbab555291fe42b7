// Composites batches by the whole workgroup: it loads BATCH_LINES lines, and each thread composites
// those that cross its pixel row. Variant `workgroup` of the rows interface; the other is
// `rows_subgroup.wgsl`.

// import: composite/row_lists.wgsl
// import: composite/composite_row.wgsl
// import: composite/rank_buckets.wgsl

struct Thread {
    @builtin(local_invocation_index) number: u32,
}

var<workgroup> capsules: array<Capsule, BATCH_LINES>;
// Bits 0-15: first sample row of a line. Bits 16-31: the end of its rows.
var<workgroup> row_ranges: array<u32, BATCH_LINES>;
var<workgroup> colors: array<u32, BATCH_LINES>;

// Loads lines, and lists each for the pixel rows in which it may be visible.
fn load_batch(tile: Tile, thread: u32, first: u32, end: u32) {
    clear_row_lists(thread);
    if thread < BATCH_LINES && first + thread < end {
        let line = batch[first + thread];
        let capsule = capsule_of_line(tile, line);
        let rows = capsule_rows(capsule);
        capsules[thread] = capsule;
        row_ranges[thread] = rows.x | (rows.y << 16u);
        colors[thread] = style_of(rank_of(line)).color;
        insert_line(thread, capsule);
    }
    workgroupBarrier();
}

// Composites the loaded lines on a row, each below those before.
fn composite_lines(row: u32) {
    if is_row_full() {
        return;
    }
    for (var word = 0u; word < BATCH_WORDS; word++) {
        var left = lines_of_pixel_row(row, word);
        for (; left != 0u; left &= left - 1u) {
            loops += 1u + ROW_WORDS;
            let line = word * 32u + firstTrailingBit(left);
            if row >= (row_ranges[line] & 0xffffu) && row < (row_ranges[line] >> 16u) {
                composite_line(colors[line], row_span(capsules[line], row));
            }
        }
    }
}

fn row_of_thread(own: Thread) -> u32 {
    return own.number;
}

// Initializes the row of a thread.
fn init_row(tile: Tile, thread: u32) {
    init_open_pixels(tile, thread);
    covered = outside_picture(tile, thread);
}

// Composites a batch until all rows are full. Returns whether any row is open.
fn composite_batch(own: Thread, tile: Tile, count: u32, is_last: bool) -> bool {
    var is_open = true;
    for (var first = 0u; is_open && first < count; first += BATCH_LINES) {
        load_batch(tile, own.number, first, count);
        composite_lines(own.number);
        is_open = close_pixels(own.number);
        // Iterations of loading lines.
        loops += 1u + BATCH_WORDS + 2u * TILE_PX;
    }
    return is_open;
}
