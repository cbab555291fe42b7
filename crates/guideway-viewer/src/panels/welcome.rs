//! The card on the empty canvas: open a file, a recent one, or the example site.

use std::path::{Path, PathBuf};

use eframe::egui::{Align2, Area, Button, Frame, Id, Order, Rect, RichText, Ui};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::backdrop::FloorPlanLayer;
use crate::command::{Command, shortcuts_of};
use crate::files::OpenFiles;
use crate::language::{shortcut_text, t};

/// Commands of the card.
const COMMANDS: [Command; 3] = [Command::NewLayout, Command::Open, Command::ExampleSite];
/// Width of the card, in points.
const WIDTH: f32 = 320.0;
/// Size of the name of the program, in points.
const TITLE_POINTS: f32 = 24.0;

/// The card, and the recent files as they were when it appeared.
#[derive(Default)]
pub(crate) struct Welcome {
    recent: Option<Vec<(PathBuf, bool)>>,
}

impl Welcome {
    /// Shows the card if nothing is open, and returns the action of a click.
    pub(crate) fn show(
        &mut self,
        ui: &Ui,
        canvas: Rect,
        files: &OpenFiles,
        floor_plan: &FloorPlanLayer,
    ) -> Vec<Action> {
        if !files.layers().is_empty() || !floor_plan.is_empty() {
            self.recent = None;
            return Vec::new();
        }
        // Looked up once: a file may be on a slow network share.
        let recent = self.recent.get_or_insert_with(|| files.recent().files());
        let area = Area::new(Id::unique("welcome")).order(Order::Middle);
        let area = area
            .pivot(Align2::CENTER_CENTER)
            .fixed_pos(canvas.center())
            .constrain_to(canvas);
        let card = area.show(ui.ctx(), |ui| {
            Frame::window(ui.style())
                .show(ui, |ui| content(ui, recent))
                .inner
        });
        card.inner.into_iter().collect()
    }
}

fn content(ui: &mut Ui, recent: &[(PathBuf, bool)]) -> Option<Action> {
    let mut action = None;
    ui.set_width(WIDTH);
    ui.label(RichText::new("Guideway").size(TITLE_POINTS).strong());
    ui.label(t("Path layouts of automated guided vehicles"));
    ui.add_space(8.0);
    for command in COMMANDS {
        let mut button = Button::new(command.label()).min_size([WIDTH, 0.0].into());
        if let Some(shortcut) = shortcuts_of(command).next() {
            button = button.shortcut_text(shortcut_text(ui.ctx(), shortcut));
        }
        if ui.add(button).clicked() {
            action = Some(Action::Command(command));
        }
    }
    let there = recent.iter().filter(|(_, is_there)| *is_there);
    for (number, (file, _)) in there.enumerate() {
        if number == 0 {
            ui.add_space(8.0);
            ui.label(RichText::new(t("Recent files")).strong());
        }
        let name = shown_path(Path::new(file.file_name().unwrap_or(file.as_os_str())));
        let button = ui.add(Button::new(name).frame(false).truncate());
        if button.on_hover_text(shown_path(file)).clicked() {
            action = Some(Action::Open(file.clone()));
        }
    }
    ui.add_space(8.0);
    ui.weak(t("Or drop a file on the window"));
    action
}
