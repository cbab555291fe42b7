//! Conversion of NURBS, Bezier curves and polylines to runs.
//!
//! Curves without weights up to degree 3 convert exactly. For all others the module fits cubics and
//! bounds their error.

use crate::exact::push_exact;
use crate::span::{Coefficient, Coefficients, bezier_of_span, binomial, without_weightless_ends};
use crate::{Nurbs, NurbsError, Point, Runs, knots};

/// Most halvings of one span of a curve on the way to the tolerance.
///
/// Derived: a halving divides the error by about 16, so 10 of them gain a factor of 10^12.
pub const MAX_HALVINGS: u32 = 10;

/// Result of a conversion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conversion {
    /// True if the runs equal the curve, apart from rounding.
    pub exact: bool,
    /// Upper bound, in meters, of the Hausdorff distance between curve and runs, apart from
    /// rounding. Zero if exact; above the tolerance only if the conversion reached its limit of
    /// pieces.
    pub error_bound_m: f64,
    /// Number of appended cubic segments.
    pub pieces: usize,
}

impl Conversion {
    fn exact(pieces: usize) -> Self {
        Self {
            exact: true,
            error_bound_m: 0.0,
            pieces,
        }
    }
}

/// Appends a NURBS curve over its whole domain.
///
/// Without weights (or with equal weights), degrees 1 to 3 are exact. Spans of a cubic between
/// uniform knots share one run, which has as many control points as the curve. So do the points of
/// a straight line of degree 1, if they are straight to a micrometer. The function approximates
/// every other curve span by span, with as many cubics as `tolerance_m` (meters) requires, within
/// [`MAX_HALVINGS`]. It raises a tolerance below the rounding error of the span to that error.
///
/// Spans of zero width yield nothing. At an inner knot of multiplicity above the degree the curve
/// breaks, and the runs on the two sides do not meet. So it may at a knot where all weights that
/// count are 0; at the ends of the domain such weights leave the limit, the next control point with
/// a weight.
pub fn nurbs_to_runs(curve: &Nurbs, tolerance_m: f64, out: &mut Runs) -> Conversion {
    if curve.degree() <= 3 && !curve.is_rational() {
        let error_bound_m = push_exact(curve, out);
        return Conversion {
            exact: error_bound_m == 0.0,
            error_bound_m,
            pieces: curve.spans().count(),
        };
    }
    let mut fit = Fit {
        degree: curve.degree(),
        origin: curve.points()[0],
        tolerance_m,
        out,
        done: Conversion {
            exact: false,
            ..Conversion::exact(0)
        },
    };
    for span in curve.spans() {
        // Coordinates relative to the span lose less to rounding in products.
        fit.origin = curve.points()[span];
        let bezier = bezier_of_span(curve, span, fit.origin);
        let (degree, bezier) = without_weightless_ends(&bezier, curve.degree());
        fit.degree = degree;
        fit.push(&bezier, MAX_HALVINGS);
    }
    fit.done
}

/// Appends a Bezier curve of degree 1 to [`MAX_DEGREE`](crate::MAX_DEGREE): degrees 1 to 3 exactly,
/// higher ones as [`nurbs_to_runs`] does.
///
/// # Errors
/// When there are fewer than 2 points or more than [`MAX_DEGREE`](crate::MAX_DEGREE) + 1, or a
/// point is not finite.
pub fn bezier_to_runs(
    points: &[Point<f64>],
    tolerance_m: f64,
    out: &mut Runs,
) -> Result<Conversion, NurbsError> {
    let degree = points.len().saturating_sub(1);
    let knots = knots::uniform_clamped(degree, points.len());
    let curve = Nurbs::new(degree, knots, points.to_vec(), None)?;
    Ok(nurbs_to_runs(&curve, tolerance_m, out))
}

/// Appends the lines of a polyline, exactly. Fewer than two points append nothing.
pub fn polyline_to_runs(points: &[Point<f64>], out: &mut Runs) -> Conversion {
    out.push_polyline(points);
    Conversion::exact(points.len().saturating_sub(1))
}

/// Fits cubics to rational Bezier curves N/w, with points relative to `origin`.
struct Fit<'a> {
    degree: usize,
    origin: Point<f64>,
    tolerance_m: f64,
    out: &'a mut Runs,
    done: Conversion,
}

impl Fit<'_> {
    /// Appends cubics for one curve, and halves it until their error is within the tolerance.
    fn push(&mut self, curve: &Coefficients, halvings_left: u32) {
        let cubic = self.hermite(curve);
        let error = self.error_bound(curve, &cubic);
        // Rounding error of the coordinates: no halving gets below it.
        let largest = curve[..=self.degree].iter().map(|c| c.project().norm());
        let floor = 16.0 * f64::EPSILON * largest.fold(0.0, f64::max);
        if halvings_left > 0 && error > self.tolerance_m.max(floor) {
            let [left, right] = self.halves(curve);
            self.push(&left, halvings_left - 1);
            self.push(&right, halvings_left - 1);
            return;
        }
        self.out.push_bezier(&cubic.map(|p| p + self.origin));
        self.done.error_bound_m = self.done.error_bound_m.max(error);
        self.done.pieces += 1;
    }

    /// Hermite cubic: same ends and same end derivatives as the curve. Its error falls with the
    /// fourth power of the length of the piece.
    fn hermite(&self, curve: &Coefficients) -> [Point<f64>; 4] {
        let p = self.degree;
        let third = p as f64 / 3.0;
        // C' = p (w1 / w0) (P1 - P0) at the start. Source: The NURBS Book, eq. 4.9. A coefficient
        // holds w1 P1, because w1 may be 0.
        let inner = |end: Coefficient, next: Coefficient| {
            let start = end.project();
            start + (next.point - start * next.weight) * (third / end.weight)
        };
        [
            curve[0].project(),
            inner(curve[0], curve[1]),
            inner(curve[p], curve[p - 1]),
            curve[p].project(),
        ]
    }

    /// Upper bound of |N/w - Q| at equal parameters, and so of the distance between the curves.
    ///
    /// N/w - Q = (N - Q w)/w. The numerator is a polynomial of degree p + 3; numerator and w lie
    /// within the hulls of their Bernstein coefficients. By the Bernstein product, coefficient k of
    /// the numerator is the sum over i + j = k of (N_i - Q_j w_i) C(p, i) C(3, j) / C(p + 3, k).
    fn error_bound(&self, curve: &Coefficients, q: &[Point<f64>; 4]) -> f64 {
        let p = self.degree;
        let coefficient = |k: usize| {
            let range = k.saturating_sub(3)..=k.min(p);
            let terms = range.map(|i| {
                let share = binomial(p, i) * binomial(3, k - i) / binomial(p + 3, k);
                (curve[i].point - q[k - i] * curve[i].weight) * share
            });
            let size = terms.fold(Point::new(0.0, 0.0), |a, b| a + b).norm();
            // `f64::max` ignores NaN, so an overflow would pass for a small error.
            if size.is_nan() { f64::INFINITY } else { size }
        };
        let largest = (0..=p + 3).map(coefficient).fold(0.0, f64::max);
        let weights = curve[..=p].iter().map(|c| c.weight);
        let least = weights.fold(f64::INFINITY, f64::min);
        // A coefficient of weight 0 bounds nothing; those of the halves are positive.
        if least > 0.0 {
            largest / least
        } else {
            f64::INFINITY
        }
    }

    /// The two halves of a curve. Source: de Casteljau; The NURBS Book, A1.5.
    fn halves(&self, curve: &Coefficients) -> [Coefficients; 2] {
        let p = self.degree;
        let (mut left, mut right) = (*curve, *curve);
        for (r, coefficient) in left.iter_mut().enumerate().take(p + 1).skip(1) {
            for i in 0..=p - r {
                right[i] = right[i].lerp(right[i + 1], 0.5);
            }
            *coefficient = right[0];
        }
        [left, right]
    }
}
