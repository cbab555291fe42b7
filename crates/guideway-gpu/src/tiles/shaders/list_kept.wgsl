// Threads for one line after the other, of those that are there from a frame before: enters it into the lists of the tiles that
// it may touch. Each tile has places for as many; what has none is counted.

@group(0) @binding(5) var<storage, read_write> counts: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> references: array<u32>;

fn enter(tile: u32, line: u32) {
    let place = atomicAdd(&counts[tile], 1u);
    atomics(1u);
    if place < frame.list_room {
        references[tile * frame.list_room + place] = line;
        writes(1u);
    } else {
        atomicMax(&found.counters.longest, place + 1u);
        atomics(1u);
    }
}

// Enters a line for one of several threads that share its tiles.
fn enter_share(index: u32, line: vec4f, reach: f32, share: u32) {
    let shares = frame.threads_a_line;
    let rows = rows_of(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        // Of lines that stand upright, rows take turns.
        for (var column = columns.x + (share + row) % shares; column < columns.y; column += shares) {
            enter(tile_index(row, column), index);
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let first = workgroup_index(id, count) * THREADS + thread;
    let all = frame.kept_lines * frame.threads_a_line;
    for (var i = first; i < all; i += count.x * count.y * THREADS) {
        let index = i / frame.threads_a_line;
        let words = words_of_line(index);
        if words.x != NOWHERE {
            enter_share(index, line_of(words), reach_of_line(index), i % frame.threads_a_line);
        }
    }
    report_work();
}
