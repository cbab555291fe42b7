//! [`Nurbs`]: a validated non-uniform rational B-spline curve, and its evaluation.

use crate::basis::{MAX_DEGREE, find_span, nonzero_basis};
use crate::{Point, knots};

/// A non-uniform rational B-spline curve of degree 1 to [`MAX_DEGREE`], validated on construction.
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

/// Reason why [`Nurbs::new`] rejects its input.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NurbsError {
    /// The degree is 0 or exceeds [`MAX_DEGREE`].
    #[error("degree {actual} is outside of 1 to {MAX_DEGREE}")]
    Degree {
        /// Given degree.
        actual: usize,
    },
    /// A curve of degree p needs at least p + 1 control points.
    #[error("expected at least {least} control points, found {actual}")]
    TooFewPoints {
        /// Number of given points.
        actual: usize,
        /// Number of points that the degree requires.
        least: usize,
    },
    /// The number of knots is not n + p + 1.
    #[error("expected {expected} knots, found {actual}")]
    KnotCount {
        /// Number of given knots.
        actual: usize,
        /// Number of knots that the degree and the points require.
        expected: usize,
    },
    /// The numbers of weights and control points differ.
    #[error("expected {expected} weights, found {actual}")]
    WeightCount {
        /// Number of given weights.
        actual: usize,
        /// Number of control points.
        expected: usize,
    },
    /// A knot is infinite or not a number.
    #[error("knot {index} is {actual}, expected a finite number")]
    NonFiniteKnot {
        /// Index of the knot.
        index: usize,
        /// Value of the knot.
        actual: f64,
    },
    /// A knot is lower than its predecessor.
    #[error("knot {index} is {actual}, expected at least {least}")]
    FallingKnots {
        /// Index of the knot.
        index: usize,
        /// Value of the knot.
        actual: f64,
        /// Value of its predecessor.
        least: f64,
    },
    /// The domain [u_p, u_n] is empty, or its width exceeds the range of `f64`.
    #[error("the domain is [{start}, {end}], expected a positive finite width")]
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
    /// A weight is negative or not finite.
    #[error("weight {index} is {actual}, expected a finite number from 0 on")]
    Weight {
        /// Index of the weight.
        index: usize,
        /// Value of the weight.
        actual: f64,
    },
    /// All weights that count between two knots are 0: the curve has no position there.
    #[error("all weights that count from parameter {start} to {end} are 0")]
    NoWeight {
        /// First parameter without a position.
        start: f64,
        /// Last parameter without a position.
        end: f64,
    },
}

impl Nurbs {
    /// A curve of `degree` p with n `points` (meters), n + p + 1 `knots` and, if rational, n
    /// `weights`.
    ///
    /// # Errors
    /// Returns the first rule that the numbers break, with the expected value.
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
            if !(actual.is_finite() && actual >= 0.0) {
                return Err(NurbsError::Weight { index, actual });
            }
        }
        let curve = Self {
            degree,
            knots,
            points,
            weights,
        };
        match curve.weightless() {
            Some((start, end)) => Err(NurbsError::NoWeight { start, end }),
            None => Ok(curve),
        }
    }

    /// A smooth closed curve of `degree`; `points` holds each control point once.
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

    /// The n weights, if the curve has any.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// Returns `true` if two weights differ. With equal weights the curve is polynomial.
    pub fn is_rational(&self) -> bool {
        let weights = self.weights.as_deref().unwrap_or_default();
        weights.iter().any(|&w| w != weights[0])
    }

    /// First and last parameter of the curve, u_p and u_n.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.points.len()])
    }

    /// The point at parameter `u`, clamped to the domain.
    ///
    /// At an inner knot of multiplicity above p the curve breaks; the result is the limit from the
    /// right. So it is at a knot where all weights that count are 0, but at the end of the domain
    /// the limit from the left. Source: Piegl & Tiller, The NURBS Book, A4.1.
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
        if total > 0.0 {
            return sum * (1.0 / total);
        }
        self.limit(span, u - self.knots[span] <= self.knots[span + 1] - u)
    }

    /// The limit at the start or the end of a span where no function with a weight counts.
    ///
    /// The functions that vanish at the start of a span do so the faster the later they are, and at
    /// its end the faster the earlier they are. So one control point is left.
    fn limit(&self, span: usize, is_start: bool) -> Point<f64> {
        let weights = self.weights.as_deref().unwrap_or_default();
        let mut weighted = (span - self.degree..=span).filter(|&i| weights[i] > 0.0);
        let nearest = if is_start {
            weighted.next()
        } else {
            weighted.next_back()
        };
        self.points[nearest.unwrap_or(span)]
    }

    /// Parameters of a span without any weight. All others have positions, because their basis
    /// functions are positive within.
    fn weightless(&self) -> Option<(f64, f64)> {
        let weights = self.weights.as_ref().filter(|all| all.contains(&0.0))?;
        let counts = |span: usize| &weights[span - self.degree..=span];
        let mut spans = self.spans();
        let span = spans.find(|&span| counts(span).iter().all(|&weight| weight == 0.0))?;
        Some((self.knots[span], self.knots[span + 1]))
    }

    /// Indices k of the spans [u_k, u_(k + 1)] of the domain with a positive width.
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
