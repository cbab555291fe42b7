// Some lines a thread, of those that are there from a frame before: counts the tiles that each may touch.

// So many that are tallied together.
override LINES_EACH: u32;

@group(0) @binding(5) var<storage, read_write> counts: array<atomic<u32>>;

fn count(tile: u32, lines: u32) {
    atomicAdd(&counts[tile], lines);
    atomics(1u);
}

fn tally(line: vec4f, reach: f32) {
    let rows = rows_of(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            let place = tally_place(row, column, tile);
            if place == NO_TILE {
                count(tile, 1u);
            } else {
                atomicAdd(&tallies[place], 1u);
            }
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    let lines_together = THREADS * LINES_EACH;
    let step = groups.x * groups.y * lines_together;
    for (var first = workgroup_index(id, groups) * lines_together; first < frame.kept_lines; first += step) {
        clear_tallies(thread);
        workgroupBarrier();
        let end = min(first + lines_together, frame.kept_lines);
        for (var line = first + thread; line < end; line += THREADS) {
            let words = words_of_line(line);
            if words.x != NOWHERE {
                tally(line_of(words), reach_of_line(line));
            }
        }
        workgroupBarrier();
        for (var place = thread; place < TALLY_PLACES; place += THREADS) {
            let lines_there = atomicLoad(&tallies[place]);
            if lines_there > 0u {
                count(atomicLoad(&tally_tiles[place]), lines_there);
            }
        }
        workgroupBarrier();
    }
    report_work();
}
