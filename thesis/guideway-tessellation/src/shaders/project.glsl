// From meters to pixels. The difference comes first: what is near the view loses nothing by it.
vec2 pixel_from_world(vec2 point_m) {
    precise vec2 away_m = (point_m - center_high_m) - center_low_m;
    precise vec2 pixel = vec2(away_m.x, -away_m.y) * px_per_m;
    return pixel;
}
