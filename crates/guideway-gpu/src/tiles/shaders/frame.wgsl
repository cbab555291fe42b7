// One frame: the same for all clusters, strokes, lines and tiles of it.

// Side of a tile in pixels.
override TILE_PX: u32;

struct Frame {
    // The middle of the view in two parts each, together as exact as doubles.
    center_high_m: vec2f,
    center_low_m: vec2f,
    half_size_px: vec2f,
    px_per_m: f32,
    // Half the width of strokes that have none of their own.
    radius_px: f32,
    // What half the width of others is held between; none has one where the greatest is below zero.
    least_radius_px: f32,
    most_radius_px: f32,
    // How far a line may be from its curve.
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
    // Colours as in the picture's bytes, red first.
    color: u32,
    background: u32,
    // Points in larger steps would be off too far: their clusters are drawn from exact points.
    most_step_m: f32,
    // Whether lines have ranks; they need none where all paths look alike.
    has_ranks: u32,
    // Ends of lines are counted in steps from here, along both axes.
    line_low_px: f32,
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
