// Tiles of a scene of one opaque colour: it does not matter which line covers a sample.

// Covered samples of all rows.
var<workgroup> samples: array<u32, THREADS * WORDS>;

// How many samples of a pixel are covered.
fn count_of(pixel: u32) -> u32 {
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    let x = pixel % TILE_PX;
    let first_row = (pixel / TILE_PX) * SAMPLE_ROWS;
    var count = 0u;
    for (var row = first_row; row < first_row + SAMPLE_ROWS; row++) {
        let word = samples[row * WORDS + x / pixels_a_word];
        count += countOneBits(bits_of_pixel(word, x % pixels_a_word));
    }
    return count;
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
    let start = starts[index];
    let end = min(starts[index + 1u], frame.reference_room);
    if start >= end {
        write(tile, thread, frame.background);
        return;
    }
    let outside = beyond(tile, thread);
    var covered = outside;
    for (var first = start; first < end; first += BATCH) {
        let batch = min(BATCH, end - first);
        if thread < batch {
            load(tile, first + thread, thread);
        }
        workgroupBarrier();
        for (var i = 0u; i < batch; i++) {
            cover(&covered, span_of(capsules[i], thread));
        }
        if !any_open(thread, &covered) {
            break;
        }
    }
    for (var word = 0u; word < WORDS; word++) {
        samples[thread * WORDS + word] = covered[word] & ~outside[word];
    }
    workgroupBarrier();
    let share = f32(count_of(thread)) / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    write(tile, thread, over_background(channels(frame.color).rgb * share, share));
}
