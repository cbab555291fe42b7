use eframe::egui::{Key, KeyboardShortcut, Modifiers};

/// Everything that can be done without pointing at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    Open,
    OpenRecent,
    Reload,
    Save,
    SaveAs,
    FloorPlan,
    ExportPicture,
    ExportDrawing,
    CopyPicture,
    Close,
    Quit,
    Undo,
    Redo,
    SelectAll,
    SelectNone,
    Delete,
    Duplicate,
    TurnLeft,
    MirrorAcross,
    MirrorUp,
    Refine,
    Fit,
    FitSelection,
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
    Swept,
    ThesisRule,
    ToolSelect,
    ToolPoints,
    ToolDraw,
    ToolMeasure,
    Find,
    Keys,
    Stop,
    Finish,
}

/// A command as a person sees it.
pub(crate) struct Entry {
    pub(crate) command: Command,
    /// The menu that it is in.
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

/// All commands. One whose keys are those of another with more of them held comes after it, for the first match
/// counts.
pub(crate) const ENTRIES: &[Entry] = &[
    entry(
        "File",
        "Open recent…",
        Command::OpenRecent,
        CTRL_SHIFT,
        Key::O,
    ),
    entry("File", "Open…", Command::Open, CTRL, Key::O),
    entry("File", "Read again", Command::Reload, CTRL, Key::R),
    entry("File", "Save as…", Command::SaveAs, CTRL_SHIFT, Key::S),
    entry("File", "Save", Command::Save, CTRL, Key::S),
    entry(
        "File",
        "Export drawing (SVG)…",
        Command::ExportDrawing,
        CTRL_SHIFT,
        Key::E,
    ),
    entry(
        "File",
        "Export picture (PNG)…",
        Command::ExportPicture,
        CTRL,
        Key::E,
    ),
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
        "Select nothing",
        Command::SelectNone,
        CTRL_SHIFT,
        Key::A,
    ),
    entry("Edit", "Select all", Command::SelectAll, CTRL, Key::A),
    entry("Edit", "Delete", Command::Delete, NONE, Key::Delete),
    entry("Edit", "Duplicate", Command::Duplicate, CTRL, Key::D),
    entry("Edit", "Turn left by 90°", Command::TurnLeft, NONE, Key::R),
    entry(
        "Edit",
        "Mirror up and down",
        Command::MirrorUp,
        SHIFT,
        Key::X,
    ),
    entry(
        "Edit",
        "Mirror left and right",
        Command::MirrorAcross,
        NONE,
        Key::X,
    ),
    entry(
        "Edit",
        "Refine: more control points",
        Command::Refine,
        CTRL,
        Key::B,
    ),
    entry(
        "View",
        "Show the selection",
        Command::FitSelection,
        SHIFT,
        Key::F,
    ),
    entry("View", "Show everything", Command::Fit, NONE, Key::F),
    entry("View", "Zoom in", Command::ZoomIn, NONE, Key::Plus),
    entry("View", "Zoom in, too", Command::ZoomIn, NONE, Key::Equals),
    entry("View", "Zoom out", Command::ZoomOut, NONE, Key::Minus),
    entry("View", "Back", Command::Back, ALT, Key::ArrowLeft),
    entry("View", "Forward", Command::Forward, ALT, Key::ArrowRight),
    entry("View", "Left", Command::PanLeft, NONE, Key::ArrowLeft),
    entry("View", "Right", Command::PanRight, NONE, Key::ArrowRight),
    entry("View", "Up", Command::PanUp, NONE, Key::ArrowUp),
    entry("View", "Down", Command::PanDown, NONE, Key::ArrowDown),
    entry("View", "Next file", Command::NextFile, NONE, Key::PageDown),
    entry("View", "Find by name or query", Command::Find, CTRL, Key::F),
    entry("Show", "All paths", Command::ShowAll, NONE, Key::U),
    entry("Show", "Hide the selection", Command::Hide, NONE, Key::H),
    entry("Show", "Only the selection", Command::Isolate, NONE, Key::I),
    entry("Show", "Arrows", Command::Arrows, NONE, Key::A),
    entry("Show", "Nodes and stations", Command::Symbols, NONE, Key::N),
    entry("Show", "Names", Command::Labels, NONE, Key::L),
    entry("Show", "Grid", Command::Grid, NONE, Key::G),
    entry("Show", "Dark", Command::Dark, NONE, Key::B),
    entry(
        "Show",
        "Density: how many paths lie where",
        Command::Density,
        NONE,
        Key::Y,
    ),
    entry(
        "Show",
        "Areas that a vehicle sweeps",
        Command::Swept,
        NONE,
        Key::E,
    ),
    entry(
        "Show",
        "Line widths of the thesis",
        Command::ThesisRule,
        NONE,
        Key::T,
    ),
    entry("Show", "Keys", Command::Keys, NONE, Key::F1),
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
    entry(
        "Tool",
        "Stop what is being done",
        Command::Stop,
        NONE,
        Key::Escape,
    ),
    entry("Tool", "Finish the path", Command::Finish, NONE, Key::Enter),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_commands_have_the_same_keys() {
        for (i, a) in ENTRIES.iter().enumerate() {
            for b in &ENTRIES[..i] {
                assert_ne!(a.shortcut, b.shortcut, "{} and {}", a.label, b.label);
            }
        }
    }

    /// egui takes a shortcut without Shift or Alt also where they are held.
    #[test]
    fn a_command_with_more_keys_held_is_not_hidden_by_one_with_fewer() {
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
    fn every_command_is_in_a_menu() {
        assert!(ENTRIES.iter().all(|entry| MENUS.contains(&entry.menu)));
    }
}
