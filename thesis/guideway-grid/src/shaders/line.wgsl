// The distance of a point to a line.

// Keeps the squared length of a line that is a point above zero, for the division.
const MIN_LENGTH_SQUARED: f32 = 1.2e-38;

// The square of the distance of a point to a line, by projection (thesis, equation 4.1).
fn distance_squared(point_m: vec2f, line_m: vec4f) -> f32 {
    let along = line_m.zw - line_m.xy;
    let from_start = point_m - line_m.xy;
    let length_squared = max(dot(along, along), MIN_LENGTH_SQUARED);
    let fraction = clamp(dot(from_start, along) / length_squared, 0.0, 1.0);
    let offset = from_start - along * fraction;
    return dot(offset, offset);
}
