// From the world to the level that lines are made for, and what is seen of the picture.

// A point from the middle of the level. As in the picture, y goes down.
fn level_px(point_m: vec2f) -> vec2f {
    return vec2f(point_m.x, -point_m.y) * frame.level_px_per_m;
}

// Where a place of the level is in the picture.
fn px_from_level(place: vec2f) -> vec2f {
    return place * frame.px_a_level_px + frame.line_origin_px;
}

fn radius_px(width_m: f32) -> f32 {
    if width_m < 0.0 || frame.most_radius_px < 0.0 {
        return frame.radius_px;
    }
    return max(min(width_m * frame.px_per_m * 0.5, frame.most_radius_px), frame.least_radius_px);
}

// Half a width and a pixel around it, in pixels of the level.
fn reach_of(radius_px: f32) -> f32 {
    return (radius_px + 1.0) * frame.level_px_a_px;
}

// Whether a box of the level, and as far around it, reaches into what lines are made of.
fn is_made(box: vec4f, reach: f32) -> bool {
    return all(box.zw >= frame.made_low_px - reach) && all(box.xy <= frame.made_high_px + reach);
}

// Whether it may leave a mark on what is drawn.
fn is_drawn(box: vec4f, reach: f32) -> bool {
    return all(box.zw >= frame.drawn_low_px - reach) && all(box.xy <= frame.drawn_high_px + reach);
}
