// Converts meters to pixels. Subtracting the center first is exact for points near the view.
vec2 pixel_from_world(vec2 point_m) {
    precise vec2 offset_m = (point_m - center_high_m) - center_low_m;
    precise vec2 pixel = vec2(offset_m.x, -offset_m.y) * px_per_m;
    return pixel;
}
