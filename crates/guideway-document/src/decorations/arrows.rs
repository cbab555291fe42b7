use guideway_layout::{Direction, PathRef};
use guideway_scene::View;
use guideway_spline::{Bounds, Point, nearest_on_run, segment_length, uniform};

use super::Arrow;

/// One arrow for so many points of a path.
const SPACING: f64 = 160.0;
/// A path of fewer points than this has none.
const LEAST: f64 = 24.0;
/// Most arrows of one segment in a view; those nearest to the middle of the view.
const MOST_A_SEGMENT: f64 = 64.0;

/// The arrows of one path in a view, evenly along it, so that they stay on their places as the view moves. `is_pair`: another
/// one leads back on it. `line_radius_px` is half the width of its line. There are `px_per_point` pixels to a point.
pub(super) fn along(
    path: PathRef<'_>,
    is_pair: bool,
    line_radius_px: f64,
    view: &View,
    px_per_point: f64,
) -> Vec<Arrow> {
    let seen = view.world_bounds();
    let tolerance_m = 0.5 / view.px_per_m();
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let lengths_m = segments.iter().map(|s| segment_length(s, tolerance_m));
    let lengths_m: Vec<f64> = lengths_m.collect();
    let length_m: f64 = lengths_m.iter().sum();
    let length_px = length_m * view.px_per_m();
    if length_px < LEAST * px_per_point {
        return Vec::new();
    }
    let spacing_m = length_m / (length_px / (SPACING * px_per_point)).round().max(1.0);
    let is_two_way = is_pair || path.direction() == Direction::Both;
    let arrow = |segment, t| {
        let (at_px, direction) = place(segment, t, view)?;
        Some(Arrow {
            at_px,
            direction,
            is_two_way,
            line_radius_px,
        })
    };
    let mut arrows = Vec::new();
    let mut from_m = 0.0;
    for (segment, segment_m) in segments.iter().zip(lengths_m) {
        let to_m = from_m + segment_m;
        if segment_m > 0.0 && Bounds::of_segment(segment).intersects(seen) {
            let ordinal = |along_m: f64| (along_m / spacing_m - 0.5).ceil();
            let (mut first, mut end) = (ordinal(from_m), ordinal(to_m));
            if end - first > MOST_A_SEGMENT {
                let middle = nearest_on_run(segment, view.center_m(), tolerance_m);
                let middle = ordinal(from_m + middle.map_or(0.0, |near| near.t) * segment_m);
                first = first.max(middle - MOST_A_SEGMENT / 2.0);
                end = end.min(middle + MOST_A_SEGMENT / 2.0);
            }
            for k in first as i64..end as i64 {
                let t = (((k as f64 + 0.5) * spacing_m - from_m) / segment_m).clamp(0.0, 1.0);
                arrows.extend(arrow(segment, t));
            }
        }
        from_m = to_m;
    }
    arrows
}

/// A place of the view and the way that a segment goes there; none outside of the view.
fn place(segment: &[Point<f64>; 4], t: f64, view: &View) -> Option<(Point<f64>, Point<f64>)> {
    let at = uniform::point(segment, t);
    let velocity = uniform::derivative(segment, t);
    let speed = velocity.norm();
    let is_seen = view.world_bounds().contains(at) && speed > 0.0;
    is_seen.then(|| {
        let direction = Point::new(velocity.x / speed, -velocity.y / speed);
        (view.pixel_from_world(at), direction)
    })
}

/// Where the name of a path goes: on its middle segment; none if the path is too short for one or that is not
/// in the view.
pub(super) fn middle(path: PathRef<'_>, view: &View, px_per_point: f64) -> Option<Point<f64>> {
    let size_px = path.hull_bounds()?.size() * view.px_per_m();
    let count: usize = path.runs().map(|run| run.segments().len()).sum();
    let segment = path.runs().flat_map(|run| run.segments()).nth(count / 2)?;
    let t = if count.is_multiple_of(2) { 0.0 } else { 0.5 };
    let at = uniform::point(&segment, t);
    let fits = size_px.norm() >= 2.0 * LEAST * px_per_point && view.world_bounds().contains(at);
    fits.then(|| view.pixel_from_world(at))
}
