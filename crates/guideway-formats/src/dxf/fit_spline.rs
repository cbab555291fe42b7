//! Interpolates fit points with a cubic spline: points and optional end tangents in, runs out.
//!
//! ```text
//!    p0 ------ p1            chords h0, h1, h2; slopes d_i = (p_(i+1) - p_i) / h_i
//!   m0   h0     | h1         unknown: the derivative m_i at every point
//!              p2 ----- p3   one Hermite cubic per chord
//!                   h2
//! ```
//!
//! The parameter is the chord length, and the curve has a continuous second derivative. That
//! requires at every inner point
//!
//! `m_(i-1) h_i + 2 m_i (h_(i-1) + h_i) + m_(i+1) h_(i-1) = 3 (h_i d_(i-1) + h_(i-1) d_i)`.
//!
//! Source: de Boor, A Practical Guide to Splines, chapter IV. Cost: O(n), one elimination of a
//! tridiagonal system.

use guideway_spline::{Point, Runs};

/// Appends the interpolating spline. An end without a tangent has zero curvature; both ends of a
/// closed spline share one tangent.
pub(super) fn append_fit_spline(
    points: &[Point<f64>],
    tangents: [Option<Point<f64>>; 2],
    is_closed: bool,
    runs: &mut Runs,
) {
    let mut points = points.to_vec();
    if is_closed && points.len() > 2 {
        points.push(points[0]);
    }
    points.dedup();
    let Some(last) = points.len().checked_sub(2) else {
        return;
    };
    let chords: Vec<Point<f64>> = points.windows(2).map(|p| p[1] - p[0]).collect();
    let lengths: Vec<f64> = chords.iter().map(|chord| chord.norm()).collect();
    let slopes: Vec<Point<f64>> = chords
        .iter()
        .zip(&lengths)
        .map(|(&chord, &length)| chord * (1.0 / length))
        .collect();
    let unit = |t: Point<f64>| (t.norm() > 0.0).then(|| t * (1.0 / t.norm()));
    let closing = is_closed.then(|| slopes[last] + slopes[0]);
    let given = tangents.map(|tangent| tangent.or(closing).and_then(unit));

    // Forward elimination: m_i + upper_i m_(i+1) = right_i.
    let (mut upper, mut right) = (Vec::new(), Vec::new());
    let (first_upper, first_right) = match given[0] {
        Some(tangent) => (0.0, tangent),
        None => (0.5, slopes[0] * 1.5),
    };
    upper.push(first_upper);
    right.push(first_right);
    for i in 1..=last {
        let (before, after) = (lengths[i - 1], lengths[i]);
        let pivot = 2.0 * (before + after) - after * upper[i - 1];
        let sum = (slopes[i - 1] * after + slopes[i] * before) * 3.0;
        upper.push(before / pivot);
        right.push((sum - right[i - 1] * after) * (1.0 / pivot));
    }
    let end = match given[1] {
        Some(tangent) => tangent,
        None => (slopes[last] * 3.0 - right[last]) * (1.0 / (2.0 - upper[last])),
    };
    // Back substitution.
    let mut derivatives = vec![end];
    for i in (0..=last).rev() {
        let next = derivatives[derivatives.len() - 1];
        derivatives.push(right[i] - next * upper[i]);
    }
    derivatives.reverse();
    for i in 0..=last {
        let third = lengths[i] / 3.0;
        let (from, to) = (points[i], points[i + 1]);
        runs.push_bezier(&[
            from,
            from + derivatives[i] * third,
            to - derivatives[i + 1] * third,
            to,
        ]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_through_its_points_with_continuous_curvature() {
        let points = [(0.0, 0.0), (1.0, 2.0), (4.0, 2.5), (5.0, 0.0), (9.0, 1.0)];
        let points = points.map(|(x, y)| Point::new(x, y));
        for (tangents, is_closed) in [
            ([None, None], false),
            ([Some(Point::new(0.0, 2.0)), None], false),
            ([None, None], true),
        ] {
            let mut runs = Runs::default();
            append_fit_spline(&points, tangents, is_closed, &mut runs);
            let segments: Vec<[Point<f64>; 4]> = runs
                .iter()
                .map(|run| [run[0], run[1], run[2], run[3]])
                .collect();
            assert_eq!(segments.len(), if is_closed { 5 } else { 4 });
            for (segment, point) in segments.iter().zip(&points) {
                assert!(guideway_spline::uniform::start(segment).distance(*point) < 1e-9);
            }
            let curvature = |segment: &[Point<f64>; 4], t: f64| {
                let at = |t| guideway_spline::uniform::point(segment, t);
                let h = 1e-3;
                let first = (at(t + h) - at(t - h)) * (0.5 / h);
                let second = (at(t + h) + at(t - h) - at(t) * 2.0) * (1.0 / (h * h));
                first.cross(second) / first.norm().powi(3)
            };
            for pair in segments.windows(2) {
                let (before, after) = (curvature(&pair[0], 1.0), curvature(&pair[1], 0.0));
                assert!((before - after).abs() < 1e-3, "{before} {after}");
            }
        }
    }
}
