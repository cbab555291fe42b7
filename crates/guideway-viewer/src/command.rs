//! All commands of the window: menu, label and shortcut of each.

use eframe::egui::{Key, KeyboardShortcut, Modifiers};

/// An action that needs no position in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    Open,
    OpenRecent,
    Reload,
    Save,
    SaveAs,
    FloorPlan,
    ExportPng,
    ExportSvg,
    CopyPicture,
    Close,
    Quit,
    Undo,
    Redo,
    SelectAll,
    Deselect,
    Delete,
    Duplicate,
    RotateLeft,
    FlipHorizontal,
    FlipVertical,
    Refine,
    ZoomToAll,
    ZoomToSelection,
    ZoomIn,
    ZoomOut,
    PanLeft,
    PanRight,
    PanUp,
    PanDown,
    Back,
    Forward,
    Hide,
    Isolate,
    ShowAll,
    NextFile,
    Arrows,
    Symbols,
    Labels,
    Grid,
    Dark,
    Density,
    SweptAreas,
    ThesisRule,
    ToolSelect,
    ToolPoints,
    ToolDraw,
    ToolMeasure,
    Find,
    Shortcuts,
    Cancel,
    FinishPath,
}

/// Menu, label and shortcut of a command.
pub(crate) struct Entry {
    pub(crate) command: Command,
    /// One of [`MENUS`].
    pub(crate) menu: &'static str,
    pub(crate) label: &'static str,
    pub(crate) shortcut: KeyboardShortcut,
}

/// The menus, in order.
pub(crate) const MENUS: [&str; 5] = ["File", "Edit", "View", "Show", "Tool"];

const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;
const ALT: Modifiers = Modifiers::ALT;
const NONE: Modifiers = Modifiers::NONE;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

const fn entry(
    menu: &'static str,
    label: &'static str,
    command: Command,
    modifiers: Modifiers,
    key: Key,
) -> Entry {
    Entry {
        command,
        menu,
        label,
        shortcut: KeyboardShortcut::new(modifiers, key),
    }
}

/// All commands. A shortcut with more modifiers comes before the same key with fewer: the first
/// match wins.
pub(crate) const ENTRIES: &[Entry] = &[
    entry(
        "File",
        "Open recent…",
        Command::OpenRecent,
        CTRL_SHIFT,
        Key::O,
    ),
    entry("File", "Open…", Command::Open, CTRL, Key::O),
    entry("File", "Reload", Command::Reload, CTRL, Key::R),
    entry("File", "Save as…", Command::SaveAs, CTRL_SHIFT, Key::S),
    entry("File", "Save", Command::Save, CTRL, Key::S),
    entry(
        "File",
        "Export SVG…",
        Command::ExportSvg,
        CTRL_SHIFT,
        Key::E,
    ),
    entry("File", "Export PNG…", Command::ExportPng, CTRL, Key::E),
    entry(
        "File",
        "Copy picture",
        Command::CopyPicture,
        CTRL_SHIFT,
        Key::C,
    ),
    entry("File", "Floor plan…", Command::FloorPlan, CTRL, Key::L),
    entry("File", "Close file", Command::Close, CTRL, Key::W),
    entry("File", "Quit", Command::Quit, CTRL, Key::Q),
    entry("Edit", "Redo", Command::Redo, CTRL_SHIFT, Key::Z),
    entry("Edit", "Undo", Command::Undo, CTRL, Key::Z),
    entry(
        "Edit",
        "Deselect all",
        Command::Deselect,
        CTRL_SHIFT,
        Key::A,
    ),
    entry("Edit", "Select all", Command::SelectAll, CTRL, Key::A),
    entry("Edit", "Delete", Command::Delete, NONE, Key::Delete),
    entry("Edit", "Duplicate", Command::Duplicate, CTRL, Key::D),
    entry(
        "Edit",
        "Rotate left by 90°",
        Command::RotateLeft,
        NONE,
        Key::R,
    ),
    entry(
        "Edit",
        "Flip vertically",
        Command::FlipVertical,
        SHIFT,
        Key::X,
    ),
    entry(
        "Edit",
        "Flip horizontally",
        Command::FlipHorizontal,
        NONE,
        Key::X,
    ),
    entry(
        "Edit",
        "Refine: insert control points",
        Command::Refine,
        CTRL,
        Key::B,
    ),
    entry(
        "View",
        "Zoom to selection",
        Command::ZoomToSelection,
        SHIFT,
        Key::F,
    ),
    entry("View", "Zoom to all", Command::ZoomToAll, NONE, Key::F),
    entry("View", "Zoom in", Command::ZoomIn, NONE, Key::Plus),
    entry(
        "View",
        "Zoom in (without Shift)",
        Command::ZoomIn,
        NONE,
        Key::Equals,
    ),
    entry("View", "Zoom out", Command::ZoomOut, NONE, Key::Minus),
    entry("View", "Previous view", Command::Back, ALT, Key::ArrowLeft),
    entry("View", "Next view", Command::Forward, ALT, Key::ArrowRight),
    entry("View", "Pan left", Command::PanLeft, NONE, Key::ArrowLeft),
    entry(
        "View",
        "Pan right",
        Command::PanRight,
        NONE,
        Key::ArrowRight,
    ),
    entry("View", "Pan up", Command::PanUp, NONE, Key::ArrowUp),
    entry("View", "Pan down", Command::PanDown, NONE, Key::ArrowDown),
    entry("View", "Next file", Command::NextFile, NONE, Key::PageDown),
    entry("View", "Find by name or query", Command::Find, CTRL, Key::F),
    entry("Show", "Show all paths", Command::ShowAll, NONE, Key::U),
    entry("Show", "Hide selection", Command::Hide, NONE, Key::H),
    entry("Show", "Isolate selection", Command::Isolate, NONE, Key::I),
    entry("Show", "Arrows", Command::Arrows, NONE, Key::A),
    entry("Show", "Nodes and stations", Command::Symbols, NONE, Key::N),
    entry("Show", "Labels", Command::Labels, NONE, Key::L),
    entry("Show", "Grid", Command::Grid, NONE, Key::G),
    entry("Show", "Dark", Command::Dark, NONE, Key::B),
    entry(
        "Show",
        "Density: paths per pixel",
        Command::Density,
        NONE,
        Key::Y,
    ),
    entry("Show", "Swept areas", Command::SweptAreas, NONE, Key::E),
    entry(
        "Show",
        "Line widths of the thesis",
        Command::ThesisRule,
        NONE,
        Key::T,
    ),
    entry(
        "Show",
        "Keyboard shortcuts",
        Command::Shortcuts,
        NONE,
        Key::F1,
    ),
    entry("Tool", "Select and move", Command::ToolSelect, NONE, Key::V),
    entry(
        "Tool",
        "Nodes and control points",
        Command::ToolPoints,
        NONE,
        Key::P,
    ),
    entry("Tool", "Draw a path", Command::ToolDraw, NONE, Key::D),
    entry("Tool", "Measure", Command::ToolMeasure, NONE, Key::M),
    entry("Tool", "Cancel", Command::Cancel, NONE, Key::Escape),
    entry("Tool", "Finish path", Command::FinishPath, NONE, Key::Enter),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortcuts_are_unique() {
        for (i, a) in ENTRIES.iter().enumerate() {
            for b in &ENTRIES[..i] {
                assert_ne!(a.shortcut, b.shortcut, "{} and {}", a.label, b.label);
            }
        }
    }

    /// egui also accepts a shortcut without Shift or Alt while these are pressed.
    #[test]
    fn shortcut_with_more_modifiers_comes_first() {
        for (i, later) in ENTRIES.iter().enumerate() {
            for earlier in &ENTRIES[..i] {
                let same_key = later.shortcut.logical_key == earlier.shortcut.logical_key;
                let hides = later
                    .shortcut
                    .modifiers
                    .matches_logically(earlier.shortcut.modifiers);
                assert!(
                    !(same_key && hides),
                    "{} hides {}",
                    earlier.label,
                    later.label
                );
            }
        }
    }

    #[test]
    fn each_command_is_in_a_menu() {
        assert!(ENTRIES.iter().all(|entry| MENUS.contains(&entry.menu)));
    }
}
