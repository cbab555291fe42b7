use std::time::Duration;

use eframe::egui::{Button, Label, MenuBar, ProgressBar, Ui};

use crate::app::command::{Command, ENTRIES, MENUS};
use crate::app::{App, Tool};
use crate::services::Job;

impl App {
    /// Does what the pressed keys ask for. While text is being written, only those with Ctrl held count, and those
    /// that end the writing.
    pub(super) fn keys(&mut self, ui: &Ui) {
        let ctx = ui.ctx();
        let is_writing = ctx.text_edit_focused();
        let pressed: Vec<Command> = ENTRIES
            .iter()
            .filter(|entry| {
                let ends_writing = entry.command == Command::Stop;
                let may = !is_writing
                    || ends_writing
                    || (entry.shortcut.modifiers.command && !is_of_text(entry.command));
                may && ctx.input_mut(|input| input.consume_shortcut(&entry.shortcut))
            })
            .map(|entry| entry.command)
            .collect();
        for command in pressed {
            self.perform(command, ctx);
        }
    }

    pub(super) fn menus(&mut self, ui: &mut Ui) {
        MenuBar::new().ui(ui, |ui| {
            for menu in MENUS {
                ui.menu_button(menu, |ui| self.menu(menu, ui));
            }
            ui.separator();
            for (tool, name) in [
                (Tool::Select, "Select"),
                (Tool::Points, "Points"),
                (Tool::Draw, "Draw"),
                (Tool::Measure, "Measure"),
            ] {
                if ui.selectable_label(self.tool == tool, name).clicked() {
                    self.set_tool(tool);
                }
            }
            for layer in &self.layers {
                if let Some(load) = layer.load() {
                    let what = match layer.is_recovering() {
                        true => "doing again the work on",
                        false => "reading",
                    };
                    progress(ui, format!("{what} {}", layer.name()), load);
                }
            }
            if let Some(job) = self.writing() {
                progress(ui, "writing a picture".to_owned(), job);
            }
        });
    }

    fn menu(&mut self, menu: &str, ui: &mut Ui) {
        let steps = self
            .document()
            .map_or((None, None), |document| document.undo_redo_names());
        let mut seen = Vec::new();
        for entry in ENTRIES.iter().filter(|entry| entry.menu == menu) {
            // A command with two keys is listed once.
            if seen.contains(&entry.command) {
                continue;
            }
            seen.push(entry.command);
            let label = match (entry.command, steps) {
                (Command::Undo, (Some(step), _)) => format!("Undo: {step}"),
                (Command::Redo, (_, Some(step))) => format!("Redo: {step}"),
                _ => entry.label.to_owned(),
            };
            let keys = ui.ctx().format_shortcut(&entry.shortcut);
            if ui.add(Button::new(label).shortcut_text(keys)).clicked() {
                let ctx = ui.ctx().clone();
                self.perform(entry.command, &ctx);
            }
        }
    }

    pub(super) fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let (Some(view), Some(at)) = (self.camera.view(), self.pointer_px) {
                let at = view.world_from_pixel(at);
                ui.monospace(format!("{:.3} m, {:.3} m", at.x, at.y));
                ui.separator();
                ui.monospace(format!("{:.4} px/m", view.px_per_m()));
                ui.separator();
            }
            ui.label(self.tool_hint());
            ui.separator();
            let layer = self.layers.get(self.active);
            if let Some(shown) = layer.and_then(|layer| layer.shown.as_ref()) {
                ui.monospace(format!(
                    "{} {:.1} ms",
                    shown.report.method,
                    shown.report.frame_ms()
                ));
                ui.separator();
            }
            let over = layer.and_then(|layer| layer.overlay.last());
            if self.look.has_marks() && over.is_some_and(|made| made.marks.left_out) {
                ui.label("zoom in for all marks");
                ui.separator();
            }
            if let (Some(hit), Some(document)) = (self.hovered(), self.document()) {
                let id = document.layout().paths.id(hit.path as usize);
                ui.add(Label::new(id).truncate());
            }
        });
    }

    fn tool_hint(&self) -> &'static str {
        match self.tool {
            Tool::Select => "click or drag a box; drag the selection to move it",
            Tool::Points => {
                "drag nodes and control points; Insert and Backspace add and remove one"
            }
            Tool::Draw => "click point by point; Enter or a double click ends",
            Tool::Measure => "click point by point; a double click begins anew",
        }
    }
}

/// How far something is, and a button that stops it.
fn progress(ui: &mut Ui, what: String, job: &Job) {
    ui.separator();
    ui.label(what);
    let bar = ProgressBar::new(job.fraction().unwrap_or(0.0));
    ui.add(bar.desired_width(120.0));
    // Nothing else wakes the window for each step. To a graphics driver in software each frame is a tenth of a second of
    // the processor, which what is waited for could do with.
    ui.ctx().request_repaint_after(Duration::from_millis(500));
    if ui.button("Cancel").clicked() {
        job.cancel();
    }
}

/// Whether a field of text does this itself.
fn is_of_text(command: Command) -> bool {
    matches!(
        command,
        Command::Undo | Command::Redo | Command::SelectAll | Command::CopyPicture
    )
}
