// Covered samples of one tile, in workgroup memory.

// import: shared/tile.wgsl
// import: shared/open_pixels.wgsl

// One bit per sample, ROW_WORDS words per sample row.
var<workgroup> samples: array<atomic<u32>, TILE_PX * SAMPLE_ROWS * ROW_WORDS>;
// Number of open pixels.
var<workgroup> open_pixel_count: atomic<u32>;

// Clears all samples and opens the pixels inside the picture.
fn clear_samples(tile: Tile, thread: u32) {
    let size = init_open_pixels(tile, thread);
    if thread == 0u {
        atomicStore(&open_pixel_count, size.x * size.y);
    }
    for (var word = thread; word < TILE_PX * SAMPLE_ROWS * ROW_WORDS; word += THREADS) {
        atomicStore(&samples[word], 0u);
    }
}

// Number of covered samples of a pixel.
fn covered_samples(pixel: u32) -> u32 {
    let pixels_per_word = 32u / SAMPLES_PER_ROW;
    let x = pixel % TILE_PX;
    let first_row = (pixel / TILE_PX) * SAMPLE_ROWS;
    var count = 0u;
    // A loop of constant length: compilers unroll it.
    for (var k = 0u; k < SAMPLE_ROWS; k++) {
        let word = atomicLoad(&samples[(first_row + k) * ROW_WORDS + x / pixels_per_word]);
        count += countOneBits(pixel_bits(word, x % pixels_per_word));
    }
    return count;
}

// Closes full pixels. `threads` threads share the words of each pixel row.
fn close_full_pixels(thread: u32, threads: u32) {
    for (var i = thread; i < TILE_PX * ROW_WORDS; i += threads) {
        let row_px = i / ROW_WORDS;
        var covered = ALL_BITS;
        for (var k = 0u; k < SAMPLE_ROWS; k++) {
            // Threads start at different rows: equal rows lie in one bank of workgroup memory.
            let row = row_px * SAMPLE_ROWS + (k ^ row_px);
            covered &= atomicLoad(&samples[row * ROW_WORDS + i % ROW_WORDS]);
        }
        let full = full_pixel_bits(covered) << (i % ROW_WORDS * (32u / SAMPLES_PER_ROW));
        if full != 0u {
            let closed = countOneBits(atomicAnd(&open_pixels[row_px], ~full) & full);
            atomicSub(&open_pixel_count, closed);
        }
    }
}

// Covers the samples of one row of a capsule.
fn cover_row(capsule: Capsule, row: u32) {
    let span = row_span(capsule, row);
    var word = row * ROW_WORDS + span.x / 32u;
    var bit = span.x % 32u;
    for (var left = span.y - span.x; left > 0u; word++) {
        let here = min(left, 32u - bit);
        atomicOr(&samples[word], (ALL_BITS >> (32u - here)) << bit);
        left -= here;
        bit = 0u;
    }
}
