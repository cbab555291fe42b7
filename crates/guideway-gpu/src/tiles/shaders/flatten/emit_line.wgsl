// Writes a line, clipped to the LOD, and counts it for the tiles that it may touch.

// import: flatten/cluster_pass.wgsl
// import: flatten/clip_line.wgsl

// Counts a line for each tile that it may touch; in occlusion pass 2 only for tiles that are not
// full. Returns whether there is such a tile.
fn count_tiles(line: vec4f, reach: f32) -> bool {
    let rows = tile_rows(line, reach);
    var is_any = false;
    for (var row = rows.x; row < rows.y; row++) {
        let columns = tile_columns(line, reach, row);
        for (var column = columns.x; column < columns.y; column++) {
            let tile = tile_index(row, column);
            if dispatch.occlusion_pass < 2u || !is_full(tile) {
                atomicAdd(&tile_counts[tile], 1u);
                count_atomics(1u);
                is_any = true;
            }
        }
    }
    return is_any;
}

fn write_culled_line(slot: u32) {
    lines[slot * LINE_WORDS] = NO_LINE;
    count_writes(1u);
}

// `path_ends`: whether a path starts at the start, and whether it ends at the end.
fn emit_line(
    slot: u32,
    rank: u32,
    start: vec2f,
    end: vec2f,
    path_ends: vec2<bool>,
    radius: f32,
) {
    if slot >= frame.line_capacity {
        return;
    }
    var line = vec4f(start, end);
    var ends = path_ends;
    if !is_inside {
        let a = rounded2(start);
        let b = rounded2(end);
        let part = clip_to_lod(a, b);
        if part.x > part.y {
            write_culled_line(slot);
            return;
        }
        // Ends inside keep their bits.
        line = vec4f(
            select(a, a + rounded2((b - a) * part.x), part.x > 0.0),
            select(b, a + rounded2((b - a) * part.y), part.y < 1.0),
        );
        ends &= vec2<bool>(part.x <= 0.0, part.y >= 1.0);
    }
    let words = packed_line(line, ends);
    let is_flattened = count_tiles(line_of(words), radius + ROUNDING_MARGIN_PX);
    // A later frame may need hidden lines of the other passes.
    if dispatch.occlusion_pass == 2u && !is_flattened {
        write_culled_line(slot);
        return;
    }
    for (var i = 0u; i < LINE_WORDS; i++) {
        lines[slot * LINE_WORDS + i] = words[i];
    }
    count_writes(LINE_WORDS);
    if frame.has_ranks != 0u {
        line_ranks[slot] = rank;
        count_writes(1u);
    }
}
