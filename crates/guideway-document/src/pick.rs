//! Hit test: finds the path under the pointer and the nearest point on a path.

use guideway_layout::{Layout, RunPoints};
use guideway_scene::{LineRule, PathState, Scene};
use guideway_spline::{Bounds, Nearest, Point, nearest_on_run};

use crate::index::Index;

/// A point on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Row of the path.
    pub path: u32,
    /// Index of the run in the path.
    pub run: usize,
    /// Index of the segment in the run.
    pub segment: usize,
    /// Parameter in the segment, 0 to 1.
    pub t: f64,
    /// The point on the curve, in meters.
    pub point_m: Point<f64>,
    /// Distance from the query point, in meters.
    pub distance_m: f64,
}

/// The path under a pointer at `point_m`, in a picture of `px_per_m` pixels per meter: the topmost
/// of the paths whose stroke covers the point, else the nearest within `reach_px` pixels. `None`
/// without either, or if more than `max_candidates` paths may be near, which would take too long to
/// test on every pointer movement.
pub fn pick(
    (scene, index): (&Scene, &Index),
    line_rule: LineRule,
    px_per_m: f64,
    point_m: Point<f64>,
    reach_px: f64,
    max_candidates: usize,
) -> Option<Hit> {
    let reach_m = reach_px / px_per_m;
    let radius_m = |path| line_rule.radius_px(scene.width_m(path), px_per_m) / px_per_m;
    let spot = Bounds {
        min: point_m,
        max: point_m,
    };
    let rank = |path: u32| {
        let rank = scene.layout().paths.rank();
        let rank = rank.map_or(0, |rank| rank[path as usize]);
        (!scene.is_below_ways(path), rank, path)
    };
    let mut best: Option<(Hit, bool)> = None;
    let spot = spot.inflated(reach_m);
    if max_candidates < usize::MAX && index.paths_in(spot).nth(max_candidates).is_some() {
        return None;
    }
    for path in index.paths_in(spot) {
        if scene.state(path) != PathState::Shown {
            continue;
        }
        let hit = nearest(scene.layout(), path, point_m, reach_m / 64.0);
        let Some(hit) = hit.filter(|hit| hit.distance_m <= reach_m) else {
            continue;
        };
        let covers = hit.distance_m <= radius_m(path);
        let is_better = best.is_none_or(|(old, old_covers)| match (covers, old_covers) {
            (true, true) => rank(path) > rank(old.path),
            (false, false) => hit.distance_m < old.distance_m,
            (covers, _) => covers,
        });
        if is_better {
            best = Some((hit, covers));
        }
    }
    best.map(|(hit, _)| hit)
}

/// The point on a path nearest to `point_m`. Its distance exceeds the minimum by at most
/// `tolerance_m` meters. `None` for a path without a curve.
pub fn nearest(layout: &Layout, path: u32, point_m: Point<f64>, tolerance_m: f64) -> Option<Hit> {
    let on_run = |run: RunPoints<'_>| -> Option<Nearest> {
        match run {
            RunPoints::F64(points) => nearest_on_run(points, point_m, tolerance_m),
            RunPoints::F32(points) => nearest_on_run(points, point_m, tolerance_m),
        }
    };
    let runs = layout.paths.get(path as usize).runs().enumerate();
    let hits = runs.filter_map(|(run, points)| {
        let found = on_run(points)?;
        Some(Hit {
            path,
            run,
            segment: found.segment,
            t: found.t,
            point_m: found.point,
            distance_m: found.distance,
        })
    });
    hits.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m))
}
