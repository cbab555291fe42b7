//! The menu bar, the tool buttons, and the progress of loads and exports.

use std::time::Duration;

use eframe::egui::{self, Button, ProgressBar, Ui};

use super::bottom_panel::BottomView;
use crate::action::Action;
use crate::command::{Command, MENUS, Menu, shortcuts_of};
use crate::display_settings::DisplaySettings;
use crate::files::{FileWriter, OpenFiles};
use crate::services::Job;
use crate::tools::Tool;

/// Interval of progress updates. On a software renderer a frame takes a tenth of a second of the
/// processor, which the load itself needs.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(500);

/// The content of the menu bar.
pub(crate) struct MenuBar<'a> {
    pub(crate) files: &'a OpenFiles,
    pub(crate) writer: &'a FileWriter,
    pub(crate) settings: &'a DisplaySettings,
    /// True if swept areas are shown.
    pub(crate) has_swept_areas: bool,
    /// True if the side panel is shown.
    pub(crate) has_side_panel: bool,
    /// The view of the bottom panel that is open.
    pub(crate) bottom: Option<BottomView>,
    pub(crate) tool: Tool,
}

impl MenuBar<'_> {
    /// Shows the bar and returns the actions of clicks.
    pub(crate) fn show(&self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        egui::MenuBar::new().ui(ui, |ui| {
            for menu in &MENUS {
                ui.menu_button(menu.name, |ui| actions.extend(self.menu(menu, ui)));
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

    fn menu(&self, menu: &Menu, ui: &mut Ui) -> Option<Action> {
        let mut chosen = None;
        for (number, group) in menu.groups.iter().enumerate() {
            if number > 0 {
                ui.separator();
            }
            for &command in *group {
                let mut button = Button::new(self.label(command)).selected(self.is_on(command));
                if let Some(shortcut) = shortcuts_of(command).next() {
                    button = button.shortcut_text(ui.ctx().format_shortcut(shortcut));
                }
                if ui.add_enabled(self.is_possible(command), button).clicked() {
                    chosen = Some(Action::Command(command));
                }
            }
        }
        chosen
    }

    /// The text of a command; undo and redo name their step.
    fn label(&self, command: Command) -> String {
        let document = self.files.document();
        let (undo, redo) = document.map_or((None, None), |document| document.undo_redo_names());
        let step = match command {
            Command::Undo => undo,
            Command::Redo => redo,
            _ => None,
        };
        let label = command.label();
        step.map_or_else(|| label.to_owned(), |step| format!("{label}: {step}"))
    }

    /// Returns `true` if a command has something to act on.
    fn is_possible(&self, command: Command) -> bool {
        let Some(layer) = self.files.active() else {
            return !needs_file(command);
        };
        // While an edit has the document, what comes after it is not known.
        let Some(document) = layer.document() else {
            return true;
        };
        let (undo, redo) = document.undo_redo_names();
        match command {
            Command::Undo => undo.is_some(),
            Command::Redo => redo.is_some(),
            Command::ShowAll => document.scene().hidden_count() > 0,
            Command::NextFile => self.files.layers().len() > 1,
            Command::FinishPath => self.tool == Tool::Draw,
            command if needs_selection(command) => !document.selection().is_empty(),
            _ => true,
        }
    }

    /// Returns `true` if a command is a switch that is on.
    fn is_on(&self, command: Command) -> bool {
        match command {
            Command::Arrows => self.settings.has_arrows,
            Command::Symbols => self.settings.has_symbols,
            Command::Labels => self.settings.has_labels,
            Command::Grid => self.settings.has_grid,
            Command::Density => self.settings.is_density,
            Command::ThesisRule => self.settings.is_thesis_rule,
            Command::Dark => self.settings.is_dark,
            Command::SweptAreas => self.has_swept_areas,
            Command::SidePanel => self.has_side_panel,
            Command::Table => self.bottom == Some(BottomView::Table),
            Command::Route => self.bottom == Some(BottomView::Route),
            Command::Compare => self.bottom == Some(BottomView::Compare),
            Command::ToolSelect => self.tool == Tool::Select,
            Command::ToolPoints => self.tool == Tool::Points,
            Command::ToolDraw => self.tool == Tool::Draw,
            Command::ToolMeasure => self.tool == Tool::Measure,
            _ => false,
        }
    }
}

fn needs_selection(command: Command) -> bool {
    matches!(
        command,
        Command::Deselect
            | Command::Delete
            | Command::Duplicate
            | Command::RotateLeft
            | Command::FlipHorizontal
            | Command::FlipVertical
            | Command::Refine
            | Command::ZoomToSelection
            | Command::Hide
            | Command::Isolate
    )
}

fn needs_file(command: Command) -> bool {
    needs_selection(command)
        || matches!(
            command,
            Command::Reload
                | Command::Save
                | Command::SaveAs
                | Command::ExportPng
                | Command::ExportSvg
                | Command::CopyPicture
                | Command::Close
                | Command::Undo
                | Command::Redo
                | Command::SelectAll
                | Command::Find
                | Command::NextFile
                | Command::ShowAll
                | Command::FinishPath
        )
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
