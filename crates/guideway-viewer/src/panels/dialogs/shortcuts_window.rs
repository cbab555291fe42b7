//! The window that lists all keyboard shortcuts and mouse gestures.

use eframe::egui::{Align2, Color32, Context, Grid, ScrollArea, TextStyle, Ui, Vec2, Window};

use crate::command::{Command, MENUS, shortcuts_of};
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
                ScrollArea::both().show(ui, |ui| content(ui, screen.x.min(SIZE.x)));
            });
        }
    }
}

/// Shows all shortcuts in two lists, or in one where two would be wider than `width`.
fn content(ui: &mut Ui, width: f32) {
    let commands = MENUS.iter().flat_map(|menu| menu.groups);
    let commands = commands.flat_map(|group| group.iter());
    let commands: Vec<_> = commands.map(|command| texts(ui, *command)).collect();
    let lists = commands.split_at(commands.len().div_ceil(2));
    let spacing = ui.spacing().item_spacing.x;
    let in_two = list_width(ui, lists.0) + list_width(ui, lists.1) + 3.0 * spacing <= width;
    let (left, right) = match in_two {
        true => lists,
        false => (&commands[..], &[][..]),
    };
    let grid = Grid::new(("shortcuts", in_two)).striped(true);
    grid.show(ui, |ui| {
        for (row, command) in left.iter().enumerate() {
            for (keys, label) in [Some(command), right.get(row)].into_iter().flatten() {
                ui.monospace(keys);
                ui.label(*label);
            }
            ui.end_row();
        }
    });
    ui.set_max_width(width);
    ui.separator();
    for text in GESTURES {
        ui.label(t(text));
    }
}

/// The keys and the name of a command.
fn texts(ui: &Ui, command: Command) -> (String, &'static str) {
    let keys = shortcuts_of(command).map(|keys| shortcut_text(ui.ctx(), keys));
    (keys.collect::<Vec<_>>().join(", "), command.label())
}

/// Width of a list of keys and names.
fn list_width(ui: &Ui, list: &[(String, &str)]) -> f32 {
    let width = |text: &str, style: TextStyle| {
        let (font, painter) = (style.resolve(ui.style()), ui.painter());
        let text = painter.layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
        text.size().x
    };
    let keys = list
        .iter()
        .map(|(keys, _)| width(keys, TextStyle::Monospace));
    let names = list.iter().map(|(_, name)| width(name, TextStyle::Body));
    keys.fold(0.0, f32::max) + ui.spacing().item_spacing.x + names.fold(0.0, f32::max)
}
