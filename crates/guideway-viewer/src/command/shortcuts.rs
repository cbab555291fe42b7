//! The keyboard shortcuts of the commands.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

use super::Command;

const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const ALT: Modifiers = Modifiers::ALT;
const NONE: Modifiers = Modifiers::NONE;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn on(command: Command, modifiers: Modifiers, key: Key) -> (Command, KeyboardShortcut) {
    (command, KeyboardShortcut::new(modifiers, key))
}

/// All shortcuts. Of several for one command, menus show the first.
pub(crate) const SHORTCUTS: &[(Command, KeyboardShortcut)] = &[
    on(Command::NewLayout, CTRL, Key::N),
    on(Command::Open, CTRL, Key::O),
    on(Command::OpenRecent, CTRL_SHIFT, Key::O),
    on(Command::Reload, CTRL, Key::R),
    on(Command::Reload, NONE, Key::F5),
    on(Command::Save, CTRL, Key::S),
    on(Command::SaveAs, CTRL_SHIFT, Key::S),
    on(Command::ExportPng, CTRL, Key::E),
    on(Command::ExportSvg, CTRL_SHIFT, Key::E),
    on(Command::ExportPdf, CTRL, Key::P),
    on(Command::CopyPicture, CTRL_SHIFT, Key::C),
    on(Command::FloorPlan, CTRL, Key::L),
    on(Command::Close, CTRL, Key::W),
    on(Command::Quit, CTRL, Key::Q),
    on(Command::Undo, CTRL, Key::Z),
    on(Command::Redo, CTRL_SHIFT, Key::Z),
    on(Command::Redo, CTRL, Key::Y),
    on(Command::Cut, CTRL, Key::X),
    on(Command::Copy, CTRL, Key::C),
    on(Command::Paste, CTRL, Key::V),
    on(Command::SelectAll, CTRL, Key::A),
    on(Command::Deselect, CTRL_SHIFT, Key::A),
    on(Command::Find, CTRL, Key::F),
    on(Command::Duplicate, CTRL, Key::D),
    on(Command::Delete, NONE, Key::Delete),
    on(Command::Array, CTRL_SHIFT, Key::D),
    on(Command::Rename, NONE, Key::F2),
    on(Command::Fillet, NONE, Key::Q),
    on(Command::Split, NONE, Key::K),
    on(Command::Join, NONE, Key::J),
    on(Command::RotateLeft, NONE, Key::R),
    on(Command::FlipHorizontal, NONE, Key::X),
    on(Command::FlipVertical, SHIFT, Key::X),
    on(Command::Refine, CTRL, Key::B),
    on(Command::ZoomToAll, NONE, Key::F),
    on(Command::ZoomToAll, NONE, Key::Home),
    on(Command::ZoomToAll, CTRL, Key::Num0),
    on(Command::ZoomToSelection, SHIFT, Key::F),
    on(Command::ZoomToScale, CTRL, Key::Num1),
    on(Command::ZoomIn, NONE, Key::Plus),
    on(Command::ZoomIn, NONE, Key::Equals),
    on(Command::ZoomOut, NONE, Key::Minus),
    on(Command::Back, ALT, Key::ArrowLeft),
    on(Command::Forward, ALT, Key::ArrowRight),
    on(Command::PanLeft, NONE, Key::ArrowLeft),
    on(Command::PanRight, NONE, Key::ArrowRight),
    on(Command::PanUp, NONE, Key::ArrowUp),
    on(Command::PanDown, NONE, Key::ArrowDown),
    on(Command::NextFile, NONE, Key::PageDown),
    on(Command::NextFile, CTRL, Key::Tab),
    on(Command::Arrows, NONE, Key::A),
    on(Command::Symbols, NONE, Key::N),
    on(Command::Labels, NONE, Key::L),
    on(Command::Grid, NONE, Key::G),
    on(Command::SidePanel, NONE, Key::F9),
    on(Command::Table, CTRL, Key::T),
    on(Command::Route, SHIFT, Key::R),
    on(Command::SweptAreas, NONE, Key::E),
    on(Command::Density, NONE, Key::Y),
    on(Command::ThesisRule, NONE, Key::T),
    on(Command::Dark, NONE, Key::B),
    on(Command::Hide, NONE, Key::H),
    on(Command::Isolate, NONE, Key::I),
    on(Command::ShowAll, NONE, Key::U),
    on(Command::ToolSelect, NONE, Key::V),
    on(Command::ToolPoints, NONE, Key::P),
    on(Command::ToolLine, NONE, Key::D),
    on(Command::ToolArc, NONE, Key::O),
    on(Command::ToolCurve, NONE, Key::C),
    on(Command::ToolBezier, SHIFT, Key::C),
    on(Command::ToolNode, NONE, Key::W),
    on(Command::ToolStation, NONE, Key::S),
    on(Command::ToolMeasure, NONE, Key::M),
    on(Command::FinishPath, NONE, Key::Enter),
    on(Command::Cancel, NONE, Key::Escape),
    on(Command::Shortcuts, NONE, Key::F1),
];

/// The command of a pressed key.
pub(crate) fn command_of(key: Key, modifiers: Modifiers) -> Option<Command> {
    let is_pressed = |shortcut: &KeyboardShortcut| {
        let wanted = shortcut.modifiers;
        shortcut.logical_key == key
            && wanted.command == modifiers.command
            && wanted.alt == modifiers.alt
            && (wanted.shift == modifiers.shift || may_need_shift(key))
    };
    let mut all = SHORTCUTS.iter();
    all.find(|(_, shortcut)| is_pressed(shortcut))
        .map(|(command, _)| *command)
}

/// The shortcuts of a command.
pub(crate) fn shortcuts_of(command: Command) -> impl Iterator<Item = &'static KeyboardShortcut> {
    let of_command = SHORTCUTS.iter().filter(move |(other, _)| *other == command);
    of_command.map(|(_, shortcut)| shortcut)
}

/// Returns `true` for signs that some keyboards have above another sign.
fn may_need_shift(key: Key) -> bool {
    matches!(key, Key::Plus | Key::Equals | Key::Minus)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortcuts_are_unique() {
        for (i, (a, shortcut)) in SHORTCUTS.iter().enumerate() {
            for (b, other) in &SHORTCUTS[..i] {
                assert_ne!(shortcut, other, "{} and {}", a.label(), b.label());
            }
        }
    }

    #[test]
    fn modifiers_decide_between_commands_of_one_key() {
        // egui reports Ctrl as both.
        let ctrl = Modifiers::CTRL.plus(Modifiers::COMMAND);
        assert_eq!(command_of(Key::Z, ctrl), Some(Command::Undo));
        let ctrl_shift = ctrl.plus(Modifiers::SHIFT);
        assert_eq!(command_of(Key::Z, ctrl_shift), Some(Command::Redo));
        assert_eq!(command_of(Key::Z, NONE), None);
        assert_eq!(command_of(Key::Plus, SHIFT), Some(Command::ZoomIn));
        assert_eq!(command_of(Key::Delete, SHIFT), None);
    }
}
