//! The one-line question for a number or a name that a command needs.

use eframe::egui::{Button, Context, Id, Key, Modal, TextEdit};

use super::answer::Answer;
use crate::action::{Action, TypeRename};
use crate::language::t;
use crate::panels::text_focus::focus_all;
use crate::selection::{TextQuestion, prompted_edit};

/// Width of the field, in points.
const WIDTH: f32 = 280.0;

/// The dialog; open while it has a question.
#[derive(Default)]
pub(crate) struct TextDialog {
    open: Option<OpenQuestion>,
}

struct OpenQuestion {
    question: TextQuestion,
    answer: Answer,
}

impl TextDialog {
    pub(crate) fn ask(&mut self, question: TextQuestion) {
        self.open = Some(OpenQuestion {
            question,
            answer: Answer::default(),
        });
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self) {
        self.open = None;
    }

    /// Closes the question when the edit of its answer is complete. One that is refused stays, with
    /// the reason.
    pub(super) fn poll(&mut self) -> Option<Action> {
        let answered = self.open.take_if(|open| open.answer.poll())?;
        let TextQuestion {
            text, renamed_type, ..
        } = answered.question;
        let new = text.trim().to_owned();
        renamed_type.map(|old| Action::VehicleTypeRenamed(TypeRename { old, new }))
    }

    /// Shows the question, and returns the edit of its answer. A wrong answer stays, with its
    /// error.
    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let open = self.open.as_mut()?;
        let (mut is_answered, mut is_cancelled) = (false, false);
        let is_waiting = open.answer.is_running();
        let modal = Modal::new(Id::unique("text question")).show(ctx, |ui| {
            ui.set_max_width(WIDTH);
            ui.strong(open.question.command.name());
            let label = ui.label(&open.question.label);
            let field = TextEdit::singleline(&mut open.question.text).desired_width(WIDTH);
            let field = ui.add_enabled(!is_waiting, field).labelled_by(label.id);
            if open.answer.takes_focus() {
                focus_all(ctx, &field, &open.question.text);
            }
            open.answer.show_error(ui);
            ui.horizontal(|ui| {
                let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                let ok = ui.add_enabled(!is_waiting, Button::new(t("OK")));
                is_answered = ok.clicked() || enters;
                is_cancelled = ui.button(t("Cancel")).clicked();
            });
        });
        if is_cancelled || (modal.should_close() && !is_answered) {
            self.open = None;
            return None;
        }
        if !is_answered || is_waiting {
            return None;
        }
        let edit = prompted_edit(open.question.command, &open.question.text);
        open.answer.give(edit, ctx)
    }
}
