use guideway_layout::{Layout, RunPoints};
use guideway_scene::{LineRule, PathState, Scene};
use guideway_spline::{Bounds, Nearest, Point, nearest_on_run};

use crate::Index;

/// A place on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Row of the path.
    pub path: u32,
    /// Which of its runs.
    pub run: usize,
    /// Which segment of the run.
    pub segment: usize,
    /// Parameter in the segment, 0 to 1.
    pub t: f64,
    /// The place itself, in meters.
    pub point_m: Point<f64>,
    /// How far it is from where it was looked for, in meters.
    pub distance_m: f64,
}

/// The path that a person means who points at `point_m` in a picture of `px_per_m`: the one drawn last of
/// those whose line covers the point; where none does, the nearest within `reach_px`. None if more than `most` paths may
/// be near: looking at them all takes too long to do with every movement of a hand.
pub fn pick(
    (scene, index): (&Scene, &Index),
    line_rule: LineRule,
    px_per_m: f64,
    point_m: Point<f64>,
    reach_px: f64,
    most: usize,
) -> Option<Hit> {
    let reach_m = reach_px / px_per_m;
    let radius_m = |path| line_rule.radius_px(scene.width_m(path), px_per_m) / px_per_m;
    let spot = Bounds {
        min: point_m,
        max: point_m,
    };
    let rank = |path: u32| {
        let rank = scene.layout().paths.rank();
        (rank.map_or(0, |rank| rank[path as usize]), path)
    };
    let mut best: Option<(Hit, bool)> = None;
    let spot = spot.inflated(reach_m);
    if most < usize::MAX && index.paths_in(spot).nth(most).is_some() {
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

/// The place of a path nearest to a point, within `tolerance_m` of the best.
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
