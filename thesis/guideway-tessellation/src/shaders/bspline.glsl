// A point of a segment of a uniform cubic B-spline (thesis, equation 3.2), in pixels.
vec2 bspline(vec2 p0, vec2 p1, vec2 p2, vec2 p3, float t) {
    // The columns are the rows of the equation's matrix.
    const mat4 basis = mat4(
        -1.0, 3.0, -3.0, 1.0,
        3.0, -6.0, 3.0, 0.0,
        -3.0, 0.0, 3.0, 0.0,
        1.0, 4.0, 1.0, 0.0
    );
    precise vec4 weights = basis * vec4(t * t * t, t * t, t, 1.0) / 6.0;
    precise vec2 point = weights.x * p0 + weights.y * p1 + weights.z * p2 + weights.w * p3;
    return point;
}
