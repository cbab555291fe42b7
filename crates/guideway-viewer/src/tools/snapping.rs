//! Snapping of points and moves: to nodes, to places of paths, to the grid, to directions.

use eframe::egui::Modifiers;
use guideway_document::{SnapOptions, Snapped};
use guideway_spline::Point;

use super::gesture::Gesture;
use super::tool_context::ToolContext;

/// With Shift, lines and moves snap to multiples of 360° / 24 = 15°.
const DIRECTIONS: u32 = 24;

/// The targets of points and moves, beside nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SnapSettings {
    /// Places of paths: ends, middles, crossings, feet, tangents.
    pub(crate) to_objects: bool,
    /// The lines of the grid, while they are shown.
    pub(crate) to_grid: bool,
}

impl Default for SnapSettings {
    fn default() -> Self {
        Self {
            to_objects: true,
            to_grid: false,
        }
    }
}

/// The position meant by a click or drag at `at_m`: a node, a place of a path, a direction (Shift),
/// a grid point, or `at_m` itself (Alt).
pub(super) fn snap_point(
    context: &ToolContext<'_>,
    gesture: &Gesture,
    snaps: SnapSettings,
    at_m: Point<f64>,
    modifiers: Modifiers,
) -> Snapped {
    let Some(document) = context.document.filter(|_| !modifiers.alt) else {
        return Snapped { at_m, to: None };
    };
    let (from_m, moving_node) = match gesture {
        Gesture::Points(points) => (points.last().copied(), None),
        Gesture::Handle { from_m, .. } => (Some(*from_m), None),
        Gesture::Node { node, from_m, .. } => (Some(*from_m), Some(*node)),
        _ => (None, None),
    };
    // The path of a dragged point is no target for it.
    let drags = matches!(gesture, Gesture::Handle { .. } | Gesture::Node { .. });
    let to_objects = snaps.to_objects && !drags;
    let snap = SnapOptions {
        node_reach_m: Some(context.hit_radius_m()),
        moving_node,
        object_reach_m: to_objects.then(|| context.hit_radius_m()),
        grid_m: context.grid_step_m.filter(|_| snaps.to_grid),
        directions: modifiers.shift.then_some(DIRECTIONS),
    };
    document.snap(&snap, at_m, from_m)
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
    snaps: SnapSettings,
    by_m: Point<f64>,
    modifiers: Modifiers,
) -> Point<f64> {
    let Some(document) = context.document.filter(|_| !modifiers.alt) else {
        return by_m;
    };
    let snap = SnapOptions {
        grid_m: context.grid_step_m.filter(|_| snaps.to_grid),
        directions: modifiers.shift.then_some(DIRECTIONS),
        ..SnapOptions::default()
    };
    document.snap(&snap, by_m, Some(Point::new(0.0, 0.0))).at_m
}
