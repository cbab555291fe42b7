// Which tiles a line may touch.

// What rounding may do to a place in the picture.
const MARGIN_PX: f32 = 1.0 / 64.0;

fn tiles_between(low_px: f32, high_px: f32, first: u32, end: u32) -> vec2u {
    if high_px < 0.0 {
        return vec2u(first, first);
    }
    let low = clamp(u32(max(low_px, 0.0)) / TILE_PX, first, end);
    return vec2u(low, clamp(u32(high_px) / TILE_PX + 1u, low, end));
}

// The rows of tiles, from the first to behind the last.
fn rows_of(line: vec4f, reach_px: f32) -> vec2u {
    let top = min(line.y, line.w) - reach_px;
    let bottom = max(line.y, line.w) + reach_px;
    return tiles_between(top, bottom, frame.first_row, frame.first_row + frame.rows);
}

fn columns_between(low_px: f32, high_px: f32) -> vec2u {
    return tiles_between(low_px, high_px, frame.first_column, frame.first_column + frame.columns);
}

// The tiles of one row: those near the part of the line that is within reach of the row.
fn columns_of(line: vec4f, reach_px: f32, row: u32) -> vec2u {
    var ends = line.xz;
    let height = line.w - line.y;
    // Within a pixel, slopes are not worth a division, nor safe for one.
    if abs(height) > 1.0 {
        let top = f32(row * TILE_PX) - reach_px;
        let bottom = f32((row + 1u) * TILE_PX) + reach_px;
        let t = clamp((vec2f(top, bottom) - line.y) / height, vec2f(0.0), vec2f(1.0));
        ends = fma(vec2f(line.z - line.x), t, vec2f(line.x));
    }
    let low = min(ends.x, ends.y) - reach_px;
    let high = max(ends.x, ends.y) + reach_px;
    return columns_between(low, high);
}

fn tile_index(row: u32, column: u32) -> u32 {
    return (row - frame.first_row) * frame.columns + column - frame.first_column;
}
