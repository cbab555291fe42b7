// The width of a line, by its stroke.

// Half the width of a stroke; it is only looked at if any has a width of its own.
fn radius_of(stroke: u32) -> f32 {
    if frame.most_radius_px < 0.0 {
        return frame.radius_px;
    }
    return radius_px(strokes[stroke].width_m);
}
