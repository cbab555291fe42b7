// Points of a stroke's curve, in pixels, and lines that are near enough to it.

// Most control points of a cluster.
override POINTS: u32;

// Those of the cluster that the workgroup is at.
var<workgroup> points_px: array<vec2f, POINTS>;

// The stroke that a thread works on.
struct Curve {
    first_point: u32,
}

fn control_px(curve: Curve, index: u32) -> vec2f {
    return points_px[curve.first_point + index];
}

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
    let s = 1.0 - t;
    let t2 = t * t;
    let t3 = t2 * t;
    return (s * s * s * a + (3.0 * t3 - 6.0 * t2 + 4.0) * b + (3.0 * (t + t2 - t3) + 1.0) * c + t3 * d) / 6.0;
}

fn square_to_line(p: vec2f, a: vec2f, along: vec2f, per_square: f32) -> f32 {
    let t = clamp(dot(p - a, along) * per_square, 0.0, 1.0);
    let off = p - a - t * along;
    return dot(off, off);
}

// Whether the chord of some segments is near enough to their curve. A curve lies within the hull of its
// Bezier points, and that within the tolerance around the chord if all the points are. The other way round,
// the curve goes from one end of the chord to the other, so no part of the chord is farther from it.
fn is_flat(curve: Curve, first: u32, count: u32) -> bool {
    let a = vertex_px(curve, first);
    let along = vertex_px(curve, first + count) - a;
    let square = dot(along, along);
    let per_square = select(0.0, 1.0 / square, square > 0.0);
    let most = frame.tolerance_px * frame.tolerance_px;
    for (var i = first; i < first + count; i++) {
        let b = control_px(curve, i + 1u);
        let c = control_px(curve, i + 2u);
        let d = control_px(curve, i + 3u);
        let near = (2.0 * b + c) / 3.0;
        let far = (b + 2.0 * c) / 3.0;
        let end = (b + 4.0 * c + d) / 6.0;
        let worst = max(
            max(square_to_line(near, a, along, per_square), square_to_line(far, a, along, per_square)),
            square_to_line(end, a, along, per_square),
        );
        if worst > most {
            return false;
        }
    }
    return true;
}

// Most lines of one segment.
const MOST_STEPS: f32 = 4096.0;

// How many lines of equal steps in t a segment needs: its second derivative runs between two differences,
// and a chord is off by at most an eighth of it times the square of the step.
fn steps_of(curve: Curve, segment: u32) -> u32 {
    let a = control_px(curve, segment);
    let b = control_px(curve, segment + 1u);
    let c = control_px(curve, segment + 2u);
    let d = control_px(curve, segment + 3u);
    let bend = max(length(a - 2.0 * b + c), length(b - 2.0 * c + d));
    return u32(clamp(ceil(sqrt(bend / (8.0 * frame.tolerance_px))), 1.0, MOST_STEPS));
}
