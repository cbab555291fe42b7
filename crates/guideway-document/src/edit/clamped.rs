//! Clamped control points, by which curves are edited.
//!
//! The outer control points of a run lie off its curve, since its knots go on beyond its ends.
//! Knots inserted at the ends (Boehm 1980) yield as many points `c`: the first lies on the start,
//! the second on the tangent there, and the third is that of the run. At the end it is the same.
//!
//! ```text
//!   p0                       c0 = (p0 + 4 p1 + p2) / 6
//!     \      c1----p2=c2     c1 = (2 p1 + p2) / 3
//!      \   /         \
//!       p1-c0          ...
//! ```
//!
//! A run of four points is one segment: there they are the Bezier points of that segment.

use guideway_spline::{Point, uniform};

/// The clamped control points of a run.
pub(crate) fn clamped(run: &[Point<f64>]) -> Vec<Point<f64>> {
    match run.try_into() {
        Ok(segment) => uniform::to_bezier(segment).to_vec(),
        Err(_) => with_both_ends(run, clamp_start),
    }
}

/// The run with some clamped control points, at least four.
pub(super) fn unclamped(points: &[Point<f64>]) -> Vec<Point<f64>> {
    match points.try_into() {
        Ok(bezier) => uniform::from_bezier(bezier).to_vec(),
        Err(_) => with_both_ends(points, unclamp_start),
    }
}

fn with_both_ends(
    points: &[Point<f64>],
    change_start: impl Fn(&mut [Point<f64>]),
) -> Vec<Point<f64>> {
    let mut points = points.to_vec();
    for _ in 0..2 {
        change_start(&mut points);
        points.reverse();
    }
    points
}

fn clamp_start(points: &mut [Point<f64>]) {
    if let [first, second, third, ..] = points {
        *first = (*first + *second * 4.0 + *third) * (1.0 / 6.0);
        *second = (*second * 2.0 + *third) * (1.0 / 3.0);
    }
}

fn unclamp_start(points: &mut [Point<f64>]) {
    if let [first, second, third, ..] = points {
        *second = (*second * 3.0 - *third) * 0.5;
        *first = *first * 6.0 - *second * 4.0 - *third;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(count: usize) -> Vec<Point<f64>> {
        let point = |i: usize| Point::new(i as f64, (i * i % 5) as f64);
        (0..count).map(point).collect()
    }

    #[track_caller]
    fn assert_near(a: Point<f64>, b: Point<f64>) {
        assert!(a.distance(b) < 1e-12, "{a:?} and {b:?}");
    }

    #[test]
    fn first_points_are_those_of_the_first_segment_as_bezier() {
        for count in 4..8 {
            let run = run(count);
            let points = clamped(&run);
            assert_eq!(points.len(), count);
            let bezier = uniform::to_bezier(uniform::segment(&run, 0));
            assert_near(points[0], bezier[0]);
            assert_near(points[1], bezier[1]);
            let bezier = uniform::to_bezier(uniform::segment(&run, count - 4));
            assert_near(points[count - 2], bezier[2]);
            assert_near(points[count - 1], bezier[3]);
        }
    }

    #[test]
    fn points_come_back() {
        for count in 4..8 {
            let run = run(count);
            let again = unclamped(&clamped(&run));
            assert_eq!(again.len(), count);
            run.iter().zip(again).for_each(|(&a, b)| assert_near(a, b));
        }
    }
}
