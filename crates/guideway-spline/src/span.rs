//! Spans of a curve between two knots, as Bezier curves in homogeneous coordinates.

use crate::{MAX_DEGREE, Nurbs, Point};

/// A Bernstein coefficient of a rational curve in homogeneous coordinates: w P and w.
#[derive(Clone, Copy, Default)]
pub(crate) struct Coefficient {
    pub(crate) point: Point<f64>,
    pub(crate) weight: f64,
}

impl Coefficient {
    pub(crate) fn lerp(self, other: Self, t: f64) -> Self {
        Self {
            point: self.point.lerp(other.point, t),
            weight: self.weight * (1.0 - t) + other.weight * t,
        }
    }

    pub(crate) fn project(self) -> Point<f64> {
        self.point * (1.0 / self.weight)
    }
}

/// Coefficients of a curve of any degree p, in the first p + 1 elements.
pub(crate) type Coefficients = [Coefficient; MAX_DEGREE + 1];

/// The span [a, b] as a Bezier curve, points relative to `origin`, in the first p + 1 of N
/// elements.
///
/// Coefficient j is the blossom (polar form) of the span at p - j times a and j times b, the result
/// of Boehm's knot insertion until a and b are p-fold. Every step is a convex combination, so
/// rounding errors do not grow. Sources: Ramshaw 1989; Piegl & Tiller, The NURBS Book, section 5.2.
pub(crate) fn bezier_of_span<const N: usize>(
    curve: &Nurbs,
    span: usize,
    origin: Point<f64>,
) -> [Coefficient; N] {
    let (p, knots) = (curve.degree(), curve.knots());
    let (a, b) = (knots[span], knots[span + 1]);
    let weights = curve.weights().filter(|_| curve.is_rational());
    let mut control = [Coefficient::default(); N];
    for (c, i) in control.iter_mut().zip(span - p..=span) {
        let weight = weights.map_or(1.0, |w| w[i]);
        *c = Coefficient {
            point: (curve.points()[i] - origin) * weight,
            weight,
        };
    }
    let mut bezier = [Coefficient::default(); N];
    for (j, out) in bezier.iter_mut().enumerate().take(p + 1) {
        let mut d = control;
        for r in 1..=p {
            let u = if r <= j { b } else { a };
            for i in (r..=p).rev() {
                let (low, high) = (knots[span - p + i], knots[span + 1 + i - r]);
                d[i] = d[i - 1].lerp(d[i], (u - low) / (high - low));
            }
        }
        *out = d[p];
    }
    bezier
}

/// Divides a Bezier curve of degree p by the powers of u and 1 - u that numerator and denominator
/// have in common if its first or last weights are 0. Returns its degree and coefficients.
///
/// ```text
/// c_i C(p, i) u^i (1 - u)^(p - i) = u^f (1 - u)^(p - l) c'_j C(d, j) u^j (1 - u)^(d - j)
///     i = f + j, d = l - f, from the first to the last coefficient f, l with a weight
/// ```
///
/// A curve of one coefficient is a point, which gets degree 1.
pub(crate) fn without_weightless_ends(
    curve: &Coefficients,
    degree: usize,
) -> (usize, Coefficients) {
    let mut weighted = (0..=degree).filter(|&i| curve[i].weight > 0.0);
    let first = weighted.next().unwrap_or(0);
    let last = weighted.next_back().unwrap_or(first);
    let reduced = last - first;
    if reduced == degree {
        return (degree, *curve);
    }
    let mut out = Coefficients::default();
    for (j, c) in out.iter_mut().enumerate().take(reduced + 1) {
        let factor = binomial(degree, first + j) / binomial(reduced, j);
        *c = Coefficient {
            point: curve[first + j].point * factor,
            weight: curve[first + j].weight * factor,
        };
    }
    if reduced == 0 {
        out[1] = out[0];
    }
    (reduced.max(1), out)
}

/// Binomial coefficient, n over k.
pub(crate) fn binomial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |b, i| b * (n - i) as f64 / (i + 1) as f64)
}
