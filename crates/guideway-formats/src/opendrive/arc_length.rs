//! Maps distances along a parametric cubic to its parameter: u(p) and v(p) in, p by arc length out.
//!
//! OpenDRIVE states lanes by the distance s along the road, and polynomials by a parameter whose
//! speed varies. The table of [`ArcLength`] has panels on which quadrature is exact to rounding;
//! Newton's method inverts the length within a panel.

use guideway_spline::Point;

use super::polynomial::Cubic;
use super::quadrature::gauss;

/// Largest relative change of the speed on a panel. Derived: eight Gauss nodes are then exact to
/// rounding.
const MAX_SPEED_CHANGE: f64 = 0.5;

/// Halvings of the parameter range. Derived: at a cusp, where no halving suffices, the error is
/// that of a panel of 2^-12 of the curve.
const MAX_HALVINGS: u32 = 12;

/// A parametric cubic and its arc length.
#[derive(Clone, Debug)]
pub(super) struct ArcLength {
    pub(super) u: Cubic,
    pub(super) v: Cubic,
    /// Parameter and arc length at the start of each panel, and at the end.
    table: Vec<[f64; 2]>,
}

impl ArcLength {
    /// Measures the curve on the parameters from 0 to `end`. `None` if its length is not a positive
    /// number.
    pub(super) fn new(u: Cubic, v: Cubic, end: f64) -> Option<Self> {
        let mut arc = Self {
            u,
            v,
            table: vec![[0.0, 0.0]],
        };
        if !(u.is_finite() && v.is_finite() && end.is_finite()) {
            return None;
        }
        arc.halve([0.0, end], MAX_HALVINGS);
        let total = arc.total();
        (total.is_finite() && total > 0.0).then_some(arc)
    }

    /// Number of panels.
    pub(super) fn panel_count(&self) -> u64 {
        self.table.len() as u64 - 1
    }

    /// The length of the whole curve.
    pub(super) fn total(&self) -> f64 {
        self.table.last().map_or(0.0, |[_, length]| *length)
    }

    /// The derivative by the parameter.
    pub(super) fn first(&self, p: f64) -> Point<f64> {
        Point::new(self.u.at(p)[1], self.v.at(p)[1])
    }

    /// The second derivative by the parameter.
    pub(super) fn second(&self, p: f64) -> Point<f64> {
        Point::new(self.u.second(p), self.v.second(p))
    }

    /// Tells if the curve stands still at a parameter, where it has no heading.
    pub(super) fn is_still(&self, p: f64) -> bool {
        /// Share of the mean speed that rounding leaves of 0.
        const ROUNDING: f64 = 1e-9;
        let [end, total] = self.table[self.table.len() - 1];
        self.first(p).norm() <= ROUNDING * total / end
    }

    /// The least speed that is certain, and the greatest second derivative, on a range.
    pub(super) fn speed_bounds(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let max_second = self.second(from).norm().max(self.second(to).norm());
        let middle = self.first(0.5 * (from + to)).norm();
        [middle - 0.5 * (to - from) * max_second, max_second]
    }

    /// The parameter at a distance along the curve; beyond its ends by their speed.
    pub(super) fn parameter(&self, distance: f64) -> f64 {
        let after = self
            .table
            .partition_point(|[_, length]| *length <= distance);
        let index = after.clamp(1, self.table.len() - 1);
        let ([low, start], [high, end]) = (self.table[index - 1], self.table[index]);
        let mut p = low + (high - low) * (distance - start) / (end - start);
        let (mut from, mut to) = (low, high);
        // Newton's method doubles the number of right digits; bisection bounds it at a cusp.
        for _ in 0..60 {
            let miss = start + self.length(low, p) - distance;
            if miss > 0.0 {
                to = p;
            } else {
                from = p;
            }
            let mut next = p - miss / self.first(p).norm();
            let is_inside = (from..=to).contains(&next);
            if !is_inside && (start..=end).contains(&distance) {
                next = 0.5 * (from + to);
            }
            if !next.is_finite() || (next - p).abs() <= f64::EPSILON * high.abs() {
                break;
            }
            p = next;
        }
        p
    }

    fn length(&self, from: f64, to: f64) -> f64 {
        gauss(from, to - from, |p| self.first(p).norm())
    }

    fn halve(&mut self, range: [f64; 2], halvings: u32) {
        let [from, to] = range;
        let [least, max_second] = self.speed_bounds(range);
        let is_smooth = max_second * (to - from).abs() <= MAX_SPEED_CHANGE * least;
        if is_smooth || halvings == 0 {
            let length = self.total() + self.length(from, to);
            self.table.push([to, length]);
            return;
        }
        let middle = 0.5 * (from + to);
        self.halve([from, middle], halvings - 1);
        self.halve([middle, to], halvings - 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_are_those_of_a_fine_polyline() {
        let cubic = |a, b, c, d| Cubic { a, b, c, d };
        for (u, v) in [
            (cubic(0.0, 12.0, -9.0, 2.1), cubic(0.0, 0.0, -15.8, 7.45)),
            (cubic(0.0, 1.0, 0.0, 0.0), cubic(0.0, 0.0, 5.0, -3.0)),
            // A cusp at the start.
            (cubic(0.0, 0.0, 9.0, 0.0), cubic(0.0, 0.0, 0.0, 9.0)),
        ] {
            let arc = ArcLength::new(u, v, 1.0).unwrap();
            const STEPS: u32 = 200_000;
            let point = |i: u32| {
                let p = f64::from(i) / f64::from(STEPS);
                Point::new(u.at(p)[0], v.at(p)[0])
            };
            let mut length = 0.0;
            for i in 1..=STEPS {
                length += point(i).distance(point(i - 1));
                if i % 20_000 == 0 {
                    let found = arc.parameter(length);
                    let expected = f64::from(i) / f64::from(STEPS);
                    assert!((found - expected).abs() < 1e-7, "{found}, not {expected}");
                }
            }
            assert!((arc.total() - length).abs() < 1e-6);
        }
    }

    #[test]
    fn a_point_has_no_length() {
        assert!(ArcLength::new(Cubic::default(), Cubic::default(), 1.0).is_none());
    }
}
