//! The cursor over the canvas.

use eframe::egui::CursorIcon;
use guideway_document::Element;
use guideway_spline::Point;

use super::gesture::Gesture;
use super::hit_test::hit_handle;
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::Tools;

impl Tools {
    /// The cursor over the canvas, which shows what a press would do.
    pub(crate) fn cursor(&self, context: &ToolContext<'_>, at_px: Point<f64>) -> CursorIcon {
        match (self.gesture(), self.tool()) {
            (Gesture::Move { .. }, _) => CursorIcon::Move,
            (Gesture::Node { .. } | Gesture::Handle { .. }, _) => CursorIcon::Grabbing,
            (_, tool) if tool.adds_points() => CursorIcon::Crosshair,
            (_, Tool::Points) if has_grip(context, at_px) => CursorIcon::Grab,
            (_, tool) => {
                let document = context.document;
                let path = self.hovered(document).map(|hit| Element::Path(hit.path));
                let is_moved = |element| {
                    let is_selected = document.is_some_and(|d| d.selected().contains(element));
                    is_selected && tool == Tool::Select
                };
                match self.hovered_symbol(document).or(path) {
                    Some(element) if is_moved(element) => CursorIcon::Move,
                    Some(_) => CursorIcon::PointingHand,
                    None => CursorIcon::Default,
                }
            }
        }
    }
}

/// Returns `true` if a drag from here moves a control point or a node.
fn has_grip(context: &ToolContext<'_>, at_px: Point<f64>) -> bool {
    let Some(document) = context.document else {
        return false;
    };
    let (at_m, radius_m) = (context.world(at_px), context.hit_radius_m());
    hit_handle(document, &context.view, at_px).is_some()
        || document.node_near(at_m, radius_m).is_some()
}
