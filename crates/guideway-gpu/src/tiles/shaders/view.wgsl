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

// Whether something within a box, and as far around it, may leave a mark on the picture.
fn is_seen(low_px: vec2f, high_px: vec2f, reach_px: f32) -> bool {
    let size_px = vec2f(f32(frame.width_px), f32(frame.height_px));
    return all(high_px >= vec2f(-reach_px)) && all(low_px <= size_px + reach_px);
}
