// Tiles in which some paths are translucent, or density: lists are in falling draw rank, and strokes of one path stand together.
// What a path covers is gathered first, and then laid below all that was laid before. Each row of pixels goes through the lines that
// reach into open pixels of it.

// Whether it is not colours that are shown, but how many paths cover a pixel.
override IS_DENSITY: bool;

const TURN_WORDS: u32 = TURN / 32u;

var<workgroup> capsules: array<Capsule, TURN>;
var<workgroup> ranks: array<u32, TURN>;
var<workgroup> colors: array<u32, TURN>;
// Which of them each row of pixels goes through, a bit each.
var<workgroup> lines_of_row: array<atomic<u32>, TILE_PX * TURN_WORDS>;
// Red, green, blue, and how much is hidden, for each pixel.
var<workgroup> sums: array<atomic<u32>, THREADS * 4>;

@group(0) @binding(7) var<storage, read_write> found: Found;

// Samples of this thread's row that opaque paths have covered.
var<private> covered: Row;
// What still shines through at each of its samples.
var<private> clear: array<f32, WORDS * 32>;

// Parts that one sample's share of a sum is counted in.
const PARTS: f32 = 256.0;

fn add(pixel: u32, color: u32, samples: f32) {
    let parts = vec4u(vec4f(channels(color).rgb, 255.0) * samples * PARTS + 0.5);
    for (var channel = 0u; channel < 4u; channel++) {
        atomicAdd(&sums[pixel * 4u + channel], parts[channel]);
    }
}

// Takes from what shines through some samples of a pixel, and says how much.
fn take(first_sample: u32, bits: u32, opacity: f32) -> f32 {
    rounds += countOneBits(bits);
    var taken = 0.0;
    for (var left = bits; left != 0u; left &= left - 1u) {
        let sample = first_sample + firstTrailingBit(left);
        let part = clear[sample] * opacity;
        taken += part;
        clear[sample] -= part;
    }
    return taken;
}

// Lays a colour over what was gathered of a row, where nothing hides it, and gathers anew.
fn lay(row: u32, color: u32, gathered: ptr<function, Row>) {
    let opacity = f32(color >> 24u) / 255.0;
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    let first_pixel = (row / SAMPLE_ROWS) * TILE_PX;
    for (var word = 0u; word < WORDS; word++) {
        rounds++;
        let all = (*gathered)[word];
        let fresh = select(all & ~covered[word], all, IS_DENSITY);
        (*gathered)[word] = 0u;
        for (var left = fresh; left != 0u;) {
            rounds++;
            let of_word = firstTrailingBit(left) / SAMPLES_A_ROW;
            let bits = bits_of_pixel(left, of_word);
            left &= ~(bits << (of_word * SAMPLES_A_ROW));
            let pixel = first_pixel + word * pixels_a_word + of_word;
            if IS_DENSITY {
                atomicAdd(&sums[pixel * 4u], countOneBits(bits));
            } else {
                add(pixel, color, take(word * 32u + of_word * SAMPLES_A_ROW, bits, opacity));
            }
        }
        if !IS_DENSITY && opacity >= 1.0 {
            covered[word] |= fresh;
        }
    }
}

// Brings some lines of a list together, each for the rows in which it may show.
fn gather(tile: Tile, thread: u32, first: u32, end: u32) {
    if thread < TILE_PX * TURN_WORDS {
        atomicStore(&lines_of_row[thread], 0u);
    }
    workgroupBarrier();
    if thread < TURN && first + thread < end {
        let capsule = capsule_at(tile, first + thread);
        let rank = line_ranks[references[first + thread]];
        capsules[thread] = capsule;
        ranks[thread] = rank;
        colors[thread] = style_of(rank).color;
        for (var left = rows_shown(capsule); left != 0u; left &= left - 1u) {
            let word = firstTrailingBit(left) * TURN_WORDS + thread / 32u;
            atomicOr(&lines_of_row[word], 1u << (thread % 32u));
        }
    }
    workgroupBarrier();
}

var<workgroup> any_holds: atomic<u32>;
var<workgroup> does_any: u32;

// Whether something holds for any thread.
fn any_of(thread: u32, holds: bool) -> bool {
    if thread == 0u {
        atomicStore(&any_holds, 0u);
    }
    workgroupBarrier();
    if holds {
        atomicStore(&any_holds, 1u);
    }
    workgroupBarrier();
    if thread == 0u {
        does_any = atomicLoad(&any_holds);
    }
    return workgroupUniformLoad(&does_any) != 0u;
}

// Closes the pixels that opaque paths have filled, and says whether any is left.
fn stays_open(thread: u32) -> bool {
    let pixels_a_word = 32u / SAMPLES_A_ROW;
    var left = 0u;
    for (var word = 0u; word < WORDS; word++) {
        left |= (full_pixels(covered[word]) ^ low_bits(pixels_a_word)) << (word * pixels_a_word);
    }
    if thread < TILE_PX {
        atomicStore(&open[thread], 0u);
    }
    workgroupBarrier();
    atomicOr(&open[thread / SAMPLE_ROWS], left);
    return any_of(thread, left != 0u);
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
    let list = list_of(index);
    if list.x >= list.y {
        write(tile, thread, select(frame.background, 0u, IS_DENSITY));
        return;
    }
    for (var channel = 0u; channel < 4u; channel++) {
        atomicStore(&sums[thread * 4u + channel], 0u);
    }
    begin_rounds(thread);
    open_all(tile, thread);
    covered = beyond(tile, thread);
    if !IS_DENSITY {
        for (var i = 0u; i < WORDS * 32u; i++) {
            clear[i] = 1.0;
            rounds++;
        }
    }
    workgroupBarrier();
    var rank = 0xffffffffu;
    var color = 0u;
    var gathered: Row;
    for (var first = list.x; first < list.y; first += TURN) {
        gather(tile, thread, first, list.y);
        // Of a turn, and of gathering and closing.
        rounds += 1u + TURN_WORDS + 3u * TILE_PX;
        for (var word = 0u; word < TURN_WORDS; word++) {
            var left = atomicLoad(&lines_of_row[(thread / SAMPLE_ROWS) * TURN_WORDS + word]);
            for (; left != 0u; left &= left - 1u) {
                rounds += 1u + WORDS;
                let line = word * 32u + firstTrailingBit(left);
                if ranks[line] != rank {
                    lay(thread, color, &gathered);
                    rank = ranks[line];
                    color = colors[line];
                }
                cover(&gathered, capsules[line], thread);
            }
        }
        if IS_DENSITY {
            workgroupBarrier();
        } else if !stays_open(thread) {
            break;
        }
    }
    lay(thread, color, &gathered);
    end_rounds();
    workgroupBarrier();
    tell_rounds(thread);
    let samples = f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    var sum: vec4u;
    for (var channel = 0u; channel < 4u; channel++) {
        sum[channel] = atomicLoad(&sums[thread * 4u + channel]);
    }
    if IS_DENSITY {
        write(tile, thread, bitcast<u32>(f32(sum.x) / samples));
    } else {
        let shares = vec4f(sum) / (samples * PARTS);
        write(tile, thread, over_background(shares.rgb, shares.a / 255.0));
    }
}
