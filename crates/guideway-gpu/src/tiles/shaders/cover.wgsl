// Tiles of a scene of one opaque colour: it does not matter which line covers a sample.

// Covered samples of each pixel.
var<workgroup> sums: array<atomic<u32>, THREADS>;

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
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    for (var word = 0u; word < WORDS; word++) {
        let inside = covered[word] & ~outside[word];
        for (var pixel = 0u; pixel < pixels_a_word && inside != 0u; pixel++) {
            let place = (thread / SAMPLE_ROWS) * TILE_PX + word * pixels_a_word + pixel;
            atomicAdd(&sums[place], countOneBits(bits_of_pixel(inside, pixel)));
        }
    }
    workgroupBarrier();
    let at = vec2u(thread % TILE_PX, thread / TILE_PX);
    let pixel = vec2u(tile.left, tile.top) + at;
    if pixel.x < frame.width_px && pixel.y < frame.height_px {
        let count = atomicLoad(&sums[thread]);
        let share = f32(count) / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
        let row = pixel.y - frame.first_row * TILE_PX;
        pixels[row * frame.width_px + pixel.x] = over_background(channels(frame.color).rgb * share, share);
    }
}
