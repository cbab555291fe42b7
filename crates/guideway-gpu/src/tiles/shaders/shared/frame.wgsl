// Parameters of one frame, the same for all kernels. Rust: `FrameParams`.

// Side of a tile in pixels.
override TILE_PX: u32;

struct Frame {
    // The level of detail (LOD) that lines are flattened for; views of similar scale and place
    // share one. Its center is split into two floats that together are as exact as a double.
    center_high_m: vec2f,
    center_low_m: vec2f,
    // Half the extent of the LOD: lines are clipped there. In LOD pixels from the center.
    lod_reach_px: vec2f,
    // The area that lines are flattened for, and the window to draw, in LOD pixels: minimum and
    // maximum corner.
    flatten_low_px: vec2f,
    flatten_high_px: vec2f,
    window_low_px: vec2f,
    window_high_px: vec2f,
    // Center of the LOD in the picture.
    lod_origin_px: vec2f,
    // Images of the vectors (1, 0) and (0, 1) in the map of a gesture.
    map_x: vec2f,
    map_y: vec2f,
    lod_px_per_m: f32,
    // LOD pixels per picture pixel, and the inverse.
    lod_px_per_px: f32,
    px_per_lod_px: f32,
    // Scale of the picture.
    px_per_m: f32,
    // Radius of strokes without a width of their own.
    radius_px: f32,
    // Limits of the radius of all other strokes; a negative maximum: no stroke has its own width.
    min_radius_px: f32,
    max_radius_px: f32,
    // Greatest distance of a line from its curve, in LOD pixels.
    tolerance_px: f32,
    clusters: u32,
    // Number of styles; 1 if all paths share one.
    styles: u32,
    // Size of the picture, and the window of tiles to draw.
    width_px: u32,
    height_px: u32,
    first_column: u32,
    columns: u32,
    first_row: u32,
    rows: u32,
    // First pixel row that the pixel buffer holds.
    first_pixel_row: u32,
    // Capacities of the line buffer and of the reference lists.
    line_capacity: u32,
    reference_capacity: u32,
    // RGBA, red in the lowest byte.
    color: u32,
    background: u32,
    // Clusters with a larger quantization step are drawn from exact points.
    max_step_m: f32,
    // 1 if lines have draw ranks: not needed if all paths look alike.
    has_ranks: u32,
    // Index of the first new line, and whether new lines enter the line cache.
    first_line: u32,
    caches_lines: u32,
    // Number of clusters whose lines are flattened again; 0: all clusters.
    dirty_clusters: u32,
    // Number of cached lines to draw, and threads per cached line in `bin_cached`.
    cached_lines: u32,
    threads_per_line: u32,
    // List entries per tile in `bin_cached`; 0: lists are sized by counting.
    list_capacity: u32,
    // Fixed-point steps of line ends per LOD pixel, and picture pixels per step.
    steps_per_px: f32,
    px_per_step: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Flag in a tile's count: the tile is full, further lines cannot change it.
const FULL: u32 = 0x80000000u;

// Index of a workgroup: dispatches are two-dimensional, in rows.
fn workgroup_index(id: vec3u, count: vec3u) -> u32 {
    return id.y * count.x + id.x;
}
