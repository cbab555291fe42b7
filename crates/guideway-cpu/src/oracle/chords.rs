//! From a cubic segment to chords that never leave it by more than a two-thousandth of a pixel.

use guideway_spline::{Bounds, Point};

/// Greatest distance between a curve and its chord.
const CHORD_ERROR_PX: f64 = 1.0 / 2000.0;
/// Halvings after which even a segment from one end of the world to the other is a point on the screen.
const MOST_HALVINGS: u32 = 100;

/// Which chords are wanted.
pub(super) struct Chords {
    /// Parts of a curve outside this box are left out.
    pub(super) near_px: Bounds<f64>,
    /// Longer chords are split, so that the box around each holds few samples.
    pub(super) longest_px: f64,
}

impl Chords {
    /// Visits the chords of one segment of a uniform cubic B-spline (thesis eq. 3.2).
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
        self.of_bezier(&bezier, MOST_HALVINGS, visit);
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
        let is_short = hull.size().x.max(hull.size().y) <= self.longest_px;
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

/// Bound of the distance between curve and chord: an eighth of the greatest second derivative, which is
/// six times a second difference of the control points.
fn chord_error(bezier: &[Point<f64>; 4]) -> f64 {
    let [a, b, c, d] = *bezier;
    let first = a - b * 2.0 + c;
    let second = b - c * 2.0 + d;
    0.75 * first.x.hypot(first.y).max(second.x.hypot(second.y))
}
