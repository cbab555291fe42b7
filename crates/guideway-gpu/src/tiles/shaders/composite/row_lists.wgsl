// Lists the lines of a batch by pixel row, in workgroup memory. A thread owns one sample row.

// import: composite/sample_row.wgsl
// import: shared/open_pixels.wgsl

const BATCH_WORDS: u32 = BATCH_LINES / 32u;

// Lines that cross each pixel row, one bit each.
var<workgroup> lines_of_row: array<atomic<u32>, TILE_PX * BATCH_WORDS>;
var<workgroup> is_any_open: atomic<u32>;
var<workgroup> stays: u32;

// Empties all lists.
fn clear_row_lists(thread: u32) {
    if thread < TILE_PX * BATCH_WORDS {
        atomicStore(&lines_of_row[thread], 0u);
    }
    if thread == 0u {
        atomicStore(&is_any_open, 0u);
    }
    workgroupBarrier();
}

// Inserts a thread's line into the pixel rows in which it may be visible.
fn insert_line(thread: u32, capsule: Capsule) {
    for (var left = open_pixel_rows(capsule); left != 0u; left &= left - 1u) {
        let word = firstTrailingBit(left) * BATCH_WORDS + thread / 32u;
        atomicOr(&lines_of_row[word], 1u << (thread % 32u));
    }
}

// One word of the lines that cross the pixel row of a sample row.
fn lines_of_pixel_row(row: u32, word: u32) -> u32 {
    return atomicLoad(&lines_of_row[row / SAMPLE_ROWS * BATCH_WORDS + word]);
}

// Closes full pixels. Returns whether any is open.
fn close_pixels(thread: u32) -> bool {
    var left = 0u;
    for (var word = 0u; word < ROW_WORDS; word++) {
        let open = full_pixel_bits(covered[word]) ^ low_bits(PIXELS_PER_WORD);
        left |= open << (word * PIXELS_PER_WORD);
    }
    if thread < TILE_PX {
        atomicStore(&open_pixels[thread], 0u);
    }
    workgroupBarrier();
    if left != 0u {
        atomicOr(&open_pixels[thread / SAMPLE_ROWS], left);
        atomicStore(&is_any_open, 1u);
    }
    workgroupBarrier();
    if thread == 0u {
        stays = atomicLoad(&is_any_open);
    }
    return workgroupUniformLoad(&stays) != 0u;
}
