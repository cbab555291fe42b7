//! The question about unsaved work of an earlier run.

use eframe::egui::{Context, Id, Modal};

use crate::action::Action;
use crate::files::{Layer, OpenFiles};
use crate::language::{counted, duration, say, t};

/// Width of the dialog, in points: its buttons do not move with the length of the text.
const WIDTH: f32 = 340.0;

/// The first file with unsaved work about which the user has not decided.
pub(super) fn undecided(files: &OpenFiles) -> Option<usize> {
    let is_undecided = |layer: &Layer| layer.has_unsaved_work() && !layer.is_recovering();
    files.layers().iter().position(is_undecided)
}

/// Asks about the first file with undecided work.
pub(super) fn show(ctx: &Context, files: &OpenFiles) -> Option<Action> {
    let index = undecided(files)?;
    let layer = &files.layers()[index];
    let work = layer.slot.journal().unsaved_summary()?;
    let steps = counted(work.steps, "unsaved step");
    let age = work.last_written.elapsed().unwrap_or_default();
    let text = say!(
        "{name} has {steps} from an earlier run of this window, the last one {age} ago.",
        name = layer.name(),
        steps,
        age = duration(age)
    );
    let mut action = None;
    Modal::new(Id::unique("recover")).show(ctx, |ui| {
        ui.set_width(WIDTH);
        ui.label(text);
        ui.horizontal(|ui| {
            if ui.button(t("Recover")).clicked() {
                action = Some(Action::Recover(index));
            }
            if ui.button(t("Discard")).clicked() {
                action = Some(Action::DiscardUnsavedWork(index));
            }
        });
    });
    action
}
