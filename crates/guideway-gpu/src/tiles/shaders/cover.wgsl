// Tiles of a scene of one opaque colour: it does not matter which line covers a sample.

@group(0) @binding(7) var<storage, read_write> counts: array<u32>;
@group(0) @binding(8) var<storage, read_write> found: Found;

var<workgroup> was_full: u32;
// Covered samples of all rows.
var<workgroup> samples: array<atomic<u32>, THREADS * WORDS>;
// How many pixels are open.
var<workgroup> open_pixels: atomic<u32>;
// What all threads go by: pixels that are open, and lines and rows that wait.
var<workgroup> state: vec3u;

// Begins with nothing covered.
fn clear(tile: Tile, thread: u32) {
    let size = open_all(tile, thread);
    if thread == 0u {
        atomicStore(&open_pixels, size.x * size.y);
        nothing_waits();
    }
    for (var word = 0u; word < WORDS; word++) {
        atomicStore(&samples[thread * WORDS + word], 0u);
    }
}

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

fn is_open(pixel: u32) -> bool {
    return (atomicLoad(&open[pixel / TILE_PX]) & (1u << (pixel % TILE_PX))) != 0u;
}

// Closes an open pixel if so many covered samples are all that it has.
fn close(pixel: u32, count: u32) {
    if count == SAMPLE_ROWS * SAMPLES_A_ROW {
        atomicAnd(&open[pixel / TILE_PX], ~(1u << (pixel % TILE_PX)));
        atomicSub(&open_pixels, 1u);
    }
}

// Closes a pixel once all of its samples are covered.
fn close_if_covered(pixel: u32) {
    if is_open(pixel) {
        close(pixel, count_of(pixel));
    }
}

// Covers a row of samples that a line touches.
fn cover_row(capsule: Capsule, row: u32) {
    let span = span_of(capsule, row);
    var word = row * WORDS + span.x / 32u;
    var bit = span.x % 32u;
    for (var left = span.y - span.x; left > 0u; word++) {
        let here = min(left, 32u - bit);
        atomicOr(&samples[word], (ALL >> (32u - here)) << bit);
        left -= here;
        bit = 0u;
    }
}

// How many pixels are open, for all threads.
fn count_open(thread: u32) -> u32 {
    if thread == 0u {
        state = vec3u(atomicLoad(&open_pixels), 0u, 0u);
    }
    return workgroupUniformLoad(&state).x;
}

// Covers lines as they come, each thread for itself. Few are shared out by their rows, so that all threads have work.
fn cover_short(tile: Tile, thread: u32, list: vec2u) {
    let most = LINES_A_THREAD * THREADS;
    for (var first = list.x; first < list.y; first += most) {
        let lines = min(most, list.y - first);
        let parts = max(THREADS >> (32u - countLeadingZeros(lines - 1u)), 1u);
        for (var line = thread / parts; line < lines; line += THREADS / parts) {
            let capsule = capsule_at(tile, first + line);
            let touched = rows_touched(capsule);
            for (var row = touched.x + thread % parts; row < touched.y; row += parts) {
                cover_row(capsule, row);
            }
        }
        workgroupBarrier();
        if first + most < list.y {
            close_if_covered(thread);
            workgroupBarrier();
            if count_open(thread) == 0u {
                break;
            }
        }
    }
}

// Covers the lines of a list in turns, each of lines from all over it, for neighbours in the list lie near each other:
// what the first ones have filled, the others need not.
fn cover_long(tile: Tile, thread: u32, list: vec2u) {
    let turns = THREADS / LOOKS;
    let turn_here = thread / LOOKS;
    let nth = (thread % LOOKS) * turns + turn_here;
    let rounds = (list.y - list.x + THREADS - 1u) / THREADS;
    var capsule: Capsule;
    for (var turn = 0u; turn < rounds * turns; turn++) {
        let place = list.x + nth * rounds + turn / turns;
        let is_line = place < list.y;
        if turn % turns == 0u && is_line {
            capsule = capsule_at(tile, place);
        }
        if turn % turns == turn_here && is_line {
            let shown = rows_shown(capsule);
            if shown != 0u {
                wait(capsule, shown);
            }
        }
        workgroupBarrier();
        if thread == 0u {
            state = vec3u(atomicLoad(&open_pixels), atomicLoad(&waiting_lines), atomicLoad(&waiting_rows));
        }
        let now = workgroupUniformLoad(&state);
        if now.x == 0u {
            break;
        }
        if now.y > LOOKS || now.z >= ENOUGH || turn + 1u == rounds * turns {
            cover_waiting(thread, now.z);
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
        reads(1u);
    }
    // Its pixels are written already.
    if workgroupUniformLoad(&was_full) != 0u {
        report_work();
        return;
    }
    let list = list_of(index);
    reads(2u);
    if list.x >= list.y {
        write(tile, thread, frame.background);
        report_work();
        return;
    }
    clear(tile, thread);
    workgroupBarrier();
    if list.y - list.x <= SHORT {
        cover_short(tile, thread, list);
    } else {
        cover_long(tile, thread, list);
    }
    let count_here = count_of(thread);
    if is_open(thread) {
        close(thread, count_here);
    }
    workgroupBarrier();
    if thread == 0u && atomicLoad(&open_pixels) == 0u {
        counts[index] |= FULL;
        atomicAdd(&found.counters.full_tiles, 1u);
        atomics(1u);
    }
    let share = f32(count_here) / f32(SAMPLE_ROWS * SAMPLES_A_ROW);
    write(tile, thread, over_background(channels(frame.color).rgb * share, share));
    report_work();
}
