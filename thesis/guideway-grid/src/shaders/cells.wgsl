// The uniform grid over the scene, and the cell of a point.

// Cells per side.
override CELLS: u32;

struct Grid {
    // Lower left corner, in meters from the local origin.
    origin_m: vec2f,
    // 0 along a side without length, which has a single cell.
    cells_per_m: vec2f,
    // Distance beyond its bounds at which a cell still lists a line.
    reach_m: f32,
}

@group(0) @binding(1) var<uniform> grid: Grid;

// Column and row of a point's cell; outside the grid, of the nearest cell (thesis, figure 4.4).
fn cell_of(point_m: vec2f) -> vec2u {
    let cell = floor((point_m - grid.origin_m) * grid.cells_per_m);
    return vec2u(clamp(cell, vec2f(0.0), vec2f(f32(CELLS - 1u))));
}
