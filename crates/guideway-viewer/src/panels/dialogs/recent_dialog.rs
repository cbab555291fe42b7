//! The list of recent files: a click or a digit key opens one.

use std::path::{Path, PathBuf};

use eframe::egui::{Button, Context, Id, Key, Modal};
use guideway_layout::shown_path;

use crate::action::Action;
use crate::language::{say, t};

/// The keys of the entries, in order.
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

/// The dialog; open while it has a list.
#[derive(Default)]
pub(crate) struct RecentDialog {
    /// The files, and whether each exists.
    files: Option<Vec<(PathBuf, bool)>>,
}

impl RecentDialog {
    /// Opens the dialog with these files and whether each exists.
    pub(crate) fn open(&mut self, files: Vec<(PathBuf, bool)>) {
        self.files = Some(files);
    }

    pub(crate) fn is_open(&self) -> bool {
        self.files.is_some()
    }

    pub(super) fn close(&mut self) {
        self.files = None;
    }

    pub(super) fn show(&mut self, ctx: &Context) -> Option<Action> {
        let files = self.files.as_ref()?;
        let mut chosen = None;
        let modal = Modal::new(Id::unique("recent")).show(ctx, |ui| {
            ui.label(match files.is_empty() {
                true => t("No recent files"),
                false => t("Open recent file"),
            });
            for ((file, exists), digit) in files.iter().zip(DIGITS) {
                let name = shown_path(Path::new(file.file_name().unwrap_or(file.as_os_str())));
                let label = format!("{}  {name}", digit.symbol_or_name());
                let path = shown_path(file);
                let button = ui.add_enabled(*exists, Button::new(label));
                let is_chosen = button.clicked() || ui.input(|input| input.key_pressed(digit));
                button
                    .on_hover_text(&path)
                    .on_disabled_hover_text(say!("{path} does not exist", path));
                if is_chosen && *exists {
                    chosen = Some(file.clone());
                }
            }
            ui.button(t("Cancel")).clicked()
        });
        if modal.inner || modal.should_close() || chosen.is_some() {
            self.files = None;
        }
        chosen.map(Action::Open)
    }
}
