//! The cursor over the canvas.

use eframe::egui::CursorIcon;
use guideway_document::{Document, Hit};

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
                let hovered = self.hovered(document);
                let is_selected =
                    |hit: &Hit| document.is_some_and(|d| d.selection().contains(hit.path));
                match hovered {
                    Some(hit) if is_selected(hit) => CursorIcon::Move,
                    Some(_) => CursorIcon::PointingHand,
                    None => CursorIcon::Default,
                }
            }
        }
    }
}
