//! The question about unsaved work of an earlier run.

use eframe::egui::{Context, Id, Modal};

use crate::action::Action;
use crate::files::{Layer, OpenFiles};

/// Asks about the first file with undecided work.
pub(super) fn show(ctx: &Context, files: &OpenFiles) -> Option<Action> {
    let is_undecided = |layer: &Layer| layer.has_unsaved_work() && !layer.is_recovering();
    let index = files.layers().iter().position(is_undecided)?;
    let name = files.layers()[index].name();
    let mut action = None;
    Modal::new(Id::unique("recover")).show(ctx, |ui| {
        ui.label(format!(
            "{name} has unsaved work from the last run of the viewer."
        ));
        ui.horizontal(|ui| {
            if ui.button("Recover").clicked() {
                action = Some(Action::Recover(index));
            }
            if ui.button("Discard").clicked() {
                action = Some(Action::DiscardUnsavedWork(index));
            }
        });
    });
    action
}
