// Composites the tiles of translucent paths front to back, or counts paths per pixel (density).
// Lists are in falling draw rank, so that strokes of one path are adjacent: the samples of a path
// are gathered first, then composited once.
//
// Bindings: frame, tile_lists, references, lines, line_ranks, styles -> pixels, counters. One
// workgroup per tile; a thread owns one sample row and writes one pixel.

// import: composite/pixel_sums.wgsl
// import: composite/row_lists.wgsl
// import: composite/loop_count.wgsl
// import: shared/tile.wgsl
// import: shared/blend.wgsl

// True if pixels hold path counts instead of colors.
override IS_DENSITY: bool;

var<workgroup> capsules: array<Capsule, BATCH_LINES>;
var<workgroup> ranks: array<u32, BATCH_LINES>;
var<workgroup> colors: array<u32, BATCH_LINES>;
@group(0) @binding(7) var<storage, read_write> counters: CounterBuffer;

// Transmittance of each sample of this thread's row.
var<private> transmittance: array<f32, ROW_WORDS * 32>;

// Fixed-point steps of one sample in a sum.
const SUM_STEPS: u32 = 256u;

// Adds a color, weighted by a sum of up to 16 transmittances.
fn add_color(pixel: u32, color: u32, samples: f32) {
    let weight = u32(exact(samples * 65536.0) + 0.5);
    let rounding = 32768u / SUM_STEPS;
    let parts = (opaque_channels(color) * weight + rounding) / (65536u / SUM_STEPS);
    for (var channel = 0u; channel < 4u; channel++) {
        atomicAdd(&sums[pixel * 4u + channel], parts[channel]);
    }
}

// Multiplies the transmittance of samples by 1 - opacity. Returns how much it falls.
fn take_transmittance(first_sample: u32, bits: u32, opacity: f32) -> f32 {
    loops += countOneBits(bits);
    var taken = 0.0;
    for (var left = bits; left != 0u; left &= left - 1u) {
        let sample = first_sample + firstTrailingBit(left);
        let part = clamp(transmittance[sample] * opacity, 0.0, 1.0);
        taken += part;
        transmittance[sample] -= part;
    }
    return taken;
}

// Composites the gathered samples of a path below all before, and starts the next path.
fn composite_path(row: u32, color: u32, gathered: ptr<function, SampleRow>) {
    if IS_DENSITY {
        count_samples(row, OF_STROKES, gathered);
        return;
    }
    let opacity = f32(color >> 24u) * (1.0 / 255.0);
    let first_pixel = (row / SAMPLE_ROWS) * TILE_PX;
    for (var word = 0u; word < ROW_WORDS; word++) {
        loops++;
        let all = (*gathered)[word];
        let fresh = all & ~covered[word];
        (*gathered)[word] = 0u;
        for (var left = fresh; left != 0u;) {
            loops++;
            let of_word = firstTrailingBit(left) / SAMPLES_PER_ROW;
            let bits = pixel_bits(left, of_word);
            left &= ~(bits << (of_word * SAMPLES_PER_ROW));
            let pixel = first_pixel + word * PIXELS_PER_WORD + of_word;
            let first_sample = word * 32u + of_word * SAMPLES_PER_ROW;
            add_color(pixel, color, take_transmittance(first_sample, bits, opacity));
        }
        if opacity >= 1.0 {
            covered[word] |= fresh;
        }
    }
}

// Loads lines, and lists each for the pixel rows in which it may be visible.
fn load_batch(tile: Tile, thread: u32, first: u32, end: u32) {
    clear_row_lists(thread);
    if thread < BATCH_LINES && first + thread < end {
        let capsule = capsule_of_reference(tile, first + thread);
        let line = references[first + thread];
        let rank = line_ranks[line];
        count_reads(2u);
        capsules[thread] = capsule;
        if IS_DENSITY {
            path_ends[thread] = path_ends_of_capsule(tile, line);
        }
        ranks[thread] = rank;
        colors[thread] = style_of(rank).color;
        insert_line(thread, capsule);
    }
    workgroupBarrier();
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
    let list = tile_list(index);
    if thread == 0u {
        count_reads(2u);
    }
    if list.x >= list.y {
        write_pixel(tile, thread, select(frame.background, 0u, IS_DENSITY));
        report_work();
        return;
    }
    for (var channel = 0u; channel < 4u; channel++) {
        atomicStore(&sums[thread * 4u + channel], 0u);
    }
    begin_loop_count(thread);
    init_open_pixels(tile, thread);
    covered = outside_picture(tile, thread);
    if !IS_DENSITY {
        for (var i = 0u; i < ROW_WORDS * 32u; i++) {
            transmittance[i] = 1.0;
            loops++;
        }
    }
    workgroupBarrier();
    var rank = 0xffffffffu;
    var color = 0u;
    var gathered: SampleRow;
    for (var first = list.x; first < list.y; first += BATCH_LINES) {
        load_batch(tile, thread, first, list.y);
        // Iterations of loading lines and closing pixels.
        loops += 1u + BATCH_WORDS + 3u * TILE_PX;
        for (var word = 0u; word < BATCH_WORDS; word++) {
            var left = lines_of_pixel_row(thread, word);
            for (; left != 0u; left &= left - 1u) {
                loops += 1u + ROW_WORDS;
                let line = word * 32u + firstTrailingBit(left);
                if ranks[line] != rank {
                    composite_path(thread, color, &gathered);
                    rank = ranks[line];
                    color = colors[line];
                }
                cover(&gathered, capsules[line], thread);
                if IS_DENSITY {
                    count_ends(thread, capsules[line], path_ends[line]);
                }
            }
        }
        if IS_DENSITY {
            workgroupBarrier();
        } else if !close_pixels(thread) {
            break;
        }
    }
    composite_path(thread, color, &gathered);
    fold_loop_count();
    workgroupBarrier();
    report_loop_count(thread);
    var sum: vec4u;
    for (var channel = 0u; channel < 4u; channel++) {
        sum[channel] = atomicLoad(&sums[thread * 4u + channel]);
    }
    if IS_DENSITY {
        write_pixel(tile, thread, bitcast<u32>(mean_paths(sum)));
    } else {
        let per_step = SUM_STEPS * SAMPLE_ROWS * SAMPLES_PER_ROW / PIXEL_STEPS;
        write_pixel(tile, thread, over_background((sum + per_step / 2u) / per_step));
    }
    report_work();
}
