//! The menu bar, the toolbar beside it, and the progress of loads and exports.

use std::time::Duration;

use eframe::egui::{self, Button, ProgressBar, Ui};

use super::command_state::CommandState;
use super::still_part::StillPart;
use super::toolbar;
use crate::action::Action;
use crate::command::{Command, MENUS, Menu, shortcuts_of};
use crate::files::FileWriter;
use crate::language::{Language, language, shortcut_text, t};
use crate::services::Job;

/// Interval of progress updates. On a software renderer a frame takes a tenth of a second of the
/// processor, which the load itself needs.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(500);

/// The content of the menu bar.
pub(crate) struct MenuBar<'a> {
    pub(crate) commands: CommandState<'a>,
    pub(crate) writer: &'a FileWriter,
}

/// All that the bar shows while no menu is open and no job has progress.
#[derive(PartialEq)]
pub(crate) struct MenuKey {
    language: Language,
    toolbar: Vec<(bool, bool)>,
}

impl MenuBar<'_> {
    /// Shows the bar and returns the actions of clicks.
    pub(crate) fn show(&self, ui: &mut Ui, still: &mut StillPart<MenuKey>) -> Vec<Action> {
        let mut actions = Vec::new();
        let layers = self.commands.files.layers();
        let has_job = layers.iter().any(|layer| layer.load_job().is_some());
        if has_job || self.writer.job().is_some() {
            self.lay_out(ui, &mut actions);
            return actions;
        }
        let key = MenuKey {
            language: language(),
            toolbar: toolbar::state(&self.commands),
        };
        still.show(ui, key, |ui| self.lay_out(ui, &mut actions));
        actions
    }

    fn lay_out(&self, ui: &mut Ui, actions: &mut Vec<Action>) {
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in &MENUS {
                ui.menu_button(t(menu.name), |ui| actions.extend(self.menu(menu, ui)));
            }
            ui.separator();
            actions.extend(toolbar::show(ui, &self.commands));
            for layer in self.commands.files.layers() {
                if let Some(job) = layer.load_job() {
                    let verb = match layer.is_recovering() {
                        true => t("recovering"),
                        false => t("loading"),
                    };
                    progress(ui, format!("{verb} {}", layer.name()), job);
                }
            }
            if let Some(job) = self.writer.job() {
                progress(ui, t("writing PNG").to_owned(), job);
            }
        });
    }

    fn menu(&self, menu: &Menu, ui: &mut Ui) -> Option<Action> {
        command_list(ui, menu.groups, &self.commands)
    }
}

/// Shows commands as entries of a menu, with lines between the groups. Returns the chosen one.
pub(crate) fn command_list(
    ui: &mut Ui,
    groups: &[&[Command]],
    state: &CommandState<'_>,
) -> Option<Action> {
    command_entries(ui, groups, |command| {
        let (is_on, is_possible) = (state.is_on(command), state.is_possible(command));
        (state.label(command), is_on, is_possible)
    })
}

/// As [`command_list`]; `state` has the text of a command, its tick, and whether it can run.
pub(super) fn command_entries(
    ui: &mut Ui,
    groups: &[&[Command]],
    state: impl Fn(Command) -> (String, bool, bool),
) -> Option<Action> {
    let mut chosen = None;
    for (number, group) in groups.iter().enumerate() {
        if number > 0 {
            ui.separator();
        }
        for &command in *group {
            let (label, is_on, is_possible) = state(command);
            let mut button = Button::new(label).selected(is_on);
            if let Some(shortcut) = shortcuts_of(command).next() {
                button = button.shortcut_text(shortcut_text(ui.ctx(), shortcut));
            }
            if ui.add_enabled(is_possible, button).clicked() {
                chosen = Some(Action::Command(command));
                ui.close();
            }
        }
    }
    chosen
}

/// A progress bar with a button that cancels the job.
fn progress(ui: &mut Ui, text: String, job: &Job) {
    ui.separator();
    ui.label(text);
    let bar = ProgressBar::new(job.fraction().unwrap_or(0.0));
    ui.add(bar.desired_width(120.0));
    ui.ctx().request_repaint_after(PROGRESS_INTERVAL);
    if ui.button(t("Cancel")).clicked() {
        job.cancel();
    }
}
