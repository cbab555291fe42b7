// What a row of samples shows of the lines that are laid on it, one below the other: its thread alone keeps that.

const IS_FINE: bool = WORDS > 2u;
const PIXELS: u32 = WORDS * PIXELS_A_WORD;

// Sums of colors, times the samples that show them: where a row of a pixel has four samples, one word of three parts of ten bits,
// and where it has sixteen, red and blue in one word, and green in another. So many words of all pixels of a word:
const SUM_WORDS: u32 = select(8u, 4u, IS_FINE);
var<private> sums: array<u32, WORDS * SUM_WORDS>;

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
    rounds += countOneBits(samples);
    for (var left = samples; left != 0u;) {
        let pixel = firstTrailingBit(left) / SAMPLES_A_ROW;
        let own = bits_of_pixel(left, pixel);
        left &= ~(own << (pixel * SAMPLES_A_ROW));
        sums[first + pixel] += parts * countOneBits(own);
    }
}

fn is_row_full() -> bool {
    var all = ALL;
    for (var word = 0u; word < WORDS; word++) {
        all &= covered[word];
    }
    return all == ALL;
}

// Lays what a line covers of the row below all that is there.
fn lay_line(color: u32, span: vec2u) {
    for (var word = 0u; word < WORDS; word++) {
        // Most lines reach into few words of a row.
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

// Sums of a row for one of its pixels: red and blue, green and how many samples are covered, two numbers a word.
fn parts_of(pixel: u32, samples: u32) -> vec2u {
    let hidden = countOneBits(samples) << 16u;
    if IS_FINE {
        return vec2u(sums[2u * pixel], sums[2u * pixel + 1u] | hidden);
    }
    let sum = sums[pixel];
    return vec2u((sum & 0x3ffu) | ((sum >> 4u) & 0x3ff0000u), ((sum >> 10u) & 0x3ffu) | hidden);
}

// Writes the pixel of a thread, from all of its rows.
fn show(tile: Tile, thread: u32) {
    // What is looked up by a number cannot be kept in registers: this is a copy.
    var rows = covered;
    atomicStore(&scratch[thread], 0u);
    atomicStore(&scratch[THREADS + thread], 0u);
    workgroupBarrier();
    for (var i = 0u; i < PIXELS; i++) {
        // Rows begin at different pixels, so that threads in step add to different ones.
        let pixel = (thread + i) % PIXELS;
        let samples = bits_of_pixel(rows[pixel / PIXELS_A_WORD], pixel % PIXELS_A_WORD);
        let parts = parts_of(pixel, samples);
        let place = thread / SAMPLE_ROWS * TILE_PX + pixel;
        atomicAdd(&scratch[place], parts.x);
        atomicAdd(&scratch[THREADS + place], parts.y);
    }
    workgroupBarrier();
    let sum = vec2u(atomicLoad(&scratch[thread]), atomicLoad(&scratch[THREADS + thread]));
    let shown = vec4f(vec4u(sum.x & 0xffffu, sum.y & 0xffffu, sum.x >> 16u, sum.y >> 16u));
    let shares = shown / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    write(tile, thread, over_background(shares.rgb, shares.a));
}
