// A uniform grid over the scene.

// Cells along each side.
override CELLS: u32;

struct Grid {
    // Lower left corner, in meters from the middle of the scene.
    origin_m: vec2f,
    // 0 along a side that has no length: there is one cell then.
    cells_per_m: vec2f,
    // How far beyond its box a line is entered.
    reach_m: f32,
}

@group(0) @binding(1) var<uniform> grid: Grid;

// Column and row of a point; of the nearest cell if it is outside (thesis, figure 4.4).
fn cell_of(point_m: vec2f) -> vec2u {
    let cell = floor((point_m - grid.origin_m) * grid.cells_per_m);
    return vec2u(clamp(cell, vec2f(0.0), vec2f(f32(CELLS - 1u))));
}
