//! Snapping of points and moves: to nodes, to the grid, to directions.

use eframe::egui::Modifiers;
use guideway_document::SnapOptions;
use guideway_document::decorations::round_step;
use guideway_scene::View;
use guideway_spline::Point;

use super::gesture::Gesture;
use super::tool_context::ToolContext;

/// With Shift, lines and moves snap to multiples of 360° / 24 = 15°.
const DIRECTIONS: u32 = 24;
/// Least distance of snap grid lines on screen, in pixels.
const MIN_GRID_PX: f64 = 24.0;

/// The position meant by a click or drag at `at_m`: a node near it, a direction (Shift), a grid
/// point, or `at_m` itself (Alt).
pub(super) fn snap_point(
    context: &ToolContext<'_>,
    gesture: &Gesture,
    to_grid: bool,
    at_m: Point<f64>,
    modifiers: Modifiers,
) -> Point<f64> {
    let Some(document) = context.document.filter(|_| !modifiers.alt) else {
        return at_m;
    };
    let (from_m, moving_node) = match gesture {
        Gesture::Points(points) => (points.last().copied(), None),
        Gesture::Handle { from_m, .. } => (Some(*from_m), None),
        Gesture::Node { node, from_m, .. } => (Some(*from_m), Some(*node)),
        _ => (None, None),
    };
    let snap = SnapOptions {
        node_reach_m: Some(context.hit_radius_m()),
        moving_node,
        object_reach_m: None,
        grid_m: to_grid.then(|| grid_step_m(&context.view)),
        directions: modifiers.shift.then_some(DIRECTIONS),
    };
    document.snap(&snap, at_m, from_m).at_m
}

/// The node near `at_m`, unless Alt turns snapping off.
pub(super) fn snap_to_node(
    context: &ToolContext<'_>,
    at_m: Point<f64>,
    modifiers: Modifiers,
) -> Option<Point<f64>> {
    let document = context.document.filter(|_| !modifiers.alt)?;
    let node = document.node_near(at_m, context.hit_radius_m())?;
    Some(document.node_position_m(node))
}

/// The translation meant by a drag of `by_m`: a direction (Shift), grid steps, or `by_m` (Alt).
pub(super) fn snap_move(
    context: &ToolContext<'_>,
    to_grid: bool,
    by_m: Point<f64>,
    modifiers: Modifiers,
) -> Point<f64> {
    let Some(document) = context.document.filter(|_| !modifiers.alt) else {
        return by_m;
    };
    let snap = SnapOptions {
        grid_m: to_grid.then(|| grid_step_m(&context.view)),
        directions: modifiers.shift.then_some(DIRECTIONS),
        ..SnapOptions::default()
    };
    document
        .snap(&snap, by_m, Some(Point::new(0.0, 0.0)))
        .at_m
}

/// Distance of snap grid lines: a round number of meters, at least [`MIN_GRID_PX`] on screen.
fn grid_step_m(view: &View) -> f64 {
    round_step(MIN_GRID_PX / view.px_per_m())
}
