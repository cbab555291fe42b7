// The view: parameters that all pixels of a dispatch share.

struct View {
    // Center of the picture, in meters from the local origin.
    center_m: vec2f,
    half_size_px: vec2f,
    // Bounds of everything drawn.
    box_low_m: vec2f,
    box_high_m: vec2f,
    // Distance by which a line may be visible beyond the cells that list it.
    excess_m: f32,
    m_per_px: f32,
    px_per_m: f32,
    radius_m: f32,
    // Colors in the byte order of a picture: red first.
    color: u32,
    background: u32,
    // The band of pixel rows.
    width_px: u32,
    first_row: u32,
    rows: u32,
    // Range of the band's tiles, row by row.
    first_tile: u32,
    end_tile: u32,
    // Range of the cell rows that a pixel reads, and of the lines of each cell.
    first_cell_row: u32,
    end_cell_row: u32,
    first_line: u32,
    end_line: u32,
    // A picture takes one or more passes; the last one writes colors.
    is_first_pass: u32,
    is_last_pass: u32,
}

@group(0) @binding(0) var<uniform> view: View;
