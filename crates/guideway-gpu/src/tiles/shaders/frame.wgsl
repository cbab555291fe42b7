// One frame: the same for all clusters, strokes, lines and tiles of it.

// Side of a tile in pixels.
override TILE_PX: u32;

struct Frame {
    // The level that lines are made for: views of about one scale and place share it. Its middle is in two parts each, together
    // as exact as doubles; its pixels count from there.
    center_high_m: vec2f,
    center_low_m: vec2f,
    // How far from there lines may reach, in pixels of the level.
    reach_px: vec2f,
    // The part of it that lines are made of, and what is drawn: upper left and lower right corner.
    made_low_px: vec2f,
    made_high_px: vec2f,
    drawn_low_px: vec2f,
    drawn_high_px: vec2f,
    // Where the middle of the level is in the picture.
    line_origin_px: vec2f,
    level_px_per_m: f32,
    // Pixels of the level that one of the picture is, and the other way round.
    level_px_a_px: f32,
    px_a_level_px: f32,
    // Of the picture.
    px_per_m: f32,
    // Half the width of strokes that have none of their own.
    radius_px: f32,
    // What half the width of others is held between; none has one where the greatest is below zero.
    least_radius_px: f32,
    most_radius_px: f32,
    // How far a line may be from its curve, in pixels of the level.
    tolerance_px: f32,
    clusters: u32,
    // Styles there are; one that stands for all if there is one.
    styles: u32,
    // The picture, and the window of tiles that is drawn of it.
    width_px: u32,
    height_px: u32,
    first_column: u32,
    columns: u32,
    first_row: u32,
    rows: u32,
    // The picture's row of pixels that the buffer of pixels begins with.
    pixels_row: u32,
    // How many lines, and references of tiles to lines, there is room for.
    line_room: u32,
    reference_room: u32,
    // Colors as in the picture's bytes, red first.
    color: u32,
    background: u32,
    // Points in larger steps would be off too far: their clusters are drawn from exact points.
    most_step_m: f32,
    // Whether lines have ranks; they need none where all paths look alike.
    has_ranks: u32,
    // Where the lines that are made begin, and whether they are to be kept.
    first_line: u32,
    keeps_lines: u32,
    // Clusters that were touched: lines of no others are made.
    touched: u32,
    // Lines before those that are drawn, too, and threads that list each of them.
    kept_lines: u32,
    threads_a_line: u32,
    // Places that the list of each tile has; none where they are reserved by what is counted.
    list_room: u32,
    // Steps that ends of lines are counted in: so many a pixel of the level, and pixels of the picture that one is.
    steps_a_px: f32,
    px_a_step: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Set in the count of a tile that is full: what lies there changes nothing.
const FULL: u32 = 0x80000000u;

// Index of a workgroup: they are dispatched in rows.
fn workgroup_index(id: vec3u, count: vec3u) -> u32 {
    return id.y * count.x + id.x;
}
