// Finds the tiles that a line with round caps may touch. Ranges exclude their end.

// import: shared/frame.wgsl
// import: shared/rounding.wgsl

// Bound of the rounding error of a position in the picture.
const ROUNDING_MARGIN_PX: f32 = 1.0 / 64.0;

fn clamp_tiles(low_px: f32, high_px: f32, first: u32, end: u32) -> vec2u {
    if high_px < 0.0 {
        return vec2u(first, first);
    }
    let low = clamp(u32(max(low_px, 0.0)) / TILE_PX, first, end);
    return vec2u(low, clamp(u32(high_px) / TILE_PX + 1u, low, end));
}

// Range of tile rows.
fn tile_rows(line: vec4f, reach_px: f32) -> vec2u {
    let top = min(line.y, line.w) - reach_px;
    let bottom = max(line.y, line.w) + reach_px;
    return clamp_tiles(top, bottom, frame.first_row, frame.first_row + frame.rows);
}

fn clamp_columns(low_px: f32, high_px: f32) -> vec2u {
    return clamp_tiles(low_px, high_px, frame.first_column, frame.first_column + frame.columns);
}

// Range of tile columns in one tile row: around the part of the line within reach of the row.
fn tile_columns(line: vec4f, reach_px: f32, row: u32) -> vec2u {
    var ends = line.xz;
    let height = line.w - line.y;
    // Below one pixel the slope is not worth a division, and not safe for one.
    if abs(height) > 1.0 {
        let top = f32(row * TILE_PX) - reach_px;
        let bottom = f32((row + 1u) * TILE_PX) + reach_px;
        let t = clamp((vec2f(top, bottom) - line.y) / height, vec2f(0.0), vec2f(1.0));
        ends = rounded2((line.z - line.x) * t) + line.x;
    }
    let low = min(ends.x, ends.y) - reach_px;
    let high = max(ends.x, ends.y) + reach_px;
    return clamp_columns(low, high);
}

fn tile_index(row: u32, column: u32) -> u32 {
    return (row - frame.first_row) * frame.columns + column - frame.first_column;
}
