// Appends each line to the lists of the tiles that it may touch.
//
// Bindings: frame, counters, lines, line_ranks, styles -> list_cursors, references. A thread takes
// one line after the other: counts its tiles in the workgroup's histogram, waits until entries are
// reserved for all counts, and writes its references.

// import: shared/line_pass.wgsl
// import: shared/workgroup_histogram.wgsl

@group(0) @binding(5) var<storage, read_write> list_cursors: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> references: array<u32>;

var<workgroup> end_line: u32;

// Reserves list entries for all counted tiles: a slot then holds the next free entry.
fn reserve(thread: u32) {
    for (var slot = thread; slot < HISTOGRAM_SLOTS; slot += THREADS) {
        let count = atomicLoad(&histogram_counts[slot]);
        if count > 0u {
            let tile = atomicLoad(&histogram_tiles[slot]);
            atomicStore(&histogram_counts[slot], atomicAdd(&list_cursors[tile], count));
            count_atomics(1u);
        }
    }
}

// Counts the tiles of a line, or appends the line to their lists once entries are reserved.
fn visit(index: u32, line: vec4f, reach: f32, enters: bool) {
    let rows = tile_rows(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = tile_columns(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            let slot = histogram_slot(row, column, tile);
            var entry = FULL;
            if slot != NO_TILE {
                entry = atomicAdd(&histogram_counts[slot], 1u);
            } else if enters {
                entry = atomicAdd(&list_cursors[tile], 1u);
                count_atomics(1u);
            }
            if enters && entry < FULL {
                references[entry] = index;
                count_writes(1u);
            }
        }
    }
}

@compute @workgroup_size(THREADS)
fn main(
    @builtin(workgroup_id) id: vec3u,
    @builtin(num_workgroups) count: vec3u,
    @builtin(local_invocation_index) thread: u32,
) {
    if thread == 0u {
        // If a capacity was too small, the host grows it and draws again.
        let end = frame.first_line + atomicLoad(&counters.totals.lines);
        let fits = end <= frame.line_capacity
            && atomicLoad(&counters.totals.references) <= frame.reference_capacity;
        end_line = select(0u, end, fits);
    }
    let end = workgroupUniformLoad(&end_line);
    let step = count.x * count.y * THREADS;
    var first = frame.first_line - frame.cached_lines + workgroup_index(id, count) * THREADS;
    for (; first < end; first += step) {
        clear_histogram(thread);
        workgroupBarrier();
        let index = first + thread;
        var words = vec3u(NO_LINE);
        var line: vec4f;
        var reach = 0.0;
        if index < end {
            words = words_of_line(index);
        }
        if words.x != NO_LINE {
            line = line_of(words);
            reach = line_reach_px(index);
            visit(index, line, reach, false);
        }
        workgroupBarrier();
        reserve(thread);
        workgroupBarrier();
        if words.x != NO_LINE {
            visit(index, line, reach, true);
        }
        workgroupBarrier();
    }
    report_work();
}
