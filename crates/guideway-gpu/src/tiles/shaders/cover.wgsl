// Tiles of a scene of one opaque color: it does not matter which line covers a sample.

@group(0) @binding(7) var<storage, read_write> counts: array<u32>;
@group(0) @binding(8) var<storage, read_write> found: Found;

// What was counted for the tile, and its list where places were reserved for that.
var<workgroup> listed: vec3u;
// Covered samples of all rows.
var<workgroup> samples: array<atomic<u32>, TILE_PX * SAMPLE_ROWS * WORDS>;
// How many pixels are open.
var<workgroup> open_pixels: atomic<u32>;

// Begins with nothing covered.
fn clear(tile: Tile, thread: u32) {
    let size = open_all(tile, thread);
    if thread == 0u {
        atomicStore(&open_pixels, size.x * size.y);
    }
    for (var word = thread; word < TILE_PX * SAMPLE_ROWS * WORDS; word += THREADS) {
        atomicStore(&samples[word], 0u);
    }
}

// How many samples of a pixel are covered.
fn count_of(pixel: u32) -> u32 {
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    let x = pixel % TILE_PX;
    let first_row = (pixel / TILE_PX) * SAMPLE_ROWS;
    var count = 0u;
    // A loop of known length takes less time.
    for (var k = 0u; k < SAMPLE_ROWS; k++) {
        let word = atomicLoad(&samples[(first_row + k) * WORDS + x / pixels_a_word]);
        count += countOneBits(bits_of_pixel(word, x % pixels_a_word));
    }
    return count;
}

// Closes the pixels all of whose samples are covered: so many threads share the words of a row of pixels.
fn close_covered(thread: u32, threads: u32) {
    for (var i = thread; i < TILE_PX * WORDS; i += threads) {
        let row_px = i / WORDS;
        var covered = ALL;
        for (var k = 0u; k < SAMPLE_ROWS; k++) {
            // Threads begin at different rows, for those of equal number lie in one bank of the memory.
            let row = row_px * SAMPLE_ROWS + (k ^ row_px);
            covered &= atomicLoad(&samples[row * WORDS + i % WORDS]);
        }
        let full = full_pixels(covered) << (i % WORDS * (32u / SAMPLES_A_ROW));
        if full != 0u {
            let closed = countOneBits(atomicAnd(&open[row_px], ~full) & full);
            atomicSub(&open_pixels, closed);
        }
    }
}

// Covers a row of samples that a line touches.
fn cover_row(capsule: Capsule, row: u32) {
    let span = span_of(capsule, row);
    var word = row * WORDS + span.x / 32u;
    var bit = span.x % 32u;
    for (var left = span.y - span.x; left > 0u; word++) {
        let here = min(left, 32u - bit);
        atomicOr(&samples[word], (ALL >> (32u - here)) << bit);
        left -= here;
        bit = 0u;
    }
}

// Shows what is covered of a tile.
fn show(tile: Tile, thread: u32) {
    close_covered(thread, THREADS);
    for (var pixel = thread; pixel < TILE_PX * TILE_PX; pixel += THREADS) {
        let share = f32(count_of(pixel)) / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
        write(tile, pixel, over_background(channels(frame.color).rgb * share, share));
    }
    workgroupBarrier();
    if thread == 0u && atomicLoad(&open_pixels) == 0u {
        counts[tile.index] |= FULL;
        atomicAdd(&found.counters.full_tiles, 1u);
        atomics(1u);
    }
}

fn cover_tile(own: Thread, index: u32) {
    let thread = own.number;
    let tile = tile_of(index);
    if thread == 0u {
        listed = vec3u(counts[index], list_of(index));
        reads(3u);
    }
    // Meanwhile.
    clear(tile, thread);
    let known = workgroupUniformLoad(&listed);
    // Its pixels are written already.
    if (known.x & FULL) != 0u {
        return;
    }
    let list = list_of_counted(index, known.x, known.yz);
    if list.x >= list.y {
        for (var pixel = thread; pixel < TILE_PX * TILE_PX; pixel += THREADS) {
            write(tile, pixel, frame.background);
        }
        return;
    }
    cover_list(team_of(own), tile, list);
    workgroupBarrier();
    show(tile, thread);
}
