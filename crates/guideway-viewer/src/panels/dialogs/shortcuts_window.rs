//! The window that lists all keyboard shortcuts and mouse gestures.

use eframe::egui::{Context, Grid, ScrollArea, Ui, Window};

use crate::command::ENTRIES;

/// Height at which all shortcuts show without scrolling, in points.
const HEIGHT: f32 = 740.0;

/// Mouse gestures and modifiers.
const GESTURES: [&str; 4] = [
    "Wheel: zoom at the pointer. Middle or right button, or Space and the left button: pan.",
    "Shift while selecting adds to the selection; Ctrl or Alt removes from it.",
    "Shift while drawing or moving snaps to steps of 15°; Alt turns snapping off.",
    "A selection box from right to left selects the paths that it crosses, one from left to right \
     only the paths inside.",
];

/// The window.
#[derive(Default)]
pub(crate) struct ShortcutsWindow {
    pub(crate) is_open: bool,
}

impl ShortcutsWindow {
    pub(super) fn show(&mut self, ctx: &Context) {
        if self.is_open {
            let window = Window::new("Keyboard shortcuts").open(&mut self.is_open);
            window.default_height(HEIGHT).show(ctx, |ui| {
                ScrollArea::vertical().show(ui, content);
            });
        }
    }
}

fn content(ui: &mut Ui) {
    let (left, right) = ENTRIES.split_at(ENTRIES.len().div_ceil(2));
    let grid = Grid::new("shortcuts").num_columns(4).striped(true);
    grid.show(ui, |ui| {
        for (row, entry) in left.iter().enumerate() {
            for entry in [Some(entry), right.get(row)].into_iter().flatten() {
                ui.monospace(ui.ctx().format_shortcut(&entry.shortcut));
                ui.label(entry.label);
            }
            ui.end_row();
        }
    });
    ui.separator();
    for text in GESTURES {
        ui.label(text);
    }
}
