//! The tool that selects: clicks on stations, nodes and paths.

use eframe::egui::Modifiers;
use guideway_document::{Elements, Hit, SelectMode};
use guideway_spline::Point;

use super::hit_test::MAX_HOVER_CANDIDATES;
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::{ToolEffect, Tools};
use crate::editing::EditTask;

impl Tools {
    /// Selects what is under the pointer.
    pub(super) fn select_at(
        &self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> ToolEffect {
        // The path is looked for when the document is back from the edits in progress.
        let (mut context, mode) = (context.detached(), select_mode(modifiers));
        if self.tool != Tool::Select {
            (context.picks.nodes, context.picks.stations) = (false, false);
        }
        ToolEffect::Edit(EditTask::view_change(move |document| {
            let context = context.of(document);
            let elements = match context.pick_symbol(at_px) {
                Some(symbol) => Elements::of(symbol),
                None => {
                    let hit = context.pick(at_px, usize::MAX);
                    let hit = hit.map(|hit| alternate_in_pair(hit, &context));
                    Elements::of_paths(hit.iter().map(|hit| hit.path))
                }
            };
            document.select_elements(&elements, mode);
        }))
    }
}

/// The path of a hit; a click selects the topmost of two paths on the same line, and the next click
/// the other one.
fn alternate_in_pair(hit: Hit, context: &ToolContext<'_>) -> Hit {
    let other = || {
        let document = context.document?;
        let selected = document.selection();
        let is_only = selected.len() == 1 && selected.contains(hit.path);
        is_only.then(|| document.reverse_path_at(&hit, MAX_HOVER_CANDIDATES))?
    };
    let path = other().unwrap_or(hit.path);
    Hit { path, ..hit }
}

/// The change of the selection by a click or a box.
pub(super) fn select_mode(modifiers: Modifiers) -> SelectMode {
    if modifiers.shift {
        SelectMode::Add
    } else if modifiers.alt || modifiers.command {
        SelectMode::Remove
    } else {
        SelectMode::Replace
    }
}
