//! Gives pointer events to the selected tool, which turns them into edits.

use eframe::egui::Modifiers;
use guideway_spline::Point;

use super::gesture::Gesture;
use super::hit_test::MAX_HOVER_CANDIDATES;
use super::pointer_event::PointerEvent;
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::{ToolEffect, Tools};

impl Tools {
    /// Handles a pointer event.
    pub(crate) fn handle(
        &mut self,
        event: PointerEvent,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        match event {
            PointerEvent::Hover(at_px) => {
                if matches!(self.gesture, Gesture::None | Gesture::Points(_)) {
                    let pick = |at_px| context.pick(at_px, MAX_HOVER_CANDIDATES);
                    self.hover = at_px.and_then(pick);
                }
                None
            }
            PointerEvent::DragStarted(at_px) => self.begin_drag(at_px, context),
            PointerEvent::Dragged(at_px, modifiers) => self.drag(at_px, modifiers, context),
            PointerEvent::DragEnded(modifiers) => self.end_drag(modifiers, context),
            PointerEvent::Cancelled => self.cancel_gesture(),
            PointerEvent::Clicked(at_px, modifiers) => self.click(at_px, modifiers, context),
            PointerEvent::DoubleClicked => self.double_click(context),
            PointerEvent::SecondaryClicked => self.finish_path(context),
            PointerEvent::InsertPoint(at_px) => self.change_points(at_px, true, context),
            PointerEvent::RemovePoint(at_px) => self.change_points(at_px, false, context),
        }
    }

    fn click(
        &mut self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        if self.tool.adds_points() {
            let snapped = self.snapped(context, context.world(at_px), modifiers);
            return self.add_point(snapped, context);
        }
        Some(self.select_at(at_px, modifiers, context))
    }

    fn double_click(&mut self, context: &ToolContext<'_>) -> Option<ToolEffect> {
        match self.tool {
            Tool::Line | Tool::Arc | Tool::Curve | Tool::Bezier => {
                return self.finish_path(context);
            }
            Tool::Measure => self.gesture = Gesture::None,
            Tool::Select if self.hovered_path(context.document).is_some() => {
                self.select(Tool::Points);
            }
            Tool::Select | Tool::Points | Tool::Node | Tool::Station => {}
        }
        None
    }
}

#[cfg(test)]
mod tests;
