//! Tight bounding box of all drawn curves, computed from the few that can reach its sides.

use guideway_layout::{Hulls, Layout};
use guideway_spline::Bounds;
use rayon::prelude::*;

/// Paths whose hulls are tested together first. 64 divides a million paths into few enough groups
/// to test each, and a group into few enough paths to test one by one.
const GROUP: usize = 64;

/// Bounding box of the curves of the `drawn` paths, in meters; `None` without curves.
///
/// The box of the control points is up to three times as large. A group of paths, then a path, then
/// a segment is refined only if its hull reaches out of the box found so far. The groups that reach
/// farthest along each axis come first: they decide the box, so that most others are skipped.
pub(super) fn curve_bounds(layout: &Layout, hulls: &Hulls, drawn: &[u32]) -> Option<Bounds<f64>> {
    const SIDES: [fn(Bounds<f64>) -> f64; 4] =
        [|b| -b.min.x, |b| -b.min.y, |b| b.max.x, |b| b.max.y];
    let hull = |paths: &[u32]| hulls.of(paths.iter().map(|&path| path as usize));
    let groups = drawn.par_chunks(GROUP);
    let groups = groups.filter_map(|paths| {
        Some(Group {
            hull: hull(paths)?,
            paths,
        })
    });
    let groups: Vec<Group<'_>> = groups.collect();
    let extend = |mut all: Option<Bounds<f64>>, group: &Group<'_>| {
        if !reaches_out(Some(group.hull), all) {
            return all;
        }
        for &path in group.paths {
            if !reaches_out(hull(&[path]), all) {
                continue;
            }
            let runs = layout.paths.get(path as usize).runs();
            for segment in runs.flat_map(|run| run.segments()) {
                if reaches_out(Bounds::of_points(segment), all) {
                    let tight = Bounds::of_segment(&segment);
                    all = Some(all.map_or(tight, |all| all.union(tight)));
                }
            }
        }
        all
    };
    let farthest = SIDES.iter().filter_map(|side| {
        let reach = |group: &Group<'_>| side(group.hull);
        groups.iter().max_by(|a, b| reach(a).total_cmp(&reach(b)))
    });
    let first = farthest.fold(None, extend);
    let parts = groups.par_iter().fold(|| first, extend);
    parts.flatten().reduce_with(Bounds::union)
}

struct Group<'p> {
    hull: Bounds<f64>,
    paths: &'p [u32],
}

/// Returns `true` if a hull is not inside the box found so far.
fn reaches_out(hull: Option<Bounds<f64>>, all: Option<Bounds<f64>>) -> bool {
    match (hull, all) {
        (Some(hull), Some(all)) => !(all.contains(hull.min) && all.contains(hull.max)),
        (hull, _) => hull.is_some(),
    }
}
