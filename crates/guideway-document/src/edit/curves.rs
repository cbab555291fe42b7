//! Curve constructions for edits: control points in, control points out.

use guideway_layout::{Geometry, PathRef};
use guideway_spline::{Affine, Point, Runs};

/// Copies the runs of a path.
pub(crate) fn runs_of(path: PathRef<'_>) -> Runs {
    let mut runs = Runs::default();
    path.copy_runs(&mut runs);
    runs
}

/// The runs of a path under an affine map.
pub(super) fn mapped_runs(path: PathRef<'_>, by: Affine) -> Runs {
    let mut runs = Runs::default();
    for run in path.runs() {
        runs.push(&run.iter().map(|p| by.apply(p)).collect::<Vec<_>>());
    }
    runs
}

/// Packs curves as geometry.
pub(super) fn geometry_of<'a>(curves: impl IntoIterator<Item = &'a Runs>) -> Geometry {
    let mut geometry = Geometry::default();
    curves.into_iter().for_each(|runs| geometry.push(runs));
    geometry
}

/// Moves the two ends of a curve; the shift of the points between is interpolated linearly, so that
/// a straight path stays straight.
///
/// Control points evenly spaced on a line yield a B-spline that runs along it at one unit per
/// segment, one point ahead (linear precision). Hence a shift that is linear in the index of the
/// control point shifts the curve linearly as well.
pub(super) fn with_moved_ends(runs: &Runs, start_by: Point<f64>, end_by: Point<f64>) -> Runs {
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

/// The same curve with nearly twice as many control points per run (Lane and Riesenfeld 1980), each
/// of which influences half as much of it.
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

/// A curve from the first to the last of `points` that bends toward those between; straight for two
/// points. `None` with fewer than two distinct points.
pub(super) fn curve_along(points: &[Point<f64>]) -> Option<Runs> {
    let [first, second, ..] = points else {
        return None;
    };
    let [.., last_but_one, last] = points else {
        return None;
    };
    points.iter().any(|point| point != first).then(|| {
        // Mirroring the second point in the first puts the start of the curve on the first.
        let mut run = vec![*first * 2.0 - *second];
        run.extend_from_slice(points);
        run.push(*last * 2.0 - *last_but_one);
        let mut runs = Runs::default();
        runs.push(&run);
        runs
    })
}

/// The curve with the points of one run changed by `change`. `None` if the run does not exist,
/// `change` returns false, or fewer than four points are left.
pub(super) fn with_changed_run(
    runs: &Runs,
    index: usize,
    change: impl FnOnce(&mut Vec<Point<f64>>) -> bool,
) -> Option<Runs> {
    let mut points = runs.iter().nth(index)?.to_vec();
    if !change(&mut points) || points.len() < 4 {
        return None;
    }
    let mut changed = Runs::default();
    for (i, run) in runs.iter().enumerate() {
        changed.push(if i == index { &points } else { run });
    }
    Some(changed)
}
