// The cells that overlap a line's bounds, inflated by the reach (thesis, figures 4.4 and 4.5). The
// parts of `items` are rows of these cells.

struct CellBox {
    low: vec2u,
    high: vec2u,
}

@group(0) @binding(2) var<storage, read> lines_m: array<vec4f>;

fn cells_of(line_m: vec4f) -> CellBox {
    let low_m = min(line_m.xy, line_m.zw) - grid.reach_m;
    let high_m = max(line_m.xy, line_m.zw) + grid.reach_m;
    var cells = CellBox(cell_of(low_m), cell_of(high_m));
    cells.high.y = cells.low.y + min(cells.high.y - cells.low.y, items.end_part - 1u);
    cells.low.y += items.first_part;
    return cells;
}
