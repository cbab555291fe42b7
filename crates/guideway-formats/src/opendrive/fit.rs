//! Lines beside a reference line, as cubics within a proven error.

use guideway_spline::{Point, Runs};

use super::polynomial::Cubic;
use super::reference::{Line, direction_bounds, left_of};

/// How often a stretch is halved at most: each time, the error falls to a sixteenth.
const MOST_HALVINGS: u32 = 14;

/// A stretch of a line beside a reference line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch<'l> {
    pub(super) line: &'l Line,
    /// From the start of the reference line, in meters.
    pub(super) start_m: f64,
    pub(super) length_m: f64,
    /// How far it is to the left, by the distance from the start of the stretch.
    pub(super) offset: Cubic,
}

impl Stretch<'_> {
    /// Appends cubics that are nowhere farther than the tolerance from the line, if so many are not more than
    /// `most_points`. Returns the bound of the error: above the tolerance only where halving ended.
    pub(super) fn append(&self, tolerance_m: f64, most_points: u64, runs: &mut Runs) -> f64 {
        self.halve(MOST_HALVINGS, tolerance_m, most_points, runs)
    }

    fn halve(&self, left: u32, tolerance_m: f64, most_points: u64, runs: &mut Runs) -> f64 {
        let error = self.error_bound();
        if left == 0 || error <= tolerance_m || runs.points().len() as u64 > most_points {
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
        let [a, b] = [first, second].map(|s| s.halve(left - 1, tolerance_m, most_points, runs));
        a.max(b)
    }

    /// The cubic with the place and the derivative of the line at both ends.
    fn push(&self, runs: &mut Runs) {
        let third = self.length_m / 3.0;
        let [(start, from), (end, to)] = [0.0, self.length_m].map(|s| self.at(s));
        runs.push_bezier(&[start, start + from * third, end - to * third, end]);
    }

    /// The place and the derivative at a distance from the start of the stretch: of P + t n, with the normal
    /// n to the left and n' = - heading' e.
    fn at(&self, s: f64) -> (Point<f64>, Point<f64>) {
        let motion = self.line.at(self.start_m + s);
        let [t, dt] = self.offset.at(s);
        let ahead = motion.velocity * (1.0 / motion.velocity.norm());
        let left = left_of(ahead);
        if t == 0.0 && dt == 0.0 {
            return (motion.position, motion.velocity);
        }
        (
            motion.position + left * t,
            motion.velocity - ahead * (t * motion.turn) + left * dt,
        )
    }

    /// A bound of the distance between the line and its cubic, at equal parameters.
    ///
    /// A cubic with the values and derivatives of a function at both ends of a stretch of length h is at most
    /// h^4 / 384 max |f''''| from it (Birkhoff and Priver 1967), also in the plane, for it holds of every
    /// projection on a line. The fourth derivative of t n is the sum of its parts by the rule of Leibniz.
    fn error_bound(&self) -> f64 {
        const BINOMIALS: [f64; 5] = [1.0, 4.0, 6.0, 4.0, 1.0];
        let wildness = self.line.wildness(self.start_m, self.length_m);
        let offsets = self.offset.bounds(self.length_m);
        let directions = direction_bounds(wildness.heading);
        let parts = (0..5).map(|k| match offsets[k] {
            // Where there is no offset, a heading without bounds does not matter.
            0.0 => 0.0,
            offset => BINOMIALS[k] * offset * directions[4 - k],
        });
        let fourth = wildness.position + parts.sum::<f64>();
        self.length_m.powi(4) / 384.0 * fourth
    }
}
