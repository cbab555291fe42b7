// Appends cached lines to tile lists of fixed capacity, without counting first. An overflow raises
// `longest_list`, and the host bins again by counting.
//
// Bindings: frame, lines, line_ranks, styles -> counters, tile_counts, references.
// `threads_per_line` threads share the tiles of a line.

// import: shared/line_pass.wgsl

@group(0) @binding(5) var<storage, read_write> tile_counts: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> references: array<u32>;

fn append(tile: u32, line: u32) {
    let slot = atomicAdd(&tile_counts[tile], 1u);
    count_atomics(1u);
    if slot < frame.list_capacity {
        references[tile * frame.list_capacity + slot] = line;
        count_writes(1u);
    } else {
        atomicMax(&counters.totals.longest_list, slot + 1u);
        count_atomics(1u);
    }
}

// Appends a line to its share of the tiles: every `threads`-th column.
fn append_to_tiles(index: u32, line: vec4f, reach: f32, part: u32) {
    let threads = frame.threads_per_line;
    let rows = tile_rows(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = tile_columns(line, reach, row);
        // The first column shifts with the row, so that threads also share vertical lines.
        let first = columns.x + (part + row) % threads;
        for (var column = first; column < columns.y; column += threads) {
            append(tile_index(row, column), index);
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
    let all = frame.cached_lines * frame.threads_per_line;
    for (var i = first; i < all; i += count.x * count.y * THREADS) {
        let index = i / frame.threads_per_line;
        let words = words_of_line(index);
        if words.x != NO_LINE {
            let part = i % frame.threads_per_line;
            append_to_tiles(index, line_of(words), line_reach_px(index), part);
        }
    }
    report_work();
}
