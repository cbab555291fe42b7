// The state of a pixel: coverage by the one color of all paths, or the highest rank per sample.

// Paths have several colors: 32 samples per pixel keep the rank of the topmost path that covers
// them.
override RANKED: bool;
// Skips what cannot change the pixels any more.
override EXIT: bool;

const SAMPLES: u32 = 32u;
// Higher than every rank.
const FULL: u32 = 0xffffffffu;

// Color per rank, from rank 1 on.
@group(0) @binding(5) var<storage, read> colors: array<u32>;
// Between dispatches the state of each pixel, in the end its color; then the ranks per sample.
@group(0) @binding(6) var<storage, read_write> pixels: array<u32>;

struct Pixel {
    point_m: vec2f,
    index: u32,
    is_inside: bool,
    thread: u32,
    covered_segments: u32,
    // Paths up to this rank change nothing any more.
    floor: u32,
    tests: u32,
    bytes: u32,
    state: u32,
    ranks: array<u32, SAMPLES>,
}

fn test_line(pixel: ptr<function, Pixel>, line_m: vec4f, rank: u32) {
    if COUNT {
        (*pixel).tests += 1u;
    }
    if !RANKED {
        (*pixel).state = cover((*pixel).state, (*pixel).point_m, line_m);
        return;
    }
    var covered = cover(EMPTY, (*pixel).point_m, line_m);
    while covered != 0u {
        let sample = firstTrailingBit(covered);
        (*pixel).ranks[sample] = max((*pixel).ranks[sample], rank);
        covered &= covered - 1u;
    }
}

fn floor_of(pixel: ptr<function, Pixel>) -> u32 {
    if !RANKED {
        return select(0u, FULL, is_full((*pixel).state));
    }
    var lowest = FULL;
    for (var i = 0u; i < SAMPLES; i++) {
        lowest = min(lowest, (*pixel).ranks[i]);
    }
    return lowest;
}

// Returns true if a path of this rank is hidden everywhere.
fn is_hidden(pixel: ptr<function, Pixel>, rank: u32) -> bool {
    return EXIT && rank <= (*pixel).floor;
}

// Loop iterations that the test of one segment takes at most.
fn segment_cost() -> u32 {
    return 1u + LINES + select(0u, SAMPLES * (LINES + 1u), RANKED);
}

fn first_saved_rank(pixel: ptr<function, Pixel>) -> u32 {
    return view.width_px * view.rows + SAMPLES * (*pixel).index;
}

fn load(pixel: ptr<function, Pixel>, is_empty: bool) {
    if RANKED {
        let first = first_saved_rank(pixel);
        for (var i = 0u; i < SAMPLES; i++) {
            (*pixel).ranks[i] = 0u;
            if !is_empty {
                (*pixel).ranks[i] = pixels[first + i];
            }
        }
    } else {
        (*pixel).state = EMPTY;
        if !is_empty {
            (*pixel).state = pixels[(*pixel).index];
        }
    }
}

fn save(pixel: ptr<function, Pixel>) {
    if RANKED {
        let first = first_saved_rank(pixel);
        for (var i = 0u; i < SAMPLES; i++) {
            pixels[first + i] = (*pixel).ranks[i];
        }
    } else {
        pixels[(*pixel).index] = (*pixel).state;
    }
}

fn color_of(pixel: ptr<function, Pixel>) -> u32 {
    if !RANKED {
        return blend(coverage((*pixel).state));
    }
    let back = unpack4x8unorm(view.background);
    var sum = vec4f(0.0);
    for (var i = 0u; i < SAMPLES; i++) {
        let rank = (*pixel).ranks[i];
        if rank == 0u {
            sum += vec4f(back.rgb * back.a, back.a);
        } else {
            sum += unpack4x8unorm(colors[rank - 1u]);
        }
    }
    if sum.a == 0.0 {
        return view.background;
    }
    return pack4x8unorm(vec4f(sum.rgb / sum.a, sum.a / f32(SAMPLES)));
}
