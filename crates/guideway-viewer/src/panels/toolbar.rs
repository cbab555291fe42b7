//! The toolbar: commands as icons, each with its name and shortcut as a tooltip.

use eframe::egui::{Id, Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo};

use super::command_state::CommandState;
use super::icons::{self, Icon};
use crate::action::Action;
use crate::command::{Command, shortcuts_of};
use crate::language::shortcut_text;

/// The commands of the toolbar, in groups.
const GROUPS: &[&[Command]] = &[
    &[Command::NewLayout, Command::Open, Command::Save],
    &[Command::Undo, Command::Redo],
    &[
        Command::ToolSelect,
        Command::ToolPoints,
        Command::ToolLine,
        Command::ToolArc,
        Command::ToolCurve,
        Command::ToolBezier,
        Command::ToolNode,
        Command::ToolStation,
        Command::ToolMeasure,
    ],
    &[
        Command::ZoomToAll,
        Command::ZoomIn,
        Command::ZoomOut,
        Command::Find,
    ],
];
/// Side of a button and of its icon, in points.
const BUTTON: f32 = 20.0;
const ICON: f32 = 15.0;
/// Space between buttons, and between groups with their line, in points.
const GAP: f32 = 2.0;
const GROUP_GAP: f32 = 10.0;

/// All that the buttons show: for each whether it is possible, and whether it is on.
pub(super) fn state(state: &CommandState<'_>) -> Vec<(bool, bool)> {
    let commands = GROUPS.iter().flat_map(|group| group.iter());
    commands
        .map(|&command| (state.is_possible(command), state.is_on(command)))
        .collect()
}

/// Shows the toolbar in a row and returns the actions of clicks.
///
/// The buttons have fixed places in one part of the window: to place each as a widget would take
/// longer than all else about it.
pub(crate) fn show(ui: &mut Ui, state: &CommandState<'_>) -> Vec<Action> {
    let count = GROUPS.iter().map(|group| group.len()).sum::<usize>();
    let gaps = GROUPS.len().saturating_sub(1);
    let width = count as f32 * (BUTTON + GAP) + gaps as f32 * GROUP_GAP;
    let (row, _) = ui.allocate_exact_size(Vec2::new(width, BUTTON), Sense::hover());
    let (mut actions, mut icons) = (Vec::new(), Vec::with_capacity(count));
    let mut corner = row.min;
    for (number, group) in GROUPS.iter().enumerate() {
        if number > 0 {
            let line = ui.visuals().widgets.noninteractive.bg_stroke;
            let x = corner.x + 0.5 * (GROUP_GAP - GAP);
            ui.painter().vline(x, row.y_range(), line);
            corner.x += GROUP_GAP;
        }
        for &command in *group {
            let rect = Rect::from_min_size(corner, Vec2::splat(BUTTON));
            let (response, icon) = button(ui, command, rect, state);
            icons.push(icon);
            if response.clicked() {
                actions.push(Action::Command(command));
            }
            corner.x += BUTTON + GAP;
        }
    }
    icons::paint(ui, Id::unique("toolbar"), icons);
    actions
}

/// Shows a button without its icon, which is returned.
fn button(ui: &Ui, command: Command, rect: Rect, state: &CommandState<'_>) -> (Response, Icon) {
    let is_possible = state.is_possible(command);
    let sense = if is_possible {
        Sense::click()
    } else {
        Sense::hover()
    };
    let response = ui.interact(rect, Id::unique("toolbar").with(command as u8), sense);
    let is_on = state.is_on(command);
    response.widget_info(|| WidgetInfo::selected(Role::Button, is_possible, is_on, command.name()));
    let (color, radius, fill) = {
        let visuals = match is_possible {
            true => ui.style().interact_selectable(&response, is_on),
            false => ui.visuals().widgets.inactive,
        };
        let color = visuals.fg_stroke.color;
        (color, visuals.corner_radius, visuals.weak_bg_fill)
    };
    if is_on || is_possible && (response.hovered() || response.has_focus()) {
        ui.painter().rect_filled(rect, radius, fill);
    }
    let icon = Icon {
        command,
        square: Rect::from_center_size(rect.center(), Vec2::splat(ICON)),
        color: if is_possible {
            color
        } else {
            ui.visuals().disable(color)
        },
    };
    if !response.contains_pointer() && !response.has_focus() {
        return (response, icon);
    }
    let keys = shortcuts_of(command).next();
    let keys = keys.map(|keys| format!(" ({})", shortcut_text(ui.ctx(), keys)));
    let text = state.label(command) + &keys.unwrap_or_default();
    (response.on_hover_text(text), icon)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icons_of_the_toolbar_differ_and_stay_in_their_square() {
        let commands: Vec<Command> = GROUPS
            .iter()
            .flat_map(|group| group.iter().copied())
            .collect();
        for (index, &command) in commands.iter().enumerate() {
            let icon = icons::lines(command).unwrap_or_else(|| panic!("{}", command.label()));
            let points = icon.iter().flat_map(|line| line.iter().flatten());
            assert!(
                points
                    .clone()
                    .all(|side| (0.0..=icons::SIDE).contains(side))
            );
            for &other in &commands[..index] {
                assert_ne!(icons::lines(other), Some(icon), "{}", command.label());
            }
        }
    }
}
