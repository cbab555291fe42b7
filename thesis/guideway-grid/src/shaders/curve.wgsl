// A point of the uniform cubic B-spline (thesis, equation 3.2), relative to its second control
// point.
fn point(p0: vec2f, p2: vec2f, p3: vec2f, t: f32) -> vec2f {
    let s = 1.0 - t;
    let b2 = ((3.0 - 3.0 * t) * t + 3.0) * t + 1.0;
    return (p0 * (s * s * s) + p2 * b2 + p3 * (t * t * t)) / 6.0;
}
