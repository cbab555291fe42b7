//! The answer to a question: its edit while that runs, and the reason where it is refused.

use eframe::egui::{Context, Ui};

use crate::action::Action;
use crate::background::lay_out_again;
use crate::editing::{EditOutcome, EditTask};
use crate::language::translated;

pub(super) struct Answer {
    /// The edit, while it runs.
    outcome: Option<EditOutcome>,
    /// The mistake in what was typed, or why the edit was refused.
    error: Option<String>,
    wants_focus: bool,
}

impl Default for Answer {
    fn default() -> Self {
        Self {
            outcome: None,
            error: None,
            wants_focus: true,
        }
    }
}

impl Answer {
    /// Returns `true` while the edit runs.
    pub(super) fn is_running(&self) -> bool {
        self.outcome.is_some()
    }

    /// Returns `true` once if the first field is to take the focus.
    pub(super) fn takes_focus(&mut self) -> bool {
        std::mem::take(&mut self.wants_focus)
    }

    /// Shows the mistake or the reason.
    pub(super) fn show_error(&self, ui: &mut Ui) {
        if let Some(error) = &self.error {
            ui.colored_label(ui.visuals().error_fg_color, translated(error));
        }
    }

    /// Takes the edit of what was typed, or the mistake in it. Returns the action that runs it.
    pub(super) fn give(&mut self, edit: Result<EditTask, String>, ctx: &Context) -> Option<Action> {
        match edit {
            Ok(edit) => {
                let (edit, outcome) = edit.with_outcome();
                (self.outcome, self.error) = (Some(outcome), None);
                lay_out_again(ctx, "the edit of the dialog starts");
                Some(Action::Edit(edit))
            }
            Err(error) => {
                self.refuse(error);
                None
            }
        }
    }

    /// Returns `true` when the edit is in the document. One that is refused leaves the reason.
    pub(super) fn poll(&mut self) -> bool {
        match self.outcome.as_ref().and_then(EditOutcome::poll) {
            None => false,
            Some(Ok(())) => true,
            Some(Err(error)) => {
                self.outcome = None;
                self.refuse(error);
                false
            }
        }
    }

    fn refuse(&mut self, error: String) {
        (self.error, self.wants_focus) = (Some(error), true);
    }
}
