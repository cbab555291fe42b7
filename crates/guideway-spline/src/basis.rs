//! B-spline basis functions of any degree over any knot vector (thesis eq. 3.1, Cox-de Boor).

/// Highest degree of a curve that can be evaluated or converted: it sizes the arrays of one span,
/// which live on the stack.
pub const MAX_DEGREE: usize = 25;

/// Values of the p + 1 basis functions that do not vanish on one span.
pub type BasisValues = [f64; MAX_DEGREE + 1];

/// Index k of the span with u_k <= u < u_(k + 1), p <= k < n, for n control points.
///
/// The domain is [u_p, u_n]. A `u` outside of it gets the nearest span that is not empty; u = u_n
/// belongs to the last span. Source: Piegl & Tiller, The NURBS Book, A2.1.
///
/// # Panics
/// When there are fewer than 2p + 2 knots.
pub fn find_span(degree: usize, knots: &[f64], u: f64) -> usize {
    let end = knots.len() - degree - 1;
    let (inner, first, last) = (&knots[degree..end], knots[degree], knots[end]);
    let left = if u >= last {
        inner.partition_point(|&k| k < last)
    } else {
        inner.partition_point(|&k| k <= u.max(first))
    };
    degree + left.max(1) - 1
}

/// Values of N_(k - p, p)(u) to N_(k, p)(u), the basis functions that do not vanish on span k, in
/// the first p + 1 elements; the other elements are zero. The values are not negative and sum to 1.
///
/// Source: Piegl & Tiller, The NURBS Book, A2.2: no recursion, and no 0/0 on a span with a width.
///
/// # Panics
/// When the degree exceeds [`MAX_DEGREE`], or the span has fewer than p + 1 knots on either side.
pub fn nonzero_basis(degree: usize, knots: &[f64], span: usize, u: f64) -> BasisValues {
    let mut values = [0.0; MAX_DEGREE + 1];
    values[0] = 1.0;
    for p in 1..=degree {
        let mut carried = 0.0;
        for r in 0..p {
            let (left, right) = (knots[span + 1 + r - p], knots[span + 1 + r]);
            let share = values[r] / (right - left);
            values[r] = carried + (right - u) * share;
            carried = (u - left) * share;
        }
        values[p] = carried;
    }
    values
}

/// Value of N_(i, p)(u), thesis eq. 3.1 with 0/0 = 0. The right end of the domain belongs to its
/// last span.
///
/// Zero outside of the domain [u_p, u_n].
///
/// # Panics
/// As [`find_span`] and [`nonzero_basis`].
pub fn basis(i: usize, degree: usize, knots: &[f64], u: f64) -> f64 {
    let domain = knots[degree]..=knots[knots.len() - degree - 1];
    let span = find_span(degree, knots, u);
    if !domain.contains(&u) || !(i..=i + degree).contains(&span) {
        return 0.0;
    }
    nonzero_basis(degree, knots, span, u)[i + degree - span]
}
