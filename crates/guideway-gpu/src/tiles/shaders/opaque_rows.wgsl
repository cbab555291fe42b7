// Lines laid by all threads of a workgroup together: some at a time are looked at, and each row of samples goes through those that
// reach into open pixels of its row of pixels.

struct Thread {
    @builtin(local_invocation_index) number: u32,
}

var<workgroup> capsules: array<Capsule, TURN>;
// Their first row of samples, and from bit 16 on the one behind their last.
var<workgroup> touched: array<u32, TURN>;
var<workgroup> colors: array<u32, TURN>;

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
    if is_row_full() {
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

fn number_of(own: Thread) -> u32 {
    return own.number;
}

// Begins the row of a thread.
fn begin_row(tile: Tile, thread: u32) {
    open_all(tile, thread);
    covered = beyond(tile, thread);
}

// Lays so many lines of a portion, until all rows are full. Returns whether any is not.
fn lay_portion(own: Thread, tile: Tile, count: u32, is_last: bool) -> bool {
    var is_open = true;
    for (var first = 0u; is_open && first < count; first += TURN) {
        gather(tile, own.number, first, count);
        lay_lines(own.number);
        is_open = stays_open(own.number);
        // Of a turn, and of gathering.
        rounds += 1u + TURN_WORDS + 2u * TILE_PX;
    }
    return is_open;
}
