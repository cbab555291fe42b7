//! The one-line question for a number or a name that a command needs.

use eframe::egui::{Context, Id, Key, Modal, TextEdit};

use crate::action::Action;
use crate::language::t;
use crate::selection::{TextQuestion, prompted_edit};

/// The dialog; open while it has a question.
#[derive(Default)]
pub(crate) struct TextDialog {
    open: Option<OpenQuestion>,
}

struct OpenQuestion {
    question: TextQuestion,
    /// The mistake in the text.
    error: Option<String>,
    /// True if the field takes the focus in the next frame.
    wants_focus: bool,
}

impl TextDialog {
    pub(crate) fn ask(&mut self, question: TextQuestion) {
        self.open = Some(OpenQuestion {
            question,
            error: None,
            wants_focus: true,
        });
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Shows the question, and returns the edit of its answer. A wrong answer stays, with its
    /// error.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let open = self.open.as_mut()?;
        let (mut is_answered, mut is_cancelled) = (false, false);
        let modal = Modal::new(Id::unique("text question")).show(ctx, |ui| {
            ui.strong(open.question.command.name());
            let label = ui.label(&open.question.label);
            let field = TextEdit::singleline(&mut open.question.text).desired_width(280.0);
            let field = ui.add(field).labelled_by(label.id);
            if std::mem::take(&mut open.wants_focus) {
                field.request_focus();
            }
            if let Some(error) = &open.error {
                ui.colored_label(ui.visuals().error_fg_color, error);
            }
            ui.horizontal(|ui| {
                let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                is_answered = ui.button(t("OK")).clicked() || enters;
                is_cancelled = ui.button(t("Cancel")).clicked();
            });
        });
        if is_cancelled || (modal.should_close() && !is_answered) {
            self.open = None;
            return None;
        }
        if !is_answered {
            return None;
        }
        match prompted_edit(open.question.command, &open.question.text) {
            Ok(edit) => {
                let TextQuestion {
                    text, renamed_type, ..
                } = self.open.take()?.question;
                Some(Action::of_field(edit, renamed_type, &text))
            }
            Err(error) => {
                (open.error, open.wants_focus) = (Some(error), true);
                None
            }
        }
    }
}
