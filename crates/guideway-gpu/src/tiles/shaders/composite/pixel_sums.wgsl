// Sums over the samples of each pixel. In density a path counts half around each of its ends: per
// sample two halves of its strokes, less one of either end.

// import: composite/sample_row.wgsl
// import: composite/loop_count.wgsl
// import: shared/tile.wgsl

// Bit 0: the upper end of a capsule is an end of a path. Bit 1: so is the lower one. Words, because
// booleans of several threads overwrite each other in the workgroup memory of an NVIDIA H200.
var<workgroup> path_ends: array<u32, BATCH_LINES>;
// Red, green, blue and opacity sums per pixel; or the samples of strokes, and those of ends.
var<workgroup> sums: array<atomic<u32>, THREADS * 4>;

const OF_STROKES: u32 = 0u;
const OF_ENDS: u32 = 1u;

// Adds samples of a row to a sum of their pixels, and empties the row.
fn count_samples(row: u32, sum: u32, samples: ptr<function, SampleRow>) {
    let first_pixel = (row / SAMPLE_ROWS) * TILE_PX;
    for (var word = 0u; word < ROW_WORDS; word++) {
        loops++;
        for (var left = (*samples)[word]; left != 0u;) {
            loops++;
            let of_word = firstTrailingBit(left) / SAMPLES_PER_ROW;
            let bits = pixel_bits(left, of_word);
            left &= ~(bits << (of_word * SAMPLES_PER_ROW));
            let pixel = first_pixel + word * PIXELS_PER_WORD + of_word;
            atomicAdd(&sums[pixel * 4u + sum], countOneBits(bits));
        }
        (*samples)[word] = 0u;
    }
}

// Counts the samples of a row around an end of a path.
fn count_end(row: u32, center: vec2f, radius: f32) {
    // A capsule without length.
    let disc = Capsule(center, MIN_HEIGHT, 0.0, BORDER_SLACK, radius);
    var samples: SampleRow;
    cover(&samples, disc, row);
    count_samples(row, OF_ENDS, &samples);
}

// Counts the samples of a row around the ends of a capsule that are ends of a path.
fn count_ends(row: u32, capsule: Capsule, ends: u32) {
    if (ends & 1u) != 0u {
        count_end(row, capsule.upper, capsule.radius);
    }
    if (ends & 2u) != 0u {
        count_end(row, lower_end(capsule), capsule.radius);
    }
}

// Returns the word of `path_ends` for the capsule of a line.
fn path_ends_of_capsule(tile: Tile, index: u32) -> u32 {
    let words = words_of_line(index);
    let ends = path_ends_of(words);
    let is_down = points_down(ends_from(line_of(words), corner_of(tile)));
    return select((ends >> 1u) | ((ends & 1u) << 1u), ends, is_down);
}

// Returns the mean number of paths per sample. An end may hold a sample more than its stroke, by
// rounding.
fn mean_paths(sum: vec4u) -> f32 {
    let halves = max(2u * sum[OF_STROKES], sum[OF_ENDS]) - sum[OF_ENDS];
    // A power of two.
    return f32(halves) / f32(2u * SAMPLE_ROWS * SAMPLES_PER_ROW);
}
