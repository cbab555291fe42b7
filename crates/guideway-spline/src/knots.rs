//! Knot vectors for a degree p and n control points: n + p + 1 non-decreasing numbers (thesis
//! 3.2.3).
//!
//! The domain of the curve is [u_p, u_n]. The builders put whole numbers there: span i is [i, i +
//! 1].

/// Uniform knots: the curve ends short of its first and last control points.
///
/// A curve of degree 3 with these knots is exactly one run.
pub fn uniform_open(degree: usize, points: usize) -> Vec<f64> {
    (0..=points + degree)
        .map(|i| i as f64 - degree as f64)
        .collect()
}

/// Clamped knots, uniform inside: p + 1 equal knots at each end make the curve begin at its first
/// control point and end at its last.
pub fn uniform_clamped(degree: usize, points: usize) -> Vec<f64> {
    let spans = points.saturating_sub(degree);
    (0..=points + degree)
        .map(|i| i.saturating_sub(degree).min(spans) as f64)
        .collect()
}

/// Uniform knots for a closed curve of `points` distinct control points.
///
/// [`close`] returns the control points to use with them.
pub fn uniform_closed(degree: usize, points: usize) -> Vec<f64> {
    uniform_open(degree, points + degree)
}

/// The values (control points or weights) of a closed curve, with the first p repeated at the end.
pub fn close<V: Copy>(degree: usize, values: &[V]) -> Vec<V> {
    let count = values.len() + degree;
    values.iter().copied().cycle().take(count).collect()
}
