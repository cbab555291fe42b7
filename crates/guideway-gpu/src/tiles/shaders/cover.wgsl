// Tiles of a scene of one opaque colour: it does not matter which line covers a sample.

@group(0) @binding(7) var<storage, read_write> counts: array<u32>;
@group(0) @binding(8) var<storage, read_write> found: Counters;

var<workgroup> was_full: u32;
// Covered samples of all rows.
var<workgroup> samples: array<atomic<u32>, THREADS * WORDS>;

// How many samples of a pixel are covered.
fn count_of(pixel: u32) -> u32 {
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    let x = pixel % TILE_PX;
    let first_row = (pixel / TILE_PX) * SAMPLE_ROWS;
    var count = 0u;
    for (var row = first_row; row < first_row + SAMPLE_ROWS; row++) {
        let word = atomicLoad(&samples[row * WORDS + x / pixels_a_word]);
        count += countOneBits(bits_of_pixel(word, x % pixels_a_word));
    }
    return count;
}

// Whether any pixel of the tile that is part of the picture has samples that are not covered.
fn any_open_pixel(tile: Tile, thread: u32, covered: u32) -> bool {
    let x = tile.left + thread % TILE_PX;
    let y = tile.top + thread / TILE_PX;
    let is_inside = x < frame.width_px && y < frame.height_px;
    return any_of(thread, is_inside && covered < SAMPLE_ROWS * SAMPLES_A_ROW);
}

// Covers every `parts`-th row that a line touches, from one of the first on.
fn cover_rows(capsule: Capsule, part: u32, parts: u32) {
    let rows = rows_touched(capsule);
    for (var row = rows.x + part; row < rows.y; row += parts) {
        let span = span_of(capsule, row);
        for (var word = span.x / 32u; word * 32u < span.y; word++) {
            atomicOr(&samples[row * WORDS + word], bits_between(span.x, span.y, word));
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let index = workgroup_index(id, count);
    if index >= frame.columns * frame.rows {
        return;
    }
    let tile = tile_of(index);
    if thread == 0u {
        was_full = counts[index] & FULL;
    }
    // Its pixels are written already.
    if workgroupUniformLoad(&was_full) != 0u {
        return;
    }
    let list = list_of(index);
    let start = list.x;
    let end = list.y;
    if start >= end {
        write(tile, thread, frame.background);
        return;
    }
    for (var word = 0u; word < WORDS; word++) {
        atomicStore(&samples[thread * WORDS + word], 0u);
    }
    workgroupBarrier();
    let outside = beyond(tile, thread);
    // A long list is likely to cover the tile before its end: then it is worth a look more often.
    let most = select(THREADS, BATCH, end - start > 2u * THREADS);
    for (var first = start; first < end; first += most) {
        let batch = min(most, end - first);
        // Few lines are shared out by their rows, so that all threads have work.
        let parts = THREADS >> (32u - countLeadingZeros(batch - 1u));
        let line = thread / parts;
        if line < batch {
            cover_rows(capsule_at(tile, first + line), thread % parts, parts);
        }
        workgroupBarrier();
        if first + most < end {
            var row = outside;
            for (var word = 0u; word < WORDS; word++) {
                row[word] |= atomicLoad(&samples[thread * WORDS + word]);
            }
            if !any_open(thread, &row) {
                break;
            }
        }
    }
    let count_here = count_of(thread);
    let is_full = !any_open_pixel(tile, thread, count_here);
    if is_full && thread == 0u {
        counts[index] |= FULL;
        atomicAdd(&found.full_tiles, 1u);
    }
    let share = f32(count_here) / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    write(tile, thread, over_background(channels(frame.color).rgb * share, share));
}
