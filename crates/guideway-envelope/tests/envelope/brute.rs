//! Brute force: evaluates a vehicle at many poses. Shares no code with the crate under test.

use std::f64::consts::PI;

use guideway_envelope::{Body, Heading};

use crate::random::{Case, P, p};

/// Position and heading of a vehicle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) at: P,
    pub(crate) heading: f64,
}

/// Larger turns without path length are cusps (docs/envelopes.md).
const CUSP: f64 = 179.0 / 180.0 * PI;

/// Poses along the path. Between two poses, every point of the body moves at most by `step`.
pub(crate) fn poses(case: &Case, step: f64) -> Vec<Pose> {
    let reach = case.body.reach_m();
    let mut raw: Vec<(P, f64)> = Vec::new();
    for bezier in &case.curve.0 {
        // Avoids the ends, where the direction may be undefined.
        let first = (1e-7, 1.0 - 3e-7);
        bisect(bezier, first, step, reach, &mut raw);
    }
    let mut poses: Vec<Pose> = Vec::new();
    let mut reverse = 0.0;
    for (at, direction) in raw {
        let heading = match case.heading {
            Heading::Fixed(angle) => angle,
            Heading::Tangential(angle) => direction + angle + reverse,
        };
        let Some(&last) = poses.last() else {
            poses.push(Pose { at, heading });
            continue;
        };
        let mut turn = wrap(heading - last.heading);
        if turn.abs() > CUSP {
            reverse += PI;
            turn = wrap(turn + PI);
        }
        // Divides a pivot into steps.
        let steps = (turn.abs() * reach / step).ceil().max(1.0);
        for i in 1..=steps as usize {
            let t = i as f64 / steps;
            poses.push(Pose {
                at: last.at.lerp(at, t),
                heading: last.heading + turn * t,
            });
        }
    }
    poses
}

fn bisect(b: &[P; 4], (from, to): (f64, f64), step: f64, reach: f64, out: &mut Vec<(P, f64)>) {
    let (start, end) = (at(b, from), at(b, to));
    let moved = start.0.distance(end.0) + reach * wrap(end.1 - start.1).abs();
    // Bisects unconditionally at first, because the ends of a loop coincide.
    let is_coarse = to - from > 0.05;
    if (is_coarse || moved > step) && to - from > 1e-9 {
        let middle = 0.5 * (from + to);
        bisect(b, (from, middle), step, reach, out);
        bisect(b, (middle, to), step, reach, out);
    } else {
        out.extend([start, end]);
    }
}

/// Position and direction at a parameter.
fn at(b: &[P; 4], t: f64) -> (P, f64) {
    let s = 1.0 - t;
    let position = b[0] * (s * s * s)
        + b[1] * (3.0 * s * s * t)
        + b[2] * (3.0 * s * t * t)
        + b[3] * (t * t * t);
    let tangent = (b[1] - b[0]) * (s * s) + (b[2] - b[1]) * (2.0 * s * t) + (b[3] - b[2]) * (t * t);
    (position, tangent.y.atan2(tangent.x))
}

fn wrap(angle: f64) -> f64 {
    angle.sin().atan2(angle.cos())
}

/// A point in vehicle coordinates.
fn to_vehicle(pose: Pose, q: P) -> P {
    let (sin, cos) = pose.heading.sin_cos();
    let d = q - pose.at;
    p(d.x * cos + d.y * sin, d.y * cos - d.x * sin)
}

/// A point of the vehicle in path coordinates, given by -1..=1 from rear to front and from right to
/// left.
pub(crate) fn body_point(body: &Body, pose: Pose, along: f64, across: f64) -> P {
    let x = body.front_m * (1.0 + along) / 2.0 - body.rear_m * (1.0 - along) / 2.0;
    let y = body.left_m * (1.0 + across) / 2.0 - body.right_m * (1.0 - across) / 2.0;
    let (sin, cos) = pose.heading.sin_cos();
    pose.at + p(x * cos - y * sin, x * sin + y * cos)
}

/// Distance of a point from a vehicle.
pub(crate) fn distance_from(body: &Body, pose: Pose, q: P) -> f64 {
    let q = to_vehicle(pose, q);
    let x = (q.x - body.front_m).max(-body.rear_m - q.x).max(0.0);
    let y = (q.y - body.left_m).max(-body.right_m - q.y).max(0.0);
    x.hypot(y)
}

/// Distance of two vehicles.
pub(crate) fn apart(a: (&Body, Pose), b: (&Body, Pose)) -> f64 {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let of = |(body, pose): (&Body, Pose)| corners.map(|(x, y)| body_point(body, pose, x, y));
    let (ca, cb) = (of(a), of(b));
    let crosses = (0..4).any(|i| {
        (0..4).any(|j| {
            let (p, q, r, s) = (ca[i], ca[(i + 1) % 4], cb[j], cb[(j + 1) % 4]);
            let side = |a: P, b: P, c: P| (b - a).cross(c - a) > 0.0;
            side(p, q, r) != side(p, q, s) && side(r, s, p) != side(r, s, q)
        })
    });
    if crosses {
        return 0.0;
    }
    let there = ca.iter().map(|&q| distance_from(b.0, b.1, q));
    let back = cb.iter().map(|&q| distance_from(a.0, a.1, q));
    there.chain(back).fold(f64::INFINITY, f64::min)
}
