//! Builds the curves of paths as runs of eight B-spline segments, from start, direction and size.

use std::f64::consts::{FRAC_PI_2, PI};

use guideway_spline::Point;

use crate::RUN_POINTS;

/// A run of control points.
pub(crate) type Run = [Point<f64>; RUN_POINTS];

const SEGMENTS: usize = RUN_POINTS - 3;
/// Joints of the segments, including both ends.
const KNOTS: usize = SEGMENTS + 1;

/// A straight line.
pub(crate) fn line(start: Point<f64>, end: Point<f64>) -> Run {
    std::array::from_fn(|i| start.lerp(end, (i as f64 - 1.0) / SEGMENTS as f64))
}

/// A quarter circle from `start` and direction `from` to direction `to`, followed by a straight
/// part of length `straight`. Both directions have length 1.
pub(crate) fn turn(
    start: Point<f64>,
    from: Point<f64>,
    to: Point<f64>,
    radius: f64,
    straight: f64,
) -> Run {
    let arc = radius * FRAC_PI_2;
    let length = arc + straight;
    at_knots(length, |distance| {
        let angle = (distance / radius).min(FRAC_PI_2);
        let (along, across) = (
            radius * libm::sin(angle),
            radius * (1.0 - libm::cos(angle)) + (distance - arc).max(0.0),
        );
        start + from * along + to * across
    })
    .fit(from, to)
}

/// A half circle from `start` that ends at a distance of `2 * radius` in the direction `across`.
pub(crate) fn u_turn(start: Point<f64>, from: Point<f64>, across: Point<f64>, radius: f64) -> Run {
    at_knots(radius * PI, |distance| {
        let angle = distance / radius;
        start + from * (radius * libm::sin(angle)) + across * (radius * (1.0 - libm::cos(angle)))
    })
    .fit(from, -from)
}

/// A lane change: ends `length` along `from` and displaced by `shift`.
pub(crate) fn lane_change(
    start: Point<f64>,
    from: Point<f64>,
    shift: Point<f64>,
    length: f64,
) -> Run {
    at_knots(length, |distance| {
        let t = distance / length;
        // Zero slope and curvature at both ends.
        let moved = t - libm::sin(2.0 * PI * t) / (2.0 * PI);
        start + from * distance + shift * moved
    })
    .fit(from, from)
}

/// The same curve in the opposite direction.
pub(crate) fn reversed(mut run: Run) -> Run {
    run.reverse();
    run
}

/// Points evenly spaced along a curve: the joints of the segments of its run.
struct Knots {
    points: [Point<f64>; KNOTS],
    step: f64,
}

fn at_knots(length: f64, curve: impl Fn(f64) -> Point<f64>) -> Knots {
    let step = length / SEGMENTS as f64;
    Knots {
        points: std::array::from_fn(|i| curve(step * i as f64)),
        step,
    }
}

impl Knots {
    /// The run that interpolates all points with the given end directions, each of length 1.
    ///
    /// `(P[k-1] + 4 P[k] + P[k+1]) / 6` is the k-th point and `(P[2] - P[0]) / 2` the derivative at
    /// the start. Substituting the outer control points leaves a tridiagonal system, solved by
    /// elimination (Thomas algorithm) in linear time.
    fn fit(&self, start: Point<f64>, end: Point<f64>) -> Run {
        let last = KNOTS - 1;
        let (start, end) = (start * self.step, end * self.step);
        let mut right = self.points.map(|p| p * 6.0);
        right[0] = right[0] + start * 2.0;
        right[last] = right[last] - end * 2.0;
        let mut above = [0.0; KNOTS];
        for k in 0..KNOTS {
            let (before, after) = match k {
                0 => (0.0, 2.0),
                _ if k == last => (2.0, 0.0),
                _ => (1.0, 1.0),
            };
            let previous = k
                .checked_sub(1)
                .map_or((0.0, Point::default()), |p| (above[p], right[p]));
            let pivot = 4.0 - before * previous.0;
            above[k] = after / pivot;
            right[k] = (right[k] - previous.1 * before) * (1.0 / pivot);
        }
        for k in (0..last).rev() {
            right[k] = right[k] - right[k + 1] * above[k];
        }
        let mut run = [Point::default(); RUN_POINTS];
        run[1..=KNOTS].copy_from_slice(&right);
        run[0] = run[2] - start * 2.0;
        run[RUN_POINTS - 1] = run[RUN_POINTS - 3] + end * 2.0;
        run
    }
}
