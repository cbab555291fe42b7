//! The window that lists all keyboard shortcuts and mouse gestures.

use eframe::egui::{Align2, Context, Grid, ScrollArea, Ui, Vec2, Window};

use crate::command::{MENUS, shortcuts_of};
use crate::language::{shortcut_text, t};

/// Size at which all shortcuts show without scrolling, in points.
const SIZE: Vec2 = Vec2::new(860.0, 740.0);

/// Space of the title bar and edges around the content, in points.
const MARGIN: Vec2 = Vec2::new(32.0, 64.0);

/// Mouse gestures and modifiers.
const GESTURES: [&str; 5] = [
    "Wheel: zoom at the pointer. Middle or right button, or Space and the left button: pan.",
    "Shift while selecting adds to the selection; Ctrl or Alt removes from it.",
    "Shift while drawing or moving snaps to steps of 15°; Alt turns snapping off.",
    "Ctrl at the end of a drag detaches what is moved from the paths that stay.",
    "A selection box from right to left also selects the paths that it crosses, one from left to \
     right only what is inside.",
];

/// The window.
#[derive(Default)]
pub(crate) struct ShortcutsWindow {
    pub(crate) is_open: bool,
}

impl ShortcutsWindow {
    pub(super) fn show(&mut self, ctx: &Context) {
        if self.is_open {
            let window = Window::new(t("Keyboard shortcuts")).open(&mut self.is_open);
            let screen = ctx.content_rect().size() - MARGIN;
            let window = window.default_size(SIZE).constrain(true);
            let window = window.pivot(Align2::CENTER_CENTER);
            let window = window.default_pos(ctx.content_rect().center());
            window.max_size(screen).show(ctx, |ui| {
                ScrollArea::both().show(ui, content);
            });
        }
    }
}

fn content(ui: &mut Ui) {
    let commands = MENUS.iter().flat_map(|menu| menu.groups);
    let commands: Vec<_> = commands.flat_map(|group| group.iter()).collect();
    let (left, right) = commands.split_at(commands.len().div_ceil(2));
    let grid = Grid::new("shortcuts").num_columns(4).striped(true);
    grid.show(ui, |ui| {
        for (row, command) in left.iter().enumerate() {
            for command in [Some(command), right.get(row)].into_iter().flatten() {
                let keys = shortcuts_of(**command).map(|keys| shortcut_text(ui.ctx(), keys));
                ui.monospace(keys.collect::<Vec<_>>().join(", "));
                ui.label(command.label());
            }
            ui.end_row();
        }
    });
    ui.separator();
    for text in GESTURES {
        ui.label(t(text));
    }
}
