// Writes a line, as far as it is in reach of its level, and counts it for the tiles that it may touch.

// Whether all of the cluster is within that reach, so that nothing of it needs to be cut.
var<private> is_inside: bool;

// Counts a line for each tile that it may touch; in the last round only for those that are not full. Returns whether there is any.
fn count_tiles(line: vec4f, reach: f32) -> bool {
    let rows = rows_of(line, reach);
    var is_any = false;
    for (var row = rows.x; row < rows.y; row++) {
        let columns = columns_of(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            if chunk.round < 2u || !is_full(tile) {
                atomicAdd(&counts[tile], 1u);
                atomics(1u);
                is_any = true;
            }
        }
    }
    return is_any;
}

fn leave_out(slot: u32) {
    lines[slot * LINE_WORDS] = NOWHERE;
    writes(1u);
}

fn emit(slot: u32, rank: u32, a: vec2f, b: vec2f, radius: f32) {
    if slot >= frame.line_room {
        return;
    }
    var line = vec4f(a, b);
    if !is_inside {
        let part = within_reach(a, b);
        if part.x > part.y {
            leave_out(slot);
            return;
        }
        // Ends inside stay as they are, to the bit.
        line = vec4f(
            select(a, a + (b - a) * part.x, part.x > 0.0),
            select(b, a + (b - a) * part.y, part.y < 1.0),
        );
    }
    let words = packed_line(line);
    let is_needed = count_tiles(line_of(words), radius + MARGIN_PX);
    // Those of earlier rounds may be needed by a frame to come.
    if chunk.round == 2u && !is_needed {
        leave_out(slot);
        return;
    }
    for (var i = 0u; i < LINE_WORDS; i++) {
        lines[slot * LINE_WORDS + i] = words[i];
    }
    writes(LINE_WORDS);
    if frame.has_ranks != 0u {
        line_ranks[slot] = rank;
        writes(1u);
    }
}
