// Converts between world, LOD and picture coordinates, and tests boxes against the window.

// import: shared/frame.wgsl
// import: shared/rounding.wgsl

// Converts meters from the LOD center to LOD pixels; y points down, as in the picture.
fn lod_from_m(point_m: vec2f) -> vec2f {
    return rounded2(vec2f(point_m.x, -point_m.y) * frame.lod_px_per_m);
}

// Converts LOD pixels to picture pixels.
fn px_from_lod(place: vec2f) -> vec2f {
    return rounded2(place * frame.px_per_lod_px) + frame.lod_origin_px;
}

fn radius_px(width_m: f32) -> f32 {
    if width_m < 0.0 || frame.max_radius_px < 0.0 {
        return frame.radius_px;
    }
    return max(min(width_m * frame.px_per_m * 0.5, frame.max_radius_px), frame.min_radius_px);
}

// Distance from its curve up to which a stroke can touch a sample: its radius and one pixel. In
// LOD pixels.
fn lod_reach(radius_px: f32) -> f32 {
    return rounded((radius_px + 1.0) * frame.lod_px_per_px);
}

// Returns whether a box grown by `reach` intersects the area that lines are flattened for.
fn intersects_flatten_area(box: vec4f, reach: f32) -> bool {
    return all(box.zw >= frame.flatten_low_px - reach)
        && all(box.xy <= frame.flatten_high_px + reach);
}

// Returns whether a box grown by `reach` intersects the window to draw.
fn intersects_window(box: vec4f, reach: f32) -> bool {
    return all(box.zw >= frame.window_low_px - reach)
        && all(box.xy <= frame.window_high_px + reach);
}
