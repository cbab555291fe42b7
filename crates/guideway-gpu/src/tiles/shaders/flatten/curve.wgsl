// Evaluates a stroke's curve in LOD pixels, and bounds the error of its chords.

// import: flatten/bindings.wgsl
// import: flatten/points_{points}.wgsl

// Start of a segment: equation 3.2 of the thesis at t = 0.
fn knot_px(curve: Curve, segment: u32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    return (a + 4.0 * b + c) / 6.0;
}

// A point of a segment: equation 3.2.
fn curve_px(curve: Curve, segment: u32, t: f32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    let d = control_px(curve, segment + 3u);
    return blend_control_px(a, b, c, d, t);
}

fn blend_control_px(a: vec2f, b: vec2f, c: vec2f, d: vec2f, t: f32) -> vec2f {
    let s = 1.0 - t;
    let t2 = t * t;
    let t3 = t2 * t;
    return (s * s * s * a + (3.0 * t3 - 6.0 * t2 + 4.0) * b
        + (3.0 * (t + t2 - t3) + 1.0) * c + t3 * d) / 6.0;
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
    let bend = a - 2.0 * b + c;
    return dot(bend, bend);
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

// Number of lines, equally spaced in t, that one segment needs by the same bound.
fn segment_lines(squared_bend: f32) -> u32 {
    let steps = sqrt(sqrt(squared_bend) / (8.0 * frame.tolerance_px));
    return u32(clamp(ceil(steps), 1.0, MAX_STEPS));
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
