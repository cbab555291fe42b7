//! Dialogs over the window: prompts, questions, notices, help.

mod about_dialog;
mod answer;
mod confirm_dialog;
mod file_picker;
pub(crate) mod floor_plan_window;
mod group_deletion;
mod group_dialog;
mod leave_dialog;
mod loss_dialog;
mod notices;
mod path_line;
mod prompt;
mod prompt_kind;
mod recent_dialog;
mod recover_dialog;
mod settings_dialog;
mod shortcuts_window;
mod text_dialog;

use eframe::egui::{Context, Rect};

pub(crate) use about_dialog::AboutDialog;
pub(crate) use confirm_dialog::{ConfirmDialog, Question, Risk};
pub(crate) use file_picker::FilePicker;
pub(crate) use group_deletion::GroupDeletion;
pub(crate) use group_dialog::GroupDialog;
pub(crate) use leave_dialog::LeaveDialog;
pub(crate) use loss_dialog::LossDialog;
pub(crate) use notices::Notices;
pub(crate) use prompt::Prompt;
pub(crate) use recent_dialog::RecentDialog;
pub(crate) use settings_dialog::SettingsDialog;
pub(crate) use shortcuts_window::ShortcutsWindow;
pub(crate) use text_dialog::TextDialog;

use crate::action::Action;
use crate::files::{LayerContext, OpenFiles};

/// All dialogs; most are closed at any time.
#[derive(Default)]
pub(crate) struct Dialogs {
    pub(crate) prompt: Prompt,
    pub(crate) picker: FilePicker,
    pub(crate) losses: LossDialog,
    pub(crate) text: TextDialog,
    pub(crate) group: GroupDialog,
    pub(crate) deletion: GroupDeletion,
    pub(crate) recent: RecentDialog,
    pub(crate) leave: LeaveDialog,
    pub(crate) confirm: ConfirmDialog,
    pub(crate) notices: Notices,
    pub(crate) shortcuts: ShortcutsWindow,
    pub(crate) settings: SettingsDialog,
    pub(crate) about: AboutDialog,
}

impl Dialogs {
    /// Closes the open dialogs; the question about unsaved work stays. Returns `false` if there is
    /// none.
    pub(crate) fn close(&mut self) -> bool {
        // The line under it stays.
        if self.picker.is_open() {
            self.picker.close();
            return true;
        }
        let is_open = self.prompt.is_open()
            || self.losses.is_open()
            || self.text.is_open()
            || self.group.is_open()
            || self.deletion.is_open()
            || self.recent.is_open()
            || self.leave.is_open()
            || self.confirm.is_open()
            || self.shortcuts.is_open
            || self.settings.is_open
            || self.about.is_open;
        self.prompt.close();
        self.losses.close();
        self.text.close();
        self.group.close();
        self.deletion.close();
        self.recent.close();
        self.leave.close();
        self.confirm.close();
        self.shortcuts.is_open = false;
        self.settings.is_open = false;
        self.about.is_open = false;
        is_open
    }

    /// Returns `true` if a dialog waits for an answer: until then keys do nothing else.
    pub(crate) fn is_modal(&self, files: &OpenFiles) -> bool {
        self.prompt.is_open()
            || self.picker.is_open()
            || self.losses.is_open()
            || self.text.is_open()
            || self.group.is_open()
            || self.deletion.is_open()
            || self.recent.is_open()
            || self.leave.is_open()
            || self.confirm.is_open()
            || recover_dialog::undecided(files).is_some()
    }

    /// Closes the dialogs whose answers are in the document now, and returns what follows.
    pub(crate) fn poll(&mut self) -> Vec<Action> {
        self.group.poll();
        self.text.poll().into_iter().collect()
    }

    /// Shows the open dialogs and returns the actions of answers.
    pub(crate) fn show(
        &mut self,
        ctx: &Context,
        files: &OpenFiles,
        LayerContext {
            services, repaint, ..
        }: &LayerContext,
        canvas: Rect,
    ) -> Vec<Action> {
        let mut actions = Vec::new();
        actions.extend(self.prompt.show(ctx, services, repaint));
        actions.extend(self.picker.show(ctx).map(Action::Picked));
        actions.extend(self.losses.show(ctx));
        actions.extend(self.text.show(ctx));
        actions.extend(self.group.show(ctx));
        actions.extend(self.deletion.show(ctx));
        actions.extend(self.recent.show(ctx));
        actions.extend(self.leave.show(ctx, files));
        actions.extend(self.confirm.show(ctx));
        actions.extend(recover_dialog::show(ctx, files));
        self.notices.show(ctx, canvas);
        self.shortcuts.show(ctx);
        actions
    }
}
