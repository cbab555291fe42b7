//! Positions of direction arrows and label anchors along a path.

use guideway_layout::{Direction, PathRef};
use guideway_scene::View;
use guideway_spline::{Bounds, Point, nearest_on_run, segment_length, uniform};

use super::marks::Arrow;

/// Distance between arrows, in points.
const SPACING_POINTS: f64 = 160.0;
/// Shortest path with an arrow, in points.
const MIN_LENGTH_POINTS: f64 = 24.0;
/// Most arrows per segment in a view; the arrows nearest to its center remain.
const MAX_PER_SEGMENT: f64 = 64.0;

/// The arrows of a path in a view, spaced evenly along the whole path, so that they do not slide
/// when the view moves. `is_pair` means that a reverse path lies on it; `line_radius_px` is half
/// the width of its line.
pub(super) fn along(
    path: PathRef<'_>,
    is_pair: bool,
    line_radius_px: f64,
    view: &View,
    px_per_point: f64,
) -> Vec<Arrow> {
    let visible = view.world_bounds();
    let tolerance_m = 0.5 / view.px_per_m();
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let lengths_m = segments.iter().map(|s| segment_length(s, tolerance_m));
    let lengths_m: Vec<f64> = lengths_m.collect();
    let length_m: f64 = lengths_m.iter().sum();
    let length_px = length_m * view.px_per_m();
    if length_px < MIN_LENGTH_POINTS * px_per_point {
        return Vec::new();
    }
    let spacing_m = length_m
        / (length_px / (SPACING_POINTS * px_per_point))
            .round()
            .max(1.0);
    let is_two_way = is_pair || path.direction() == Direction::Both;
    let arrow = |segment, t| {
        let (at_px, direction) = position(segment, t, view)?;
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
        if segment_m > 0.0 && Bounds::of_segment(segment).intersects(visible) {
            let ordinal = |along_m: f64| (along_m / spacing_m - 0.5).ceil();
            let (mut first, mut end) = (ordinal(from_m), ordinal(to_m));
            if end - first > MAX_PER_SEGMENT {
                let middle = nearest_on_run(segment, view.center_m(), tolerance_m);
                let middle = ordinal(from_m + middle.map_or(0.0, |near| near.t) * segment_m);
                first = first.max(middle - MAX_PER_SEGMENT / 2.0);
                end = end.min(middle + MAX_PER_SEGMENT / 2.0);
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

/// Position and direction of a segment at `t`, in pixels; `None` outside the view.
fn position(segment: &[Point<f64>; 4], t: f64, view: &View) -> Option<(Point<f64>, Point<f64>)> {
    let at = uniform::point(segment, t);
    let velocity = uniform::derivative(segment, t);
    let speed = velocity.norm();
    let is_visible = view.world_bounds().contains(at) && speed > 0.0;
    is_visible.then(|| {
        let direction = Point::new(velocity.x / speed, -velocity.y / speed);
        (view.pixel_from_world(at), direction)
    })
}

/// Anchor of a path's label, on its middle segment: position and direction in pixels. `None` if the
/// path is too short for a label or the anchor is outside the view.
pub(super) fn middle(
    path: PathRef<'_>,
    view: &View,
    px_per_point: f64,
) -> Option<(Point<f64>, Point<f64>)> {
    let size_px = path.hull_bounds()?.size() * view.px_per_m();
    let count: usize = path.runs().map(|run| run.segments().len()).sum();
    let segment = path.runs().flat_map(|run| run.segments()).nth(count / 2)?;
    let t = if count.is_multiple_of(2) { 0.0 } else { 0.5 };
    let fits = size_px.norm() >= 2.0 * MIN_LENGTH_POINTS * px_per_point;
    position(&segment, t, view).filter(|_| fits)
}
