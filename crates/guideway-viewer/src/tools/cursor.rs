//! The cursor over the canvas.

use eframe::egui::CursorIcon;
use guideway_document::{Document, Element};

use super::gesture::Gesture;
use super::tool_set::Tools;

impl Tools {
    /// The cursor over the canvas, which shows what a press would do.
    pub(crate) fn cursor(&self, document: Option<&Document>) -> CursorIcon {
        match (self.gesture(), self.tool()) {
            (Gesture::Move { .. } | Gesture::Node { .. } | Gesture::Handle { .. }, _) => {
                CursorIcon::Move
            }
            (_, tool) if tool.adds_points() => CursorIcon::Crosshair,
            _ => {
                let path = self.hovered(document).map(|hit| Element::Path(hit.path));
                let is_selected =
                    |element| document.is_some_and(|d| d.selected().contains(element));
                match self.hovered_symbol(document).or(path) {
                    Some(element) if is_selected(element) => CursorIcon::Move,
                    Some(_) => CursorIcon::PointingHand,
                    None => CursorIcon::Default,
                }
            }
        }
    }
}
