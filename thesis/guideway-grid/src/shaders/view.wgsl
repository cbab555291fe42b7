// What is seen: the same for all pixels of a picture.

struct View {
    // The middle of the picture, in meters from the middle of the scene.
    center_m: vec2f,
    half_size_px: vec2f,
    // Outside of this box nothing is drawn.
    box_low_m: vec2f,
    box_high_m: vec2f,
    // How far beyond the cells where it is entered a line may be seen.
    excess_m: f32,
    m_per_px: f32,
    px_per_m: f32,
    radius_m: f32,
    // Colors as in the picture's bytes: red first.
    color: u32,
    background: u32,
    // The band of rows that is drawn.
    width_px: u32,
    first_row: u32,
    rows: u32,
    // Which of the band's tiles, row by row; and behind the last.
    first_tile: u32,
    end_tile: u32,
    // Which rows of the cells that a pixel looks into, and which lines of each cell.
    first_cell_row: u32,
    end_cell_row: u32,
    first_line: u32,
    end_line: u32,
    // A picture takes one pass or several; it is complete with the last.
    is_first_pass: u32,
    is_last_pass: u32,
}

@group(0) @binding(0) var<uniform> view: View;
