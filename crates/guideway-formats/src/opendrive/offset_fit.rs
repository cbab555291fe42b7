//! Fits cubics to offset curves of the geometry line, within a proven error bound.
//!
//! ```text
//!        t(s) ^   ______----   offset curve P(s) + t(s) n(s)
//!             |--'
//!     --------+------------->  geometry line P(s), normal n to the left
//! ```
//!
//! Each segment becomes the cubic Hermite interpolant of its ends; segments above the tolerance are
//! halved. Source of the bound: Birkhoff and Priver (1967). Cost: O(cubics).

use guideway_spline::{Point, Runs};

use super::geometry::{Geometry, direction_bounds, left_normal};
use super::polynomial::Cubic;

/// Halvings of a segment. Derived: each one divides the error by 16, so 14 reach the rounding error
/// of any smooth curve.
const MAX_HALVINGS: u32 = 14;

/// A segment of an offset curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct OffsetSegment<'l> {
    pub(super) line: &'l Geometry,
    /// Start along `line`, in meters.
    pub(super) start_m: f64,
    pub(super) length_m: f64,
    /// Offset to the left, in meters, by the distance from the start of the segment.
    pub(super) offset: Cubic,
}

impl OffsetSegment<'_> {
    /// Appends cubics within `tolerance_m` of the curve, or the curve itself if it is cubic. Stops
    /// halving beyond `max_points` control points or [`MAX_HALVINGS`]. Returns the error bound, in
    /// meters.
    pub(super) fn append(&self, tolerance_m: f64, max_points: u64, runs: &mut Runs) -> f64 {
        let is_line = self.offset == Cubic::default();
        match self.line.bezier(self.start_m, self.length_m) {
            Some(bezier) if is_line => {
                runs.push_bezier(&bezier);
                0.0
            }
            _ => self.halve(MAX_HALVINGS, tolerance_m, max_points, runs),
        }
    }

    fn halve(&self, halvings: u32, tolerance_m: f64, max_points: u64, runs: &mut Runs) -> f64 {
        let error = self.error_bound();
        if halvings == 0 || error <= tolerance_m || runs.points().len() as u64 > max_points {
            self.push(runs);
            return error;
        }
        let half_m = 0.5 * self.length_m;
        let first = Self {
            length_m: half_m,
            ..*self
        };
        let second = Self {
            start_m: self.start_m + half_m,
            length_m: half_m,
            offset: self.offset.about(half_m),
            ..*self
        };
        let [a, b] = [first, second].map(|s| s.halve(halvings - 1, tolerance_m, max_points, runs));
        a.max(b)
    }

    /// Appends the cubic with the position and the derivative of the curve at both ends.
    fn push(&self, runs: &mut Runs) {
        let third = self.length_m / 3.0;
        let [(start, from), (end, to)] = [0.0, self.length_m].map(|s| self.at(s));
        runs.push_bezier(&[start, start + from * third, end - to * third, end]);
    }

    /// Position and derivative of P + t n at a distance from the start. With the unit tangent e,
    /// the left normal n has the derivative n' = -heading' e.
    fn at(&self, s: f64) -> (Point<f64>, Point<f64>) {
        let point = self.line.at(self.start_m + s);
        let [t, dt] = self.offset.at(s);
        let tangent = point.derivative * (1.0 / point.derivative.norm());
        let normal = left_normal(tangent);
        if t == 0.0 && dt == 0.0 {
            return (point.position, point.derivative);
        }
        (
            point.position + normal * t,
            point.derivative - tangent * (t * point.heading_rate) + normal * dt,
        )
    }

    /// Bound of the distance between the curve and its cubic at equal parameters, in meters.
    ///
    /// The cubic Hermite interpolant of f over a length h is within h^4 / 384 max |f''''| of f
    /// (Birkhoff and Priver 1967). The bound holds in the plane because it holds for the projection
    /// on every line. The Leibniz rule gives the fourth derivative of t n.
    fn error_bound(&self) -> f64 {
        const BINOMIALS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
        let bounds = self.line.derivative_bounds(self.start_m, self.length_m);
        let read_lane_offset = self.offset.bounds(self.length_m);
        let directions = direction_bounds(bounds.heading);
        let terms = (0..5).map(|k| match read_lane_offset[k] {
            // Avoids 0 * infinity where the heading is unbounded.
            0.0 => 0.0,
            offset => BINOMIALS[k] * offset * directions[4 - k],
        });
        let fourth = bounds.position + terms.sum::<f64>();
        self.length_m.powi(4) / 384.0 * fourth
    }
}
