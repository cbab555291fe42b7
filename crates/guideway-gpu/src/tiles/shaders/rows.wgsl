// The lines that are looked at together, by the rows of pixels that go through them. A thread has a row of samples.

const TURN_WORDS: u32 = TURN / 32u;

// Which lines each row of pixels goes through, a bit each.
var<workgroup> lines_of_row: array<atomic<u32>, TILE_PX * TURN_WORDS>;
var<workgroup> is_any_open: atomic<u32>;
var<workgroup> stays: u32;

// Begins with no line.
fn clear_rows(thread: u32) {
    if thread < TILE_PX * TURN_WORDS {
        atomicStore(&lines_of_row[thread], 0u);
    }
    if thread == 0u {
        atomicStore(&is_any_open, 0u);
    }
    workgroupBarrier();
}

// Enters the line of a thread into the rows in which it may show.
fn enter_rows(thread: u32, capsule: Capsule) {
    for (var left = rows_shown(capsule); left != 0u; left &= left - 1u) {
        let word = firstTrailingBit(left) * TURN_WORDS + thread / 32u;
        atomicOr(&lines_of_row[word], 1u << (thread % 32u));
    }
}

// The lines of a word that a row of samples goes through.
fn lines_through(row: u32, word: u32) -> u32 {
    return atomicLoad(&lines_of_row[row / SAMPLE_ROWS * TURN_WORDS + word]);
}

// Closes the pixels that are covered, and says whether any is left.
fn stays_open(thread: u32) -> bool {
    var left = 0u;
    for (var word = 0u; word < WORDS; word++) {
        left |= (full_pixels(covered[word]) ^ low_bits(PIXELS_A_WORD)) << (word * PIXELS_A_WORD);
    }
    if thread < TILE_PX {
        atomicStore(&open[thread], 0u);
    }
    workgroupBarrier();
    if left != 0u {
        atomicOr(&open[thread / SAMPLE_ROWS], left);
        atomicStore(&is_any_open, 1u);
    }
    workgroupBarrier();
    if thread == 0u {
        stays = atomicLoad(&is_any_open);
    }
    return workgroupUniformLoad(&stays) != 0u;
}
