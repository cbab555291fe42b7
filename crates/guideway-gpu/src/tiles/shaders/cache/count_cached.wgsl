// Counts cached lines per tile.
//
// Bindings: frame, counters, lines, line_ranks, styles -> tile_counts. A workgroup takes batches of
// THREADS x LINES_EACH lines; a thread counts LINES_EACH lines in the workgroup's histogram.

// import: shared/line_pass.wgsl
// import: shared/workgroup_histogram.wgsl

// Lines per thread and batch.
override LINES_EACH: u32;

@group(0) @binding(5) var<storage, read_write> tile_counts: array<atomic<u32>>;

fn add_to_tile(tile: u32, lines: u32) {
    atomicAdd(&tile_counts[tile], lines);
    count_atomics(1u);
}

fn count_line(line: vec4f, reach: f32) {
    let rows = tile_rows(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = tile_columns(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            let slot = histogram_slot(row, column, tile);
            if slot == NO_TILE {
                add_to_tile(tile, 1u);
            } else {
                atomicAdd(&histogram_counts[slot], 1u);
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
    var first = workgroup_index(id, groups) * lines_together;
    for (; first < frame.cached_lines; first += step) {
        clear_histogram(thread);
        workgroupBarrier();
        let end = min(first + lines_together, frame.cached_lines);
        for (var line = first + thread; line < end; line += THREADS) {
            let words = words_of_line(line);
            if words.x != NO_LINE {
                count_line(line_of(words), line_reach_px(line));
            }
        }
        workgroupBarrier();
        for (var slot = thread; slot < HISTOGRAM_SLOTS; slot += THREADS) {
            let lines_there = atomicLoad(&histogram_counts[slot]);
            if lines_there > 0u {
                add_to_tile(atomicLoad(&histogram_tiles[slot]), lines_there);
            }
        }
        workgroupBarrier();
    }
    report_work();
}
