//! Other curves out of given ones.

use guideway_layout::{Geometry, PathRef};
use guideway_spline::{Point, Runs};

/// The curve of a path as runs of its own.
pub(super) fn runs_of(path: PathRef<'_>) -> Runs {
    let mut runs = Runs::default();
    path.copy_runs(&mut runs);
    runs
}

pub(super) fn geometry_of<'a>(curves: impl IntoIterator<Item = &'a Runs>) -> Geometry {
    let mut geometry = Geometry::default();
    curves.into_iter().for_each(|runs| geometry.push(runs));
    geometry
}

/// Moves the ends of a curve and takes the rest along, by so much less the farther it is from them: a straight
/// path stays straight.
///
/// A B-spline whose control points lie on a line evenly spaced, one apart, goes along that line at one unit a
/// segment, one point ahead (linear precision). So adding a share of the shift that falls evenly from control
/// point to control point adds the same to the curve.
pub(super) fn with_ends_moved(runs: &Runs, start_by: Point<f64>, end_by: Point<f64>) -> Runs {
    let segments: usize = runs.iter().map(|run| run.len() - 3).sum();
    let mut moved = Runs::default();
    let mut before = 0;
    for run in runs.iter() {
        let shift =
            |i: usize| start_by.lerp(end_by, (before as f64 + i as f64 - 1.0) / segments as f64);
        let points: Vec<_> = run.iter().enumerate().map(|(i, &p)| p + shift(i)).collect();
        moved.push(&points);
        before += run.len() - 3;
    }
    moved
}

/// The same curve with nearly twice as many control points in each run (Lane and Riesenfeld 1980): the curve
/// does not change, but what a point moves of it halves.
pub(super) fn refined(runs: &Runs) -> Runs {
    let mut fine = Runs::default();
    for run in runs.iter() {
        let mut points = Vec::with_capacity(2 * run.len() - 3);
        for [a, b, c] in run.array_windows() {
            points.push(a.lerp(*b, 0.5));
            points.push((*a + *b * 6.0 + *c) * 0.125);
        }
        let [.., last_but_one, last] = run else {
            unreachable!("a run has at least four points");
        };
        points.push(last_but_one.lerp(*last, 0.5));
        fine.push(&points);
    }
    fine
}

/// A curve that begins and ends at the first and the last of `points`, bends toward those between and is
/// straight if there are only two; none of fewer, or if all are the same.
pub(super) fn through_ends(points: &[Point<f64>]) -> Option<Runs> {
    let [first, second, ..] = points else {
        return None;
    };
    let [.., last_but_one, last] = points else {
        return None;
    };
    points.iter().any(|point| point != first).then(|| {
        // A point mirrored in the first one puts the start of the curve there.
        let mut run = vec![*first * 2.0 - *second];
        run.extend_from_slice(points);
        run.push(*last * 2.0 - *last_but_one);
        let mut runs = Runs::default();
        runs.push(&run);
        runs
    })
}

/// The curve with one run's points changed by `change`; none if fewer than four are left or there is no such run.
pub(super) fn with_run(
    runs: &Runs,
    which: usize,
    change: impl FnOnce(&mut Vec<Point<f64>>) -> bool,
) -> Option<Runs> {
    let mut points = runs.iter().nth(which)?.to_vec();
    if !change(&mut points) || points.len() < 4 {
        return None;
    }
    let mut changed = Runs::default();
    for (i, run) in runs.iter().enumerate() {
        changed.push(if i == which { &points } else { run });
    }
    Some(changed)
}
