//! Exact conversion of curves without weights, of degree 1 to 3, to as few control points as they
//! have.
//!
//! ```text
//! knots      0 0 0 0   1   2   3   4 4 4 4      a clamped cubic: 7 control points
//! spans            |---|---|---|---|            all as wide: one run of 7 control points
//! uniform -2  -1   0   1   2   3   4   5   6    the knots of that run
//! ```
//!
//! Control points whose three knots are those of the run stay as they are. Those at the ends of the
//! spans are blossoms (polar forms) of the outer spans. Source: Ramshaw 1989.

use crate::bezier::Bezier;
use crate::span::bezier_of_span;
use crate::{Nurbs, Point, Runs};

/// Largest distance from a straight line at which points lie on it, in meters. Derived: files round
/// coordinates to a micrometer, that is by up to half of it along both axes at a point and at both
/// ends.
const STRAIGHT_M: f64 = 1.5e-6;

/// Upper bound of the distance of a curve through points beside a line from the lines between them,
/// as a multiple of their greatest distance from it. Derived: a natural cubic spline stays within
/// 2 times the greatest value at its knots, and the lines between these within 1.
const ASIDE_SHARE: f64 = 3.0;

/// Appends a curve of degree 1 to 3 without weights. Returns an upper bound of the error in meters,
/// which is 0 but for the rounding of points on a straight line.
pub(crate) fn push_exact(curve: &Nurbs, out: &mut Runs) -> f64 {
    let spans: Vec<usize> = curve.spans().collect();
    let mut error_m: f64 = 0.0;
    match curve.degree() {
        1 => {
            // A double knot is a gap: the lines of its two sides do not meet.
            for spans in spans.chunk_by(|a, b| a + 1 == *b) {
                let points = &curve.points()[spans[0] - 1..=spans[spans.len() - 1]];
                error_m = error_m.max(push_lines(points, out));
            }
        }
        2 => {
            for span in spans {
                let b = bezier_of_span::<3>(curve, span, Point::default()).map(|c| c.point);
                out.push_quadratic(&b);
            }
        }
        _ => {
            let is_even = |a: &usize, b: &usize| a + 1 == *b && is_as_wide(curve.knots(), [*a, *b]);
            for spans in spans.chunk_by(is_even) {
                push_even_spans(curve, spans, out);
            }
        }
    }
    error_m
}

/// Returns `true` if two spans have the same width, up to the rounding error of their knots.
fn is_as_wide(knots: &[f64], spans: [usize; 2]) -> bool {
    let [width, other] = spans.map(|span| knots[span + 1] - knots[span]);
    (other - width).abs() <= slack(knots, width)
}

/// Rounding error of the differences of knots.
fn slack(knots: &[f64], width: f64) -> f64 {
    let greatest = knots[0].abs().max(knots[knots.len() - 1].abs());
    (4.0 * f64::EPSILON * greatest).clamp(1e-12 * width, 1e-10 * width)
}

/// Appends consecutive spans of a cubic that are equally wide, as one run.
fn push_even_spans(curve: &Nurbs, spans: &[usize], out: &mut Runs) {
    let (knots, points) = (curve.knots(), curve.points());
    let (first, last) = (spans[0], spans[spans.len() - 1]);
    let width = knots[first + 1] - knots[first];
    let slack = slack(knots, width);
    let is_even = |knots: &[f64]| {
        let mut gaps = knots.array_windows().map(|[a, b]| b - a);
        gaps.all(|gap| (gap - width).abs() <= slack)
    };
    let bezier = |span| bezier_of_span::<4>(curve, span, Point::default()).map(|c| c.point);
    if first == last {
        match points[first - 3..].first_chunk() {
            Some(own) if is_even(&knots[first - 2..first + 4]) => out.push_segment(own),
            _ => out.push_bezier(&bezier(first)),
        }
        return;
    }
    let outer = [first, last].map(bezier);
    let point = |row: usize| {
        if is_even(&knots[row + 1..row + 4]) {
            return points[row];
        }
        let (bezier, span) = match row < first {
            true => (&outer[0], first),
            false => (&outer[1], last),
        };
        // The middle one of the three knots of the run, in the parameter of the span.
        let knot = row as f64 + 2.0 - span as f64;
        blossom(bezier, [knot - 1.0, knot, knot + 1.0])
    };
    let points: Vec<Point<f64>> = (first - 3..=last).map(point).collect();
    out.push(&points);
}

/// The blossom of a cubic Bezier at three parameters, of which 0 is its start and 1 its end.
fn blossom(b: &Bezier, at: [f64; 3]) -> Point<f64> {
    let mut b = *b;
    for (step, t) in at.into_iter().enumerate() {
        for i in 0..3 - step {
            b[i] = b[i].lerp(b[i + 1], t);
        }
    }
    b[0]
}

/// Appends the lines between points: as one run if they make one straight line, else each as one.
/// Returns an upper bound of the error in meters.
fn push_lines(points: &[Point<f64>], out: &mut Runs) -> f64 {
    match straight_run(points) {
        Some((run, aside_m)) => {
            out.push(&run);
            ASIDE_SHARE * aside_m
        }
        None => {
            out.push_polyline(points);
            0.0
        }
    }
}

/// The run through points on a straight line, with two points more than they are, and the greatest
/// distance of the points from the line. `None` if they are not straight, or if it turned back.
///
/// The run is the natural cubic spline that has the points at its knots: it solves
/// `p[i - 1] + 4 p[i] + p[i + 1] = 6 v[i]` with `p = v` at both ends (Thomas algorithm).
fn straight_run(points: &[Point<f64>]) -> Option<(Vec<Point<f64>>, f64)> {
    let (&[start], &[end]) = (points.first_chunk()?, points.last_chunk()?);
    let chord = end - start;
    let length = chord.norm();
    if points.len() < 3 || length <= STRAIGHT_M {
        return None;
    }
    let aside = points
        .iter()
        .map(|&p| (p - start).cross(chord).abs() / length);
    let aside_m = aside.fold(0.0, f64::max);
    if aside_m > STRAIGHT_M {
        return None;
    }
    let last = points.len() - 1;
    let mut run = Vec::with_capacity(points.len() + 2);
    run.push(start);
    run.push(start);
    // Each point is `offset - share * next`.
    let mut shares = Vec::with_capacity(points.len());
    shares.push(0.0);
    for (row, &point) in points.iter().enumerate().take(last).skip(1) {
        let scale = 1.0 / (4.0 - shares[row - 1]);
        shares.push(scale);
        run.push((point * 6.0 - run[row]) * scale);
    }
    run.push(end);
    for row in (1..last).rev() {
        run[row + 1] = run[row + 1] - run[row + 2] * shares[row];
    }
    run[0] = start * 2.0 - run[2];
    run.push(end * 2.0 - run[last]);
    let mut steps = run.array_windows().map(|[a, b]| (*b - *a).dot(chord));
    steps.all(|step| step >= 0.0).then_some((run, aside_m))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier;

    #[test]
    fn blossom_at_equal_parameters_is_the_point() {
        let b = [(0.0, 0.0), (1.0, 2.0), (4.0, -1.0), (5.0, 3.0)].map(|(x, y)| Point::new(x, y));
        for t in [0.0, 0.3, 1.0, 2.0] {
            let expected = bezier::point(&b, t);
            assert!(blossom(&b, [t; 3]).distance(expected) < 1e-12, "{t}");
        }
        assert_eq!(blossom(&b, [0.0, 0.0, 1.0]), b[1]);
        assert_eq!(blossom(&b, [1.0, 0.0, 1.0]), b[2]);
    }
}
