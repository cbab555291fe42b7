// Composites opaque lines on a thread's sample row, front to back, and resolves rows to pixels.

// import: composite/sample_row.wgsl
// import: composite/rank_buckets.wgsl
// import: shared/tile.wgsl
// import: shared/blend.wgsl

const IS_FINE: bool = ROW_WORDS > 2u;
const PIXELS: u32 = ROW_WORDS * PIXELS_PER_WORD;

// Color sums, weighted by samples. With 4 samples per row: one word per pixel, 10 bits per channel.
// With 16: red and blue in one word, green in another.
const SUM_WORDS: u32 = select(8u, 4u, IS_FINE);
var<private> sums: array<u32, ROW_WORDS * SUM_WORDS>;

// Adds a color for samples of a word.
fn add_samples(word: u32, samples: u32, color: u32) {
    let first = word * SUM_WORDS;
    if IS_FINE {
        let counts = vec2u(countOneBits(samples & 0xffffu), countOneBits(samples >> 16u));
        for (var i = 0u; i < 2u; i++) {
            sums[first + 2u * i] += (color & 0xff00ffu) * counts[i];
            sums[first + 2u * i + 1u] += ((color >> 8u) & 0xffu) * counts[i];
        }
        return;
    }
    let parts = (color & 0xffu) | ((color & 0xff00u) << 2u) | ((color & 0xff0000u) << 4u);
    loops += countOneBits(samples);
    for (var left = samples; left != 0u;) {
        let pixel = firstTrailingBit(left) / SAMPLES_PER_ROW;
        let own = pixel_bits(left, pixel);
        left &= ~(own << (pixel * SAMPLES_PER_ROW));
        sums[first + pixel] += parts * countOneBits(own);
    }
}

fn is_row_full() -> bool {
    var all = ALL_BITS;
    for (var word = 0u; word < ROW_WORDS; word++) {
        all &= covered[word];
    }
    return all == ALL_BITS;
}

// Composites a line below all lines before.
fn composite_line(color: u32, span: vec2u) {
    for (var word = 0u; word < ROW_WORDS; word++) {
        // Most lines reach few words of a row.
        if span.x >= 32u * word + 32u || span.y <= 32u * word {
            continue;
        }
        let fresh = bits_between(span.x, span.y, word) & ~covered[word];
        if fresh != 0u {
            add_samples(word, fresh, color);
            covered[word] |= fresh;
        }
    }
}

// Two words of two 16-bit sums for one pixel: red and blue; green and the covered samples.
fn pixel_sums(pixel: u32, samples: u32) -> vec2u {
    let hidden = countOneBits(samples) << 16u;
    if IS_FINE {
        return vec2u(sums[2u * pixel], sums[2u * pixel + 1u] | hidden);
    }
    let sum = sums[pixel];
    return vec2u((sum & 0x3ffu) | ((sum >> 4u) & 0x3ff0000u), ((sum >> 10u) & 0x3ffu) | hidden);
}

// Resolves the pixel of a thread from its 16 sample rows.
fn resolve_rows(tile: Tile, thread: u32) {
    // A copy: dynamic indexing would move the variable out of registers.
    var rows = covered;
    atomicStore(&scratch[thread], 0u);
    atomicStore(&scratch[THREADS + thread], 0u);
    workgroupBarrier();
    for (var i = 0u; i < PIXELS; i++) {
        // Rows start at different pixels, so that neighboring threads add to different ones.
        let pixel = (thread + i) % PIXELS;
        let samples = pixel_bits(rows[pixel / PIXELS_PER_WORD], pixel % PIXELS_PER_WORD);
        let parts = pixel_sums(pixel, samples);
        let slot = thread / SAMPLE_ROWS * TILE_PX + pixel;
        atomicAdd(&scratch[slot], parts.x);
        atomicAdd(&scratch[THREADS + slot], parts.y);
    }
    workgroupBarrier();
    let sum = vec2u(atomicLoad(&scratch[thread]), atomicLoad(&scratch[THREADS + thread]));
    let shown = vec4u(sum.x & 0xffffu, sum.y & 0xffffu, sum.x >> 16u, (sum.y >> 16u) * 255u);
    let steps = PIXEL_STEPS / (SAMPLE_ROWS * SAMPLES_PER_ROW);
    write_pixel(tile, thread, over_background(shown * steps));
}
