//! The menu bar, the tool buttons, and the progress of loads and exports.

use std::time::Duration;

use eframe::egui::{self, Button, Context, ProgressBar, Ui};

use crate::action::Action;
use crate::command::{Command, ENTRIES, MENUS};
use crate::files::{FileWriter, OpenFiles};
use crate::services::Job;
use crate::tools::Tool;

/// Interval of progress updates. On a software renderer a frame takes a tenth of a second of the
/// processor, which the load itself needs.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(500);

/// The commands whose shortcuts are pressed. While a text field has the focus, these are shortcuts
/// with Ctrl that the field does not use itself, and Cancel.
pub(crate) fn pressed_commands(ctx: &Context) -> Vec<Command> {
    let is_typing = ctx.text_edit_focused();
    let is_active = |command: Command, has_ctrl: bool| {
        !is_typing || command == Command::Cancel || (has_ctrl && !is_text_command(command))
    };
    let pressed = ENTRIES.iter().filter(|entry| {
        is_active(entry.command, entry.shortcut.modifiers.command)
            && ctx.input_mut(|input| input.consume_shortcut(&entry.shortcut))
    });
    pressed.map(|entry| entry.command).collect()
}

/// Returns `true` if a text field handles the shortcut itself.
fn is_text_command(command: Command) -> bool {
    matches!(
        command,
        Command::Undo | Command::Redo | Command::SelectAll | Command::CopyPicture
    )
}

/// The content of the menu bar.
pub(crate) struct MenuBar<'a> {
    pub(crate) files: &'a OpenFiles,
    pub(crate) writer: &'a FileWriter,
    pub(crate) tool: Tool,
}

impl MenuBar<'_> {
    /// Shows the bar and returns the actions of clicks.
    pub(crate) fn show(&self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in MENUS {
                ui.menu_button(menu, |ui| actions.extend(self.menu(menu, ui)));
            }
            ui.separator();
            for (tool, name) in [
                (Tool::Select, "Select"),
                (Tool::Points, "Points"),
                (Tool::Draw, "Draw"),
                (Tool::Measure, "Measure"),
            ] {
                if ui.selectable_label(self.tool == tool, name).clicked() {
                    actions.push(Action::SelectTool(tool));
                }
            }
            for layer in self.files.layers() {
                if let Some(job) = layer.load_job() {
                    let verb = match layer.is_recovering() {
                        true => "recovering",
                        false => "loading",
                    };
                    progress(ui, format!("{verb} {}", layer.name()), job);
                }
            }
            if let Some(job) = self.writer.job() {
                progress(ui, "writing PNG".to_owned(), job);
            }
        });
        actions
    }

    fn menu(&self, menu: &str, ui: &mut Ui) -> Option<Action> {
        let document = self.files.document();
        let steps = document.map_or((None, None), |document| document.undo_redo_names());
        let mut action = None;
        let mut listed = Vec::new();
        for entry in ENTRIES.iter().filter(|entry| entry.menu == menu) {
            // A command with two shortcuts is listed once.
            if listed.contains(&entry.command) {
                continue;
            }
            listed.push(entry.command);
            let label = match (entry.command, steps) {
                (Command::Undo, (Some(step), _)) => format!("Undo: {step}"),
                (Command::Redo, (_, Some(step))) => format!("Redo: {step}"),
                _ => entry.label.to_owned(),
            };
            let shortcut = ui.ctx().format_shortcut(&entry.shortcut);
            if ui.add(Button::new(label).shortcut_text(shortcut)).clicked() {
                action = Some(Action::Command(entry.command));
            }
        }
        action
    }
}

/// A progress bar with a button that cancels the job.
fn progress(ui: &mut Ui, text: String, job: &Job) {
    ui.separator();
    ui.label(text);
    let bar = ProgressBar::new(job.fraction().unwrap_or(0.0));
    ui.add(bar.desired_width(120.0));
    ui.ctx().request_repaint_after(PROGRESS_INTERVAL);
    if ui.button("Cancel").clicked() {
        job.cancel();
    }
}
