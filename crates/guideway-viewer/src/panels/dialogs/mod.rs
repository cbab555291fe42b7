//! Dialogs over the window: prompts, questions, notices, help.

mod notices;
mod prompt;
mod quit_dialog;
mod recent_dialog;
mod recover_dialog;
mod shortcuts_window;

use eframe::egui::Context;

pub(crate) use notices::Notices;
pub(crate) use prompt::{Prompt, PromptKind};
pub(crate) use quit_dialog::QuitDialog;
pub(crate) use recent_dialog::RecentDialog;
pub(crate) use shortcuts_window::ShortcutsWindow;

use crate::action::Action;
use crate::files::OpenFiles;

/// All dialogs; most are closed at any time.
#[derive(Default)]
pub(crate) struct Dialogs {
    pub(crate) prompt: Prompt,
    pub(crate) recent: RecentDialog,
    pub(crate) quit: QuitDialog,
    pub(crate) notices: Notices,
    pub(crate) shortcuts: ShortcutsWindow,
}

impl Dialogs {
    /// Closes all dialogs except the question about unsaved work.
    pub(crate) fn close_all(&mut self) {
        self.prompt.close();
        self.recent.close();
        self.quit.close();
        self.notices.clear();
        self.shortcuts.is_open = false;
    }

    /// Shows the open dialogs and returns the actions of answers.
    pub(crate) fn show(&mut self, ctx: &Context, files: &OpenFiles) -> Vec<Action> {
        let mut actions = Vec::new();
        actions.extend(self.prompt.show(ctx));
        actions.extend(self.recent.show(ctx));
        actions.extend(self.quit.show(ctx, files));
        actions.extend(recover_dialog::show(ctx, files));
        self.notices.show(ctx);
        self.shortcuts.show(ctx);
        actions
    }
}
