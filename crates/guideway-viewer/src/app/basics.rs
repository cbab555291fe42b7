//! Steps that all parts of the application take: edit, recolor, tell the user.

use eframe::egui::Context;

use super::state::App;
use crate::canvas::Canvas;
use crate::display_settings::DisplaySettings;
use crate::editing::EditTask;
use crate::files::{Layer, LayerEvent, OpenFiles, layer_tool_context};
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

    /// Recolors all files whose scenes have other options.
    pub(crate) fn recolor(&mut self) {
        self.files.recolor(&self.settings.scene_options());
    }

    pub(super) fn notify_all(&mut self, notices: impl IntoIterator<Item = String>) {
        for notice in notices {
            self.dialogs.notices.add(notice);
        }
    }
}

/// The input of the tools in the active file; `None` while the canvas has no size.
pub(super) fn tool_context<'a>(
    files: &'a OpenFiles,
    canvas: &Canvas,
    settings: &DisplaySettings,
) -> Option<ToolContext<'a>> {
    tool_context_of(files.active(), canvas, settings)
}

/// The input of the tools in one file, or without one; `None` while the canvas has no size.
pub(super) fn tool_context_of<'a>(
    layer: Option<&'a Layer>,
    canvas: &Canvas,
    settings: &DisplaySettings,
) -> Option<ToolContext<'a>> {
    let view = canvas.camera.view()?;
    Some(layer_tool_context(
        layer,
        view,
        settings,
        canvas.px_per_point(),
    ))
}

/// Takes the keyboard focus from a text field, so that shortcuts work again.
pub(super) fn release_keyboard(ctx: &Context) {
    if let Some(field) = ctx.memory(|memory| memory.focused()) {
        ctx.memory_mut(|memory| memory.surrender_focus(field));
    }
}
