// One thread for one line after the other: enters it into the lists of the tiles that it may touch.

@group(0) @binding(5) var<storage, read_write> filled: array<atomic<u32>>;
@group(0) @binding(6) var<storage, read_write> references: array<u32>;

var<workgroup> end_line: u32;

// Reserves places in the lists of the tiles that were counted: a tally becomes the next of them.
fn reserve(thread: u32) {
    for (var place = thread; place < TALLY_PLACES; place += THREADS) {
        let count = atomicLoad(&tallies[place]);
        if count > 0u {
            let tile = atomicLoad(&tally_tiles[place]);
            atomicStore(&tallies[place], atomicAdd(&filled[tile], count));
            atomics(1u);
        }
    }
}

// Tallies the tiles of a line, or enters it into their lists once places are reserved.
fn visit(index: u32, line: vec4f, reach: f32, enters: bool) {
    let rows = rows_of(line, reach);
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            let place = tally_place(row, column, tile);
            var entry = FULL;
            if place != NO_TILE {
                entry = atomicAdd(&tallies[place], 1u);
            } else if enters {
                entry = atomicAdd(&filled[tile], 1u);
                atomics(1u);
            }
            if enters && entry < FULL {
                references[entry] = index;
                writes(1u);
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
        // What has no room is drawn again with more.
        let end = frame.first_line + atomicLoad(&found.counters.lines);
        let fits = end <= frame.line_room
            && atomicLoad(&found.counters.references) <= frame.reference_room;
        end_line = select(0u, end, fits);
    }
    let end = workgroupUniformLoad(&end_line);
    let step = count.x * count.y * THREADS;
    var first = frame.first_line - frame.kept_lines + workgroup_index(id, count) * THREADS;
    for (; first < end; first += step) {
        clear_tallies(thread);
        workgroupBarrier();
        let index = first + thread;
        var words = vec3u(NOWHERE);
        var line: vec4f;
        var reach = 0.0;
        if index < end {
            words = words_of_line(index);
        }
        if words.x != NOWHERE {
            line = line_of(words);
            reach = reach_of_line(index);
            visit(index, line, reach, false);
        }
        workgroupBarrier();
        reserve(thread);
        workgroupBarrier();
        if words.x != NOWHERE {
            visit(index, line, reach, true);
        }
        workgroupBarrier();
    }
    report_work();
}
