// Tiles in which some paths are translucent, or density: lists are in falling draw rank, and strokes of one path stand together.
// What a path covers is gathered first, and then laid below all that was laid before. Each row of pixels goes through the lines that
// reach into open pixels of it.

// Whether it is not colors that are shown, but how many paths cover a pixel.
override IS_DENSITY: bool;

var<workgroup> capsules: array<Capsule, TURN>;
var<workgroup> ranks: array<u32, TURN>;
var<workgroup> colors: array<u32, TURN>;
// Red, green, blue, and how much is hidden, for each pixel.
var<workgroup> sums: array<atomic<u32>, THREADS * 4>;

@group(0) @binding(7) var<storage, read_write> found: Found;

// What still shines through at each sample of this thread's row.
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

// Lays a color over what was gathered of a row, where nothing hides it, and gathers anew.
fn lay(row: u32, color: u32, gathered: ptr<function, Row>) {
    let opacity = f32(color >> 24u) / 255.0;
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
            let pixel = first_pixel + word * PIXELS_A_WORD + of_word;
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
    clear_rows(thread);
    if thread < TURN && first + thread < end {
        let capsule = capsule_at(tile, first + thread);
        let rank = line_ranks[references[first + thread]];
        reads(2u);
        capsules[thread] = capsule;
        ranks[thread] = rank;
        colors[thread] = style_of(rank).color;
        enter_rows(thread, capsule);
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
    let list = list_of(index);
    if thread == 0u {
        reads(2u);
    }
    if list.x >= list.y {
        write(tile, thread, select(frame.background, 0u, IS_DENSITY));
        report_work();
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
            var left = lines_through(thread, word);
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
    report_work();
}
