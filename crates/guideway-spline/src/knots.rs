//! Knot vectors for a degree p and n control points: n + p + 1 numbers that never fall (thesis 3.2.3).
//!
//! The curve is defined over [u_p, u_n] only. The builders put whole numbers there: span i is [i, i + 1].

/// Equal spacing throughout, so that the curve stops short of its first and last control points.
///
/// Of degree 3, this is exactly one run.
pub fn uniform_open(degree: usize, points: usize) -> Vec<f64> {
    (0..=points + degree)
        .map(|i| i as f64 - degree as f64)
        .collect()
}

/// Equal spacing inside, with p + 1 equal knots at each end: the curve begins at its first control
/// point and ends at its last.
pub fn uniform_clamped(degree: usize, points: usize) -> Vec<f64> {
    let spans = points.saturating_sub(degree);
    (0..=points + degree)
        .map(|i| i.saturating_sub(degree).min(spans) as f64)
        .collect()
}

/// Equal spacing for a closed curve of `points` different control points.
///
/// It goes with the control points as [`close`] returns them: the first p again at the end.
pub fn uniform_closed(degree: usize, points: usize) -> Vec<f64> {
    uniform_open(degree, points + degree)
}

/// The values (control points or weights) with the first p repeated at the end.
pub fn close<V: Copy>(degree: usize, values: &[V]) -> Vec<V> {
    let count = values.len() + degree;
    values.iter().copied().cycle().take(count).collect()
}
