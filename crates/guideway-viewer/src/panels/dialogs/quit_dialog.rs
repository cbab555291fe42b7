//! The question about unsaved changes before the window closes.

use eframe::egui::{Context, Id, Modal, ViewportCommand};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::files::OpenFiles;

/// The dialog and its last answer.
#[derive(Default)]
pub(crate) struct QuitDialog {
    is_open: bool,
    /// True if the user has decided to discard unsaved changes.
    discards_changes: bool,
}

impl QuitDialog {
    /// Closes the window, or asks first if there are unsaved changes.
    pub(crate) fn quit(&mut self, ctx: &Context, files: &OpenFiles) {
        if files.has_changes() {
            self.is_open = true;
        } else {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
    }

    /// Closes the window although there are unsaved changes.
    pub(crate) fn quit_without_saving(&mut self, ctx: &Context) {
        self.discards_changes = true;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    pub(super) fn close(&mut self) {
        self.is_open = false;
    }

    /// Shows the question, also when the window manager closes the window.
    pub(super) fn show(&mut self, ctx: &Context, files: &OpenFiles) -> Option<Action> {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && files.has_changes() && !self.discards_changes {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.is_open = true;
        }
        if !self.is_open {
            return None;
        }
        if !files.has_changes() {
            // The save in progress is complete.
            self.is_open = false;
            ctx.send_viewport_cmd(ViewportCommand::Close);
            return None;
        }
        let mut action = None;
        Modal::new(Id::unique("quit")).show(ctx, |ui| {
            ui.label("Unsaved changes in:");
            for layer in files.layers().iter().filter(|layer| layer.is_changed()) {
                ui.label(shown_path(layer.path()));
            }
            ui.horizontal(|ui| {
                if ui.button("Quit without saving").clicked() {
                    action = Some(Action::QuitWithoutSaving);
                }
                if ui.button("Keep editing").clicked() {
                    self.is_open = false;
                }
            });
        });
        action
    }
}
