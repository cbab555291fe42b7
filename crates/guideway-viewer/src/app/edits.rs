//! Runs edits of the active document, and the effects of tools.

use super::state::App;
use crate::canvas::Canvas;
use crate::display_settings::DisplaySettings;
use crate::editing::EditTask;
use crate::files::{LayerEvent, OpenFiles};
use crate::tools::{ToolContext, ToolEffect};

impl App {
    /// Runs an edit of the active document. One that takes longer than a frame continues in the
    /// background.
    pub(crate) fn edit(&mut self, task: EditTask) {
        let (wait, repaint) = (self.edit_wait, &self.context.repaint);
        let layer = self.files.active_mut();
        let event = layer.and_then(|layer| layer.run(task, wait, repaint));
        if let Some(LayerEvent::Notice(text)) = event {
            self.dialogs.notices.add(text);
        }
    }

    /// Runs the effect of an event on a tool.
    pub(super) fn apply_effect(&mut self, effect: Option<ToolEffect>) {
        match effect {
            Some(ToolEffect::Edit(task)) => self.edit(task),
            Some(ToolEffect::Refused(why)) => self.dialogs.notices.add(why),
            Some(ToolEffect::ExpectEdit) => {
                if let Some(layer) = self.files.active_mut() {
                    layer.slot.expect_edit(&self.context.repaint);
                }
            }
            None => {}
        }
    }
}

/// The input of the tools; `None` while the canvas has no size.
pub(super) fn tool_context<'a>(
    files: &'a OpenFiles,
    canvas: &Canvas,
    settings: &DisplaySettings,
) -> Option<ToolContext<'a>> {
    let view = canvas.camera.view()?;
    Some(ToolContext {
        view,
        document: files.document(),
        line_rule: settings.line_rule(),
        picks_symbols: settings.has_symbols,
        grid_step_m: settings.grid_step_m(&view, canvas.px_per_point()),
    })
}
