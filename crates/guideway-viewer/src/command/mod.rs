//! All commands of the window: [`Command`], its label, its shortcuts and its menu.

mod menus;
mod shortcuts;

pub(crate) use menus::{ContextPlace, MENUS, Menu};
#[cfg(test)]
pub(crate) use shortcuts::SHORTCUTS;
pub(crate) use shortcuts::{command_of, shortcuts_of};

/// An action that needs no position in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    Open,
    OpenRecent,
    ExampleSite,
    Reload,
    Save,
    SaveAs,
    SaveProject,
    FloorPlan,
    PlaceFloorPlan,
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
    Settings,
    About,
    Cancel,
    FinishPath,
}

impl Command {
    /// Its name outside of menus, without the points that announce a dialog.
    pub(crate) fn name(self) -> String {
        self.label().trim_end_matches('…').to_owned()
    }

    /// The text of its menu entry.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Open => "Open…",
            Self::OpenRecent => "Open recent…",
            Self::ExampleSite => "Example site",
            Self::Reload => "Reload",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::FloorPlan => "Floor plan…",
            Self::SaveProject => "Save project…",
            Self::PlaceFloorPlan => "Place floor plan…",
            Self::ExportPng => "Export PNG…",
            Self::ExportSvg => "Export SVG…",
            Self::CopyPicture => "Copy picture",
            Self::Close => "Close file",
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::SelectAll => "Select all",
            Self::Deselect => "Deselect all",
            Self::Delete => "Delete",
            Self::Duplicate => "Duplicate",
            Self::RotateLeft => "Rotate left by 90°",
            Self::FlipHorizontal => "Flip horizontally",
            Self::FlipVertical => "Flip vertically",
            Self::Refine => "Refine: insert control points",
            Self::ZoomToAll => "Zoom to all",
            Self::ZoomToSelection => "Zoom to selection",
            Self::ZoomIn => "Zoom in",
            Self::ZoomOut => "Zoom out",
            Self::PanLeft => "Pan left",
            Self::PanRight => "Pan right",
            Self::PanUp => "Pan up",
            Self::PanDown => "Pan down",
            Self::Back => "Previous view",
            Self::Forward => "Next view",
            Self::Hide => "Hide selection",
            Self::Isolate => "Isolate selection",
            Self::ShowAll => "Show all paths",
            Self::NextFile => "Next file",
            Self::Arrows => "Arrows",
            Self::Symbols => "Nodes and stations",
            Self::Labels => "Labels",
            Self::Grid => "Grid",
            Self::Dark => "Dark",
            Self::Density => "Density: paths per pixel",
            Self::SweptAreas => "Swept areas",
            Self::ThesisRule => "Line widths of the thesis",
            Self::ToolSelect => "Select and move",
            Self::ToolPoints => "Nodes and control points",
            Self::ToolDraw => "Draw a path",
            Self::ToolMeasure => "Measure",
            Self::Find => "Find by name or query",
            Self::Shortcuts => "Keyboard shortcuts",
            Self::Settings => "Settings…",
            Self::About => "About Guideway",
            Self::Cancel => "Cancel",
            Self::FinishPath => "Finish path",
        }
    }
}
