// From the world to the picture.

fn pixel_from_view(point_m: vec2f) -> vec2f {
    let px = point_m * frame.px_per_m;
    return vec2f(frame.half_size_px.x + px.x, frame.half_size_px.y - px.y);
}

fn radius_px(width_m: f32) -> f32 {
    if width_m < 0.0 || frame.most_radius_px < 0.0 {
        return frame.radius_px;
    }
    return max(min(width_m * frame.px_per_m * 0.5, frame.most_radius_px), frame.least_radius_px);
}

// What is drawn of the picture: its upper left and lower right corner.
struct Window {
    low_px: vec2f,
    high_px: vec2f,
}

fn window() -> Window {
    let first = vec2u(frame.first_column, frame.first_row);
    let end = first + vec2u(frame.columns, frame.rows);
    let size_px = vec2u(frame.width_px, frame.height_px);
    return Window(vec2f(first * TILE_PX), vec2f(min(end * TILE_PX, size_px)));
}

// Whether something within a box, and as far around it, may leave a mark on what is drawn.
fn is_seen(low_px: vec2f, high_px: vec2f, reach_px: f32) -> bool {
    let window = window();
    return all(high_px >= window.low_px - reach_px) && all(low_px <= window.high_px + reach_px);
}
