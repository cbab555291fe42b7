use crate::basis::{find_span, nonzero_basis};
use crate::{Point, knots};

/// The greatest degree of a curve that can be evaluated or converted.
pub const MAX_DEGREE: usize = 25;

/// A non-uniform rational B-spline curve of degree 1 to [`MAX_DEGREE`], checked when it is made.
///
/// ```text
/// C(u) = sum N_(i,p)(u) w_i P_i / sum N_(i,p)(u) w_i     u_p <= u <= u_n
/// ```
///
/// Source: Piegl & Tiller, The NURBS Book, eq. 4.1; N_(i,p) as in thesis eq. 3.1.
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<Point<f64>>,
    weights: Option<Vec<f64>>,
}

/// Why numbers do not make a [`Nurbs`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NurbsError {
    /// The degree is 0 or too high.
    #[error("degree {actual} is not within 1 to {MAX_DEGREE}")]
    Degree {
        /// Degree given.
        actual: usize,
    },
    /// A curve of degree p needs at least p + 1 control points.
    #[error("{actual} control points, at least {least} expected")]
    TooFewPoints {
        /// Points given.
        actual: usize,
        /// Points needed for the degree.
        least: usize,
    },
    /// There must be n + p + 1 knots.
    #[error("{actual} knots, {expected} expected")]
    KnotCount {
        /// Knots given.
        actual: usize,
        /// Knots needed for the degree and the points.
        expected: usize,
    },
    /// There must be as many weights as control points.
    #[error("{actual} weights, {expected} expected")]
    WeightCount {
        /// Weights given.
        actual: usize,
        /// Number of control points.
        expected: usize,
    },
    /// A knot is infinite or not a number.
    #[error("knot {index} is {actual}, a finite number expected")]
    NonFiniteKnot {
        /// Index of the knot.
        index: usize,
        /// Its value.
        actual: f64,
    },
    /// A knot is below the one before it.
    #[error("knot {index} is {actual}, at least {least} expected")]
    FallingKnots {
        /// Index of the knot that is too low.
        index: usize,
        /// Its value.
        actual: f64,
        /// Value of the knot before it.
        least: f64,
    },
    /// The knots u_p and u_n are equal (or too far apart for a number): there is no curve.
    #[error("the domain is from knot {start} to {end}, a finite width above zero expected")]
    DomainWidth {
        /// Knot u_p.
        start: f64,
        /// Knot u_n.
        end: f64,
    },
    /// A coordinate is infinite or not a number.
    #[error("control point {index} is not finite")]
    NonFinitePoint {
        /// Index of the point.
        index: usize,
    },
    /// A weight is not a positive finite number.
    #[error("weight {index} is {actual}, a finite number above zero expected")]
    Weight {
        /// Index of the weight.
        index: usize,
        /// Its value.
        actual: f64,
    },
}

impl Nurbs {
    /// A curve of `degree` p over n `points` (meters), n + p + 1 `knots` and, if rational, n `weights`.
    ///
    /// # Errors
    /// Says the first thing that is wrong with the numbers, with what was expected.
    pub fn new(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<Point<f64>>,
        weights: Option<Vec<f64>>,
    ) -> Result<Self, NurbsError> {
        check_counts(degree, knots.len(), points.len(), weights.as_deref())?;
        check_knots(degree, &knots)?;
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(NurbsError::NonFinitePoint { index });
        }
        for (index, &actual) in weights.iter().flatten().enumerate() {
            if !(actual.is_finite() && actual > 0.0) {
                return Err(NurbsError::Weight { index, actual });
            }
        }
        Ok(Self {
            degree,
            knots,
            points,
            weights,
        })
    }

    /// A smooth closed curve of `degree` over control points that are each given once.
    ///
    /// # Errors
    /// As [`Nurbs::new`].
    pub fn closed(degree: usize, points: &[Point<f64>]) -> Result<Self, NurbsError> {
        let knots = knots::uniform_closed(degree, points.len());
        Self::new(degree, knots, knots::close(degree, points), None)
    }

    /// The degree p.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The n + p + 1 knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The n control points.
    pub fn points(&self) -> &[Point<f64>] {
        &self.points
    }

    /// The n weights, if given.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Whether two weights differ; if not, the curve is polynomial whatever the weights.
    pub fn is_rational(&self) -> bool {
        let weights = self.weights.as_deref().unwrap_or_default();
        weights.iter().any(|&w| w != weights[0])
    }

    /// First and last parameter of the curve: u_p and u_n.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.points.len()])
    }

    /// The point at parameter `u`, or at the nearest end of the domain if it is outside.
    ///
    /// Where the curve breaks, at an inner knot more than p-fold, it is the side to the right. Source:
    /// Piegl & Tiller, The NURBS Book, A4.1.
    pub fn point(&self, u: f64) -> Point<f64> {
        let (first, last) = self.domain();
        let u = u.clamp(first, last);
        let span = find_span(self.degree, &self.knots, u);
        let values = nonzero_basis(self.degree, &self.knots, span, u);
        let (mut sum, mut total) = (Point::new(0.0, 0.0), 0.0);
        for (i, value) in (span - self.degree..=span).zip(values) {
            let share = value * self.weights.as_ref().map_or(1.0, |w| w[i]);
            sum = sum + self.points[i] * share;
            total += share;
        }
        sum * (1.0 / total)
    }

    /// Indices k of the spans [u_k, u_(k + 1)] of the domain that have a width.
    pub(crate) fn spans(&self) -> impl Iterator<Item = usize> {
        (self.degree..self.points.len()).filter(|&k| self.knots[k] < self.knots[k + 1])
    }
}

fn check_counts(
    degree: usize,
    knots: usize,
    points: usize,
    weights: Option<&[f64]>,
) -> Result<(), NurbsError> {
    if !(1..=MAX_DEGREE).contains(&degree) {
        return Err(NurbsError::Degree { actual: degree });
    }
    if points <= degree {
        return Err(NurbsError::TooFewPoints {
            actual: points,
            least: degree + 1,
        });
    }
    if knots != points + degree + 1 {
        return Err(NurbsError::KnotCount {
            actual: knots,
            expected: points + degree + 1,
        });
    }
    match weights {
        Some(w) if w.len() != points => Err(NurbsError::WeightCount {
            actual: w.len(),
            expected: points,
        }),
        _ => Ok(()),
    }
}

fn check_knots(degree: usize, knots: &[f64]) -> Result<(), NurbsError> {
    if let Some(index) = knots.iter().position(|k| !k.is_finite()) {
        return Err(NurbsError::NonFiniteKnot {
            index,
            actual: knots[index],
        });
    }
    if let Some(i) = knots.windows(2).position(|k| k[1] < k[0]) {
        return Err(NurbsError::FallingKnots {
            index: i + 1,
            actual: knots[i + 1],
            least: knots[i],
        });
    }
    let (start, end) = (knots[degree], knots[knots.len() - degree - 1]);
    let all = knots[knots.len() - 1] - knots[0];
    if start < end && all.is_finite() {
        Ok(())
    } else {
        Err(NurbsError::DomainWidth { start, end })
    }
}
