//! The question about unsaved changes before a file or the window closes.

use std::path::PathBuf;

use eframe::egui::{Context, Id, Modal, ViewportCommand};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::files::{Layer, OpenFiles};
use crate::language::t;

/// The part of the window that closes.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Leave {
    /// One file.
    File(PathBuf),
    /// All files and the window.
    Window,
}

/// The dialog and its last answer.
#[derive(Default)]
pub(crate) struct LeaveDialog {
    leave: Option<Leave>,
    /// True while changes are being saved, after which the file or window closes.
    is_saving: bool,
    /// True if the user has decided to discard unsaved changes.
    discards_changes: bool,
}

impl LeaveDialog {
    /// Closes the window, or asks first if there are unsaved changes.
    pub(crate) fn quit(&mut self, ctx: &Context, files: &OpenFiles) {
        if files.has_changes() {
            self.leave = Some(Leave::Window);
        } else {
            ctx.send_viewport_cmd(ViewportCommand::Close);
        }
    }

    /// Asks about the unsaved changes of a file before it closes.
    pub(crate) fn close_file(&mut self, path: PathBuf) {
        self.leave = Some(Leave::File(path));
    }

    /// Closes the window although there are unsaved changes.
    pub(crate) fn quit_without_saving(&mut self, ctx: &Context) {
        self.discards_changes = true;
        ctx.send_viewport_cmd(ViewportCommand::Close);
    }

    /// Saves the changes before the file or window closes: see [`Self::next_to_save`].
    pub(crate) fn save_first(&mut self) {
        self.is_saving = true;
    }

    /// The next file to save before the file or window closes.
    pub(crate) fn next_to_save(&self, files: &OpenFiles) -> Option<usize> {
        let leave = self.leave.as_ref().filter(|_| self.is_saving)?;
        let is_unsaved = |layer: &Layer| !layer.save.is_saving() && leave.concerns(layer);
        files.layers().iter().position(is_unsaved)
    }

    pub(crate) fn is_open(&self) -> bool {
        self.leave.is_some()
    }

    /// Leaves everything open.
    pub(crate) fn close(&mut self) {
        (self.leave, self.is_saving) = (None, false);
    }

    /// Shows the question, also when the window manager closes the window.
    pub(super) fn show(&mut self, ctx: &Context, files: &OpenFiles) -> Option<Action> {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && files.has_changes() && !self.discards_changes {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.leave = Some(Leave::Window);
        }
        let leave = self.leave.clone()?;
        let concerned = files.layers().iter().filter(|layer| leave.concerns(layer));
        let concerned: Vec<&Layer> = concerned.collect();
        if concerned.is_empty() {
            self.close();
            return match &leave {
                Leave::Window => {
                    ctx.send_viewport_cmd(ViewportCommand::Close);
                    None
                }
                Leave::File(path) => files.index_of(path).map(Action::CloseWithoutSaving),
            };
        }
        let mut action = None;
        let (save, discard) = match leave {
            Leave::Window => (t("Save and quit"), t("Quit without saving")),
            Leave::File(_) => (t("Save and close"), t("Close without saving")),
        };
        Modal::new(Id::unique("leave")).show(ctx, |ui| {
            ui.label(match self.is_saving {
                true => t("Saving:"),
                false => t("Unsaved changes in:"),
            });
            for layer in &concerned {
                ui.label(shown_path(layer.path()));
            }
            ui.horizontal(|ui| {
                if !self.is_saving && ui.button(save).clicked() {
                    action = Some(Action::SaveAndLeave);
                }
                if ui.button(discard).clicked() {
                    action = Some(match &leave {
                        Leave::Window => Action::QuitWithoutSaving,
                        Leave::File(path) => match files.index_of(path) {
                            Some(index) => Action::CloseWithoutSaving(index),
                            None => return,
                        },
                    });
                }
                if ui.button(t("Keep editing")).clicked() {
                    self.close();
                }
            });
        });
        action
    }
}

impl Leave {
    /// Returns `true` if the file has changes that closing would lose.
    fn concerns(&self, layer: &Layer) -> bool {
        let is_left = match self {
            Self::File(path) => layer.is_at(path),
            Self::Window => true,
        };
        is_left && layer.is_changed()
    }
}
