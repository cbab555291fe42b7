//! The question before an action that would lose content on disk or in the window.

use std::path::PathBuf;

use eframe::egui::{Context, Id, Modal};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::command::Command;
use crate::language::{say, t};

/// An action that awaits a confirmation, and why it does.
pub(crate) struct Question {
    /// The file that would lose content.
    pub(crate) file: PathBuf,
    pub(crate) risk: Risk,
    /// The action that a confirmation allows.
    pub(crate) confirmed: Action,
}

/// The content that an action would lose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Risk {
    /// A file that is not open here would be replaced. The command asks for another name.
    ReplacesFile(Command),
    /// Changes that another program made since the file was read would be overwritten.
    OverwritesChanges,
    /// Unsaved changes in the window would be discarded.
    DiscardsChanges,
}

/// The dialog; open while it has a question.
#[derive(Default)]
pub(crate) struct ConfirmDialog {
    question: Option<Question>,
}

impl ConfirmDialog {
    pub(crate) fn ask(&mut self, question: Question) {
        self.question = Some(question);
    }

    pub(crate) fn is_open(&self) -> bool {
        self.question.is_some()
    }

    pub(super) fn close(&mut self) {
        self.question = None;
    }

    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let question = self.question.as_ref()?;
        let file = shown_path(&question.file);
        let (text, confirm, others): (_, _, &[_]) = match question.risk {
            Risk::ReplacesFile(other) => (
                say!("{file} exists already.", file),
                t("Replace it"),
                &[(t("Choose another name"), other)],
            ),
            Risk::OverwritesChanges => (
                say!(
                    "Another program has changed {file} since it was read here.",
                    file
                ),
                t("Overwrite its changes"),
                &[
                    (t("Save under another name"), Command::SaveAs),
                    (t("Read it again"), Command::Reload),
                ],
            ),
            Risk::DiscardsChanges => (
                say!("Reading {file} again discards your unsaved changes.", file),
                t("Discard them"),
                &[],
            ),
        };
        let mut answer = None;
        Modal::new(Id::unique("confirm")).show(ctx, |ui| {
            ui.label(text);
            ui.horizontal(|ui| {
                if ui.button(confirm).clicked() {
                    answer = Some(Answer::Confirmed);
                }
                for &(label, command) in others {
                    if ui.button(label).clicked() {
                        answer = Some(Answer::Instead(command));
                    }
                }
                if ui.button(t("Cancel")).clicked() {
                    answer = Some(Answer::Cancelled);
                }
            });
        });
        let answer = answer?;
        let question = self.question.take()?;
        match answer {
            Answer::Confirmed => Some(question.confirmed),
            Answer::Instead(command) => Some(Action::Command(command)),
            Answer::Cancelled => None,
        }
    }
}

enum Answer {
    Confirmed,
    Instead(Command),
    Cancelled,
}
