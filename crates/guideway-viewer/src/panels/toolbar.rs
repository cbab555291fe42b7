//! The toolbar: commands as icons, each with its name and shortcut as a tooltip.

use eframe::egui::{Rect, Response, Role, Sense, Ui, Vec2, WidgetInfo};

use super::command_state::CommandState;
use super::icons;
use crate::action::Action;
use crate::command::{Command, shortcuts_of};

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

/// Shows the toolbar in a row and returns the actions of clicks.
pub(crate) fn show(ui: &mut Ui, state: &CommandState<'_>) -> Vec<Action> {
    let mut actions = Vec::new();
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (number, group) in GROUPS.iter().enumerate() {
            if number > 0 {
                ui.separator();
            }
            for &command in *group {
                // A part of the window for each button would take as long as all else here.
                let response = if state.is_possible(command) {
                    button(ui, command, state)
                } else {
                    ui.add_enabled_ui(false, |ui| button(ui, command, state))
                        .inner
                };
                if response.clicked() {
                    actions.push(Action::Command(command));
                }
            }
        }
    });
    actions
}

fn button(ui: &mut Ui, command: Command, state: &CommandState<'_>) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(BUTTON), Sense::click());
    let is_on = state.is_on(command);
    response
        .widget_info(|| WidgetInfo::selected(Role::Button, ui.is_enabled(), is_on, command.name()));
    let visuals = ui.style().interact_selectable(&response, is_on);
    if is_on || response.hovered() || response.has_focus() {
        let radius = visuals.corner_radius;
        ui.painter().rect_filled(rect, radius, visuals.weak_bg_fill);
    }
    let square = Rect::from_center_size(rect.center(), Vec2::splat(ICON));
    icons::paint(ui.painter(), command, square, visuals.fg_stroke);
    if !response.contains_pointer() && !response.has_focus() {
        return response;
    }
    let keys = shortcuts_of(command).next();
    let keys = keys.map(|keys| format!(" ({})", ui.ctx().format_shortcut(keys)));
    let text = state.label(command) + &keys.unwrap_or_default();
    response.on_hover_text(&text).on_disabled_hover_text(&text)
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
