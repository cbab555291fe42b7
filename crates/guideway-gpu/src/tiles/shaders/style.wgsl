// What paths look like, by draw rank.

struct Style {
    // As in the picture's bytes, red first.
    color: u32,
    // Below zero if it has no width of its own.
    width_m: f32,
}

fn style_of(rank: u32) -> Style {
    reads(2u);
    return styles[min(rank, frame.styles - 1u)];
}

// Half the width of a path; it is only looked at if any has a width of its own.
fn radius_of(rank: u32) -> f32 {
    if frame.most_radius_px < 0.0 {
        return frame.radius_px;
    }
    return radius_px(style_of(rank).width_m);
}
