// Evaluates a stroke's curve in LOD pixels, and bounds the error of its chords.

// import: flatten/bindings.wgsl
// import: flatten/points_{points}.wgsl

// Start of a segment: equation 3.2 of the thesis at t = 0.
fn knot_px(curve: Curve, segment: u32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    return knot_between(a, b, c);
}

fn knot_between(a: vec2f, b: vec2f, c: vec2f) -> vec2f {
    return (a + exact2(4.0 * b) + c) * (1.0 / 6.0);
}

// A point of a segment: equation 3.2.
fn curve_px(curve: Curve, segment: u32, t: f32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    let d = control_px(curve, segment + 3u);
    return blend_control_px(a, b, c, d, t);
}

// Equation 3.2 by powers of t, in the scheme of Horner.
fn blend_control_px(a: vec2f, b: vec2f, c: vec2f, d: vec2f, t: f32) -> vec2f {
    let third = rounded2((d - a) * (1.0 / 6.0)) + exact2(0.5 * (b - c));
    let second = exact2(0.5 * (a - exact2(2.0 * b) + c)) + rounded2(t * third);
    let first = exact2(0.5 * (c - a)) + rounded2(t * second);
    return rounded2(knot_between(a, b, c)) + rounded2(t * first);
}

// Squared second derivative of the curve at the knot before a segment (t runs over 1 per segment):
// the second difference of the control points. Between knots it is linear.
fn squared_bend(curve: Curve, knot: u32) -> f32 {
    let a = control_px(curve, knot);
    let b = control_px(curve, knot + 1u);
    let c = control_px(curve, knot + 2u);
    return squared_bend_of(a, b, c);
}

fn squared_bend_of(a: vec2f, b: vec2f, c: vec2f) -> f32 {
    let bend = a - exact2(2.0 * b) + c;
    let squares = rounded2(bend * bend);
    return squares.x + squares.y;
}

// Returns whether one line may replace some segments. The curve has a continuous first derivative,
// so the chord of h segments is off by at most h^2 / 8 times the greatest second derivative.
fn is_flat(segments: u32, squared_bend: f32) -> bool {
    let square = f32(segments * segments);
    let most = 8.0 * frame.tolerance_px;
    return square * square * squared_bend <= most * most;
}

// Most lines per segment.
const MAX_STEPS: f32 = 4096.0;

// Number of lines, equally spaced in t, that one segment needs by the same bound. The roots of
// devices differ: they only lead to the number or the one before.
fn segment_lines(squared_bend: f32) -> u32 {
    let most = 8.0 * frame.tolerance_px;
    let near = clamp(floor(sqrt(sqrt(squared_bend) / most) + 0.5), 1.0, MAX_STEPS);
    let square = near * near;
    let is_enough = square * square * (most * most) >= squared_bend || near == MAX_STEPS;
    return u32(near) + select(1u, 0u, is_enough);
}

// Bounding box of all control points of a stroke: minimum and maximum corner.
fn control_box(curve: Curve, segments: u32) -> vec4f {
    var low = control_px(curve, 0u);
    var high = low;
    for (var i = 1u; i < segments + 3u; i++) {
        let p = control_px(curve, i);
        low = min(low, p);
        high = max(high, p);
    }
    return vec4f(low, high);
}
