//! The selected tool, its gesture, and what points snap to.

use eframe::egui::Modifiers;
use guideway_document::{Document, EdgeTemplate, Element, Hit, Snapped};
use guideway_spline::Point;

use super::gesture::Gesture;
use super::snapping::{SnapSettings, snap_point};
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::typed_text::TypedText;
use crate::editing::EditTask;

/// The selected tool, the gesture in progress, and what is under the pointer.
#[derive(Default)]
pub(crate) struct Tools {
    pub(super) tool: Tool,
    pub(super) gesture: Gesture,
    /// The text that is typed instead of a click.
    pub(super) typed: Option<TypedText>,
    pub(super) hover: Option<Hit>,
    /// The station or node under the pointer, above the path.
    pub(super) hover_symbol: Option<Element>,
    /// The targets of moves and new points.
    pub(crate) snaps: SnapSettings,
    /// The properties of new paths.
    pub(crate) template: EdgeTemplate,
}

/// The effect of a pointer event on the document.
pub(crate) enum ToolEffect {
    /// A gesture began that may edit the document.
    ExpectEdit,
    Edit(EditTask),
    /// There is no such path; the notice says why.
    Refused(String),
}

impl Tools {
    pub(crate) fn tool(&self) -> Tool {
        self.tool
    }

    pub(crate) fn gesture(&self) -> &Gesture {
        &self.gesture
    }

    /// Selects a tool and aborts the gesture in progress.
    pub(crate) fn select(&mut self, tool: Tool) {
        (self.gesture, self.typed) = (Gesture::None, None);
        self.tool = tool;
    }

    /// Ends the drag in progress; what it has done so far stays.
    pub(crate) fn abort_drag(&mut self) {
        if !matches!(self.gesture, Gesture::Points(_)) {
            self.gesture = Gesture::None;
        }
    }

    /// Removes the last point of the path that is drawn or measured. Returns `false` if there is
    /// none.
    pub(crate) fn remove_last_point(&mut self) -> bool {
        let Gesture::Points(points) = &mut self.gesture else {
            return false;
        };
        points.pop();
        if points.is_empty() {
            self.gesture = Gesture::None;
        }
        true
    }

    /// Returns `true` while a gesture is in progress.
    pub(crate) fn has_gesture(&self) -> bool {
        !matches!(self.gesture, Gesture::None | Gesture::Idle)
    }

    /// Ends the gesture in progress and takes back what it did to the document.
    pub(crate) fn cancel_gesture(&mut self) -> Option<ToolEffect> {
        self.typed = None;
        let gesture = std::mem::take(&mut self.gesture);
        let (Gesture::Node { progress, .. } | Gesture::Handle { progress, .. }) = gesture else {
            return None;
        };
        let undo = EditTask::view_change(move |document| progress.take_back(document));
        Some(ToolEffect::Edit(undo))
    }

    /// The path under the pointer, unless a symbol is above it. `None` if the document was replaced
    /// by a shorter one.
    pub(crate) fn hovered(&self, document: Option<&Document>) -> Option<&Hit> {
        match self.hovered_symbol(document) {
            Some(_) => None,
            None => self.hovered_path(document),
        }
    }

    /// The path under the pointer, although a symbol may be above it.
    pub(super) fn hovered_path(&self, document: Option<&Document>) -> Option<&Hit> {
        let rows = document?.scene().row_count();
        self.hover.as_ref().filter(|hit| (hit.path as usize) < rows)
    }

    /// The station or node under the pointer, which a click would select.
    pub(crate) fn hovered_symbol(&self, document: Option<&Document>) -> Option<Element> {
        let document = document?;
        self.hover_symbol
            .filter(|&symbol| self.tool == Tool::Select && document.contains(symbol))
    }

    /// Takes the station or node under the pointer.
    pub(crate) fn hover_symbol(&mut self, symbol: Option<Element>) {
        self.hover_symbol = symbol;
    }

    /// Forgets what is under the pointer.
    pub(crate) fn clear_hover(&mut self) {
        (self.hover, self.hover_symbol) = (None, None);
    }

    /// The position meant by a click at `at_m`: a node, a place of a path, a direction (Shift), a
    /// grid point, or `at_m` itself (Alt).
    pub(crate) fn snapped(
        &self,
        context: &ToolContext<'_>,
        at_m: Point<f64>,
        modifiers: Modifiers,
    ) -> Snapped {
        snap_point(context, &self.gesture, self.snaps, at_m, modifiers)
    }

    /// The target of a click or drag at the pointer; `None` if nothing snaps.
    pub(crate) fn snap_target(
        &self,
        context: &ToolContext<'_>,
        at_m: Point<f64>,
        modifiers: Modifiers,
    ) -> Option<Snapped> {
        let drags = matches!(self.gesture, Gesture::Node { .. } | Gesture::Handle { .. });
        let snaps = self.tool.adds_points() || drags;
        let snapped = snaps.then(|| self.snapped(context, at_m, modifiers));
        snapped.filter(|snapped| snapped.to.is_some())
    }
}
