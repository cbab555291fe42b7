use eframe::egui::{
    Align2, Button, Context, DragValue, Grid, Id, Key, Modal, ScrollArea, TextEdit, Ui, Vec2,
    ViewportCommand, Window,
};

use crate::app::command::ENTRIES;
use crate::app::{App, Layer, PromptKind};

/// All of them, on a window that is not very small.
const KEYS_HEIGHT: f32 = 740.0;

impl App {
    /// What lies over everything else: questions, notices, help.
    pub(super) fn dialogs(&mut self, ctx: &Context) {
        self.ask_prompt(ctx);
        self.ask_which_recent(ctx);
        self.ask_to_quit(ctx);
        self.ask_to_recover(ctx);
        self.show_notices(ctx);
        if self.shows_keys {
            let mut is_open = true;
            let window = Window::new("Keys").open(&mut is_open);
            window.default_height(KEYS_HEIGHT).show(ctx, |ui| {
                ScrollArea::vertical().show(ui, keys);
            });
            self.shows_keys = is_open;
        }
    }

    fn ask_prompt(&mut self, ctx: &Context) {
        let Some(mut prompt) = self.prompt.take() else {
            return;
        };
        let mut is_answered = false;
        let mut is_over = false;
        let modal = Modal::new(Id::unique("prompt")).show(ctx, |ui| {
            let title = match prompt.kind {
                PromptKind::Open => "Open which file?",
                PromptKind::SaveAs => "Save as which file? Its ending says the format.",
                PromptKind::Picture => "Write the picture to which PNG file?",
                PromptKind::Drawing => "Write the drawing to which SVG file?",
                PromptKind::FloorPlan => {
                    "What lies below? An image with its scale, such as hall.png@px-per-m=20,offset=-3,-2,rotate=90, or \
                     any layout or drawing; nothing takes it away."
                }
            };
            let title = ui.label(title);
            let field = TextEdit::singleline(&mut prompt.text).desired_width(480.0);
            let field = ui.add(field).labelled_by(title.id);
            if std::mem::take(&mut prompt.is_new) {
                field.request_focus();
            }
            if prompt.kind == PromptKind::Picture {
                ui.horizontal(|ui| {
                    ui.label("Width");
                    ui.add(
                        DragValue::new(&mut prompt.width_px)
                            .range(1..=65_535)
                            .suffix(" px"),
                    );
                });
            }
            ui.horizontal(|ui| {
                let enters = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                is_answered = ui.button("OK").clicked() || enters;
                is_over = ui.button("Cancel").clicked();
            });
        });
        if is_answered {
            self.answer(&prompt);
        } else if !is_over && !modal.should_close() {
            self.prompt = Some(prompt);
        }
    }

    /// Files that were open lately: a click or the digit before its name opens one.
    fn ask_which_recent(&mut self, ctx: &Context) {
        const DIGITS: [Key; 10] = [
            Key::Num1,
            Key::Num2,
            Key::Num3,
            Key::Num4,
            Key::Num5,
            Key::Num6,
            Key::Num7,
            Key::Num8,
            Key::Num9,
            Key::Num0,
        ];
        let Some(files) = &self.choosing else {
            return;
        };
        let mut chosen = None;
        let modal = Modal::new(Id::unique("recent")).show(ctx, |ui| {
            ui.label(match files.is_empty() {
                true => "No file was open lately.",
                false => "Open which file again?",
            });
            for ((file, is_there), digit) in files.iter().zip(DIGITS) {
                let name = file.file_name().unwrap_or(file.as_os_str());
                let label = format!("{}  {}", digit.symbol_or_name(), name.to_string_lossy());
                let place = file.display().to_string();
                let button = ui.add_enabled(*is_there, Button::new(label));
                let is_meant = button.clicked() || ui.input(|input| input.key_pressed(digit));
                button
                    .on_hover_text(&place)
                    .on_disabled_hover_text(format!("{place} is not there any more"));
                if is_meant && *is_there {
                    chosen = Some(file.clone());
                }
            }
            ui.button("Cancel").clicked()
        });
        if modal.inner || modal.should_close() || chosen.is_some() {
            self.choosing = None;
        }
        if let Some(file) = chosen {
            self.open(file);
        }
    }

    fn ask_to_quit(&mut self, ctx: &Context) {
        let is_closing = ctx.input(|input| input.viewport().close_requested());
        if is_closing && self.is_unsaved() && !self.quits_anyway {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.asks_to_quit = true;
        }
        if !self.asks_to_quit {
            return;
        }
        if !self.is_unsaved() {
            // What was still being saved is saved.
            self.asks_to_quit = false;
            return ctx.send_viewport_cmd(ViewportCommand::Close);
        }
        Modal::new(Id::unique("quit")).show(ctx, |ui| {
            ui.label("There are changes that are not saved:");
            for layer in self.layers.iter().filter(|layer| layer.is_changed()) {
                ui.label(layer.path.display().to_string());
            }
            ui.horizontal(|ui| {
                if ui.button("Quit without saving").clicked() {
                    self.quits_anyway = true;
                    ctx.send_viewport_cmd(ViewportCommand::Close);
                }
                if ui.button("Stay").clicked() {
                    self.asks_to_quit = false;
                }
            });
        });
    }

    fn ask_to_recover(&mut self, ctx: &Context) {
        let is_undecided = |layer: &Layer| layer.has_found_work() && !layer.is_recovering();
        let Some(index) = self.layers.iter().position(is_undecided) else {
            return;
        };
        let name = self.layers[index].name();
        let (mut takes, mut drops) = (false, false);
        Modal::new(Id::unique("recover")).show(ctx, |ui| {
            ui.label(format!(
                "Work on {name} was not saved when the viewer last ended."
            ));
            ui.horizontal(|ui| {
                takes = ui.button("Do it again").clicked();
                drops = ui.button("Forget it").clicked();
            });
        });
        if takes {
            let options = self.look.scene_options();
            self.layers[index].recover(&self.services, options, &self.wake);
        } else if drops {
            self.layers[index].drop_journal();
        }
    }

    fn show_notices(&mut self, ctx: &Context) {
        if self.notices.is_empty() {
            return;
        }
        let mut is_read = false;
        Window::new("Notices")
            .title_bar(false)
            .resizable(false)
            .anchor(Align2::LEFT_BOTTOM, Vec2::new(12.0, -64.0))
            .show(ctx, |ui| {
                ui.set_max_width(520.0);
                for notice in &self.notices {
                    ui.label(notice);
                }
                is_read = ui.button("Dismiss").clicked();
            });
        if is_read {
            self.notices.clear();
        }
    }
}

fn keys(ui: &mut Ui) {
    let (left, right) = ENTRIES.split_at(ENTRIES.len().div_ceil(2));
    Grid::new("keys")
        .num_columns(4)
        .striped(true)
        .show(ui, |ui| {
            for (row, entry) in left.iter().enumerate() {
                for entry in [Some(entry), right.get(row)].into_iter().flatten() {
                    ui.monospace(ui.ctx().format_shortcut(&entry.shortcut));
                    ui.label(entry.label);
                }
                ui.end_row();
            }
        });
    ui.separator();
    ui.label("Wheel: zoom at the pointer. Middle or right button, or Space and the left one: move the view.");
    ui.label("Shift while selecting adds, Ctrl or Alt takes away.");
    ui.label("Shift while drawing or moving keeps to steps of 15°; Alt turns snapping off.");
    ui.label(
        "A box drawn from the right takes what it meets, one from the left what is inside of it.",
    );
}
