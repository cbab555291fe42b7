//! Places of paths to snap to: ends, middles, crossings, and feet and tangents of a line.

use guideway_scene::PathState;
use guideway_spline::bezier::is_line;
use guideway_spline::construct::crossings;
use guideway_spline::{Bounds, Point, Runs, uniform};

use super::target::SnapTarget;
use crate::document::Document;
use crate::edit::runs_of;

/// Most paths near a position whose places are targets: among more, none could be aimed at.
const MAX_PATHS: usize = 32;
/// Parts of a segment in which feet and tangents are looked for, one in each.
const PARTS: u32 = 8;
/// Halvings of such a part: below the resolution of `f64`.
const HALVINGS: u32 = 50;

/// A path near the position.
struct Near {
    runs: Runs,
    middle_m: Option<Point<f64>>,
    level: Option<u32>,
    /// Its segments near the position.
    segments: Vec<[Point<f64>; 4]>,
}

/// The place of a shown path that is nearest to `at_m`, within `reach_m`. `from_m` is the previous
/// point. In meters.
pub(super) fn nearest_object(
    document: &Document,
    at_m: Point<f64>,
    from_m: Option<Point<f64>>,
    reach_m: f64,
) -> Option<(Point<f64>, SnapTarget)> {
    let spot = Bounds {
        min: at_m,
        max: at_m,
    };
    let spot = spot.inflated(reach_m);
    let rows = document.index().paths_in(spot);
    let is_shown = |row: &u32| document.scene().state(*row) == PathState::Shown;
    let mut rows: Vec<u32> = rows.filter(is_shown).take(MAX_PATHS + 1).collect();
    rows.sort_unstable();
    if rows.len() > MAX_PATHS {
        return None;
    }
    let near: Vec<Near> = rows
        .into_iter()
        .filter_map(|row| Near::of(document, row, spot))
        .collect();
    let mut places = Vec::new();
    for (number, path) in near.iter().enumerate() {
        places.extend(path.own_places());
        if let Some(from_m) = from_m {
            let segments = path.segments.iter();
            segments.for_each(|segment| push_feet(segment, from_m, &mut places));
        }
        for other in &near[..number] {
            if path.level == other.level {
                let crossed = crossings(&path.near_runs(), &other.near_runs());
                // Paths on each other have no single crossings.
                let crossed = crossed.unwrap_or_default().into_iter();
                places.extend(crossed.map(|c| (c.position, SnapTarget::Crossing)));
            }
        }
    }
    let distance_m = |(place, _): &(Point<f64>, SnapTarget)| place.distance(at_m);
    places.retain(|place| distance_m(place) <= reach_m);
    // Of places at the same distance, the first one counts: an end before a foot there.
    let order = |a: &_, b: &_| distance_m(a).total_cmp(&distance_m(b));
    places.into_iter().min_by(order)
}

impl Near {
    /// The path of a row, if it passes near.
    fn of(document: &Document, row: u32, spot: Bounds<f64>) -> Option<Self> {
        let path = document.layout().paths.get(row as usize);
        let runs = runs_of(path);
        let segments = runs.segments().copied();
        let segments = segments.filter(|s| Bounds::of_segment(s).intersects(spot));
        let segments: Vec<_> = segments.collect();
        (!segments.is_empty()).then_some(Self {
            runs,
            middle_m: path.point_at(path.length_m() / 2.0),
            level: path.level(),
            segments,
        })
    }

    /// Ends and middle.
    fn own_places(&self) -> Vec<(Point<f64>, SnapTarget)> {
        let ends = [self.runs.start(), self.runs.end()].into_iter().flatten();
        let ends = ends.map(|end| (end, SnapTarget::End));
        let middle = self.middle_m.map(|middle| (middle, SnapTarget::Middle));
        ends.chain(middle).collect()
    }

    fn near_runs(&self) -> Runs {
        let mut runs = Runs::default();
        self.segments.iter().for_each(|segment| runs.push(segment));
        runs
    }
}

/// Appends the places of a segment where a line from `from_m` touches it, or meets it at a right
/// angle.
fn push_feet(
    segment: &[Point<f64>; 4],
    from_m: Point<f64>,
    places: &mut Vec<(Point<f64>, SnapTarget)>,
) {
    let line = |t: f64| uniform::point(segment, t) - from_m;
    let across = |t: f64| line(t).dot(uniform::derivative(segment, t));
    let along = |t: f64| line(t).cross(uniform::derivative(segment, t));
    let mut push = |value: &dyn Fn(f64) -> f64, to| {
        for part in 0..PARTS {
            let ends = [part, part + 1].map(|i| f64::from(i) / f64::from(PARTS));
            if let Some(t) = zero_between(value, ends) {
                places.push((uniform::point(segment, t), to));
            }
        }
    };
    push(&across, SnapTarget::Perpendicular);
    // On a line, all places or none would be tangent points.
    if !is_line(&uniform::to_bezier(segment)) {
        push(&along, SnapTarget::Tangent);
    }
}

/// The parameter between two others at which a function changes its sign.
fn zero_between(value: &dyn Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> Option<f64> {
    let is_positive = value(low) > 0.0;
    if is_positive == (value(high) > 0.0) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (value(middle) > 0.0) == is_positive {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}
