//! Splits a cubic segment into chords within 1/2000 px of it (de Casteljau subdivision).

use guideway_spline::{Bounds, Point};

/// Largest distance of a chord from its curve. Derived: far below the spacing of samples, 1/16 px.
const CHORD_ERROR_PX: f64 = 1.0 / 2000.0;
/// Most halvings of a segment. Derived: shrinks any segment of finite coordinates below a pixel.
const MAX_HALVINGS: u32 = 100;

/// Limits of the chords.
pub(super) struct Chords {
    /// Drops the parts of a curve outside this box.
    pub(super) near_px: Bounds<f64>,
    /// Splits longer chords, so that the box of each holds few samples.
    pub(super) max_length_px: f64,
}

impl Chords {
    /// Calls `visit` with the chords of one segment of a uniform cubic B-spline (thesis eq. 3.2).
    pub(super) fn of_segment(
        &self,
        control: &[Point<f64>; 4],
        visit: &mut impl FnMut(Point<f64>, Point<f64>),
    ) {
        let [p0, p1, p2, p3] = *control;
        let bezier = [
            (p0 + p1 * 4.0 + p2) * (1.0 / 6.0),
            (p1 * 2.0 + p2) * (1.0 / 3.0),
            (p1 + p2 * 2.0) * (1.0 / 3.0),
            (p1 + p2 * 4.0 + p3) * (1.0 / 6.0),
        ];
        self.of_bezier(&bezier, MAX_HALVINGS, visit);
    }

    fn of_bezier(
        &self,
        bezier: &[Point<f64>; 4],
        halvings_left: u32,
        visit: &mut impl FnMut(Point<f64>, Point<f64>),
    ) {
        // The curve lies in the hull of its control points.
        let [a, b, c, d] = *bezier;
        let hull = [b, c, d]
            .iter()
            .fold(Bounds { min: a, max: a }, |hull, &p| {
                hull.union(Bounds { min: p, max: p })
            });
        if !hull.intersects(self.near_px) {
            return;
        }
        let is_short = hull.size().x.max(hull.size().y) <= self.max_length_px;
        if halvings_left == 0 || (is_short && chord_error(bezier) <= CHORD_ERROR_PX) {
            return visit(a, d);
        }
        // De Casteljau at the middle.
        let middle = |p: Point<f64>, q: Point<f64>| (p + q) * 0.5;
        let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
        let (abc, bcd) = (middle(ab, bc), middle(bc, cd));
        let abcd = middle(abc, bcd);
        self.of_bezier(&[a, ab, abc, abcd], halvings_left - 1, visit);
        self.of_bezier(&[abcd, bcd, cd, d], halvings_left - 1, visit);
    }
}

/// Upper bound of the distance between curve and chord: 1/8 of the largest second derivative, which
/// is 6 times the larger second difference of the control points.
fn chord_error(bezier: &[Point<f64>; 4]) -> f64 {
    let [a, b, c, d] = *bezier;
    let first = a - b * 2.0 + c;
    let second = b - c * 2.0 + d;
    0.75 * first.x.hypot(first.y).max(second.x.hypot(second.y))
}
