// Points of a stroke's curve, in pixels of the level, and lines that are near enough to it.

// Where a segment begins: the thesis' equation 3.2 at t = 0.
fn vertex_px(curve: Curve, segment: u32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    return (a + 4.0 * b + c) / 6.0;
}

// A point of a segment: equation 3.2.
fn point_px(curve: Curve, segment: u32, t: f32) -> vec2f {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    let d = control_px(curve, segment + 3u);
    return mixed_px(a, b, c, d, t);
}

fn mixed_px(a: vec2f, b: vec2f, c: vec2f, d: vec2f, t: f32) -> vec2f {
    let s = 1.0 - t;
    let t2 = t * t;
    let t3 = t2 * t;
    return (s * s * s * a + (3.0 * t3 - 6.0 * t2 + 4.0) * b + (3.0 * (t + t2 - t3) + 1.0) * c + t3 * d) / 6.0;
}

// The square of the second derivative of a stroke's curve at the knot before a segment, where t runs over one
// in each segment: the second difference of control points. Between knots it runs straight.
fn square_bend(curve: Curve, knot: u32) -> f32 {
    return square_bend_of(control_px(curve, knot), control_px(curve, knot + 1u), control_px(curve, knot + 2u));
}

fn square_bend_of(a: vec2f, b: vec2f, c: vec2f) -> f32 {
    let bend = a - 2.0 * b + c;
    return dot(bend, bend);
}

// Whether one line may stand for some segments. Their curve has a continuous first derivative, so the chord of h of
// them is off by at most an eighth of the square of h times the greatest second derivative.
fn is_flat(segments: u32, square_bend: f32) -> bool {
    let square = f32(segments * segments);
    let most = 8.0 * frame.tolerance_px;
    return square * square * square_bend <= most * most;
}

// Most lines of one segment.
const MOST_STEPS: f32 = 4096.0;

// How many lines of equal steps in t one segment needs, by the same bound.
fn steps_of(square_bend: f32) -> u32 {
    let steps = sqrt(sqrt(square_bend) / (8.0 * frame.tolerance_px));
    return u32(clamp(ceil(steps), 1.0, MOST_STEPS));
}

// The box of all control points of a stroke: upper left and lower right corner.
fn box_of(curve: Curve, segments: u32) -> vec4f {
    var low = control_px(curve, 0u);
    var high = low;
    for (var i = 1u; i < segments + 3u; i++) {
        let p = control_px(curve, i);
        low = min(low, p);
        high = max(high, p);
    }
    return vec4f(low, high);
}
