//! All commands of the window: [`Command`], its label, its shortcuts and its menu.
use crate::language::t;

mod menus;
mod shortcuts;

pub(crate) use menus::{ContextPlace, MENUS, Menu};
#[cfg(test)]
pub(crate) use shortcuts::SHORTCUTS;
pub(crate) use shortcuts::{command_of, shortcuts_of};

/// An action that needs no position in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    NewLayout,
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
    ExportPdf,
    CopyPicture,
    Close,
    Quit,
    Undo,
    Redo,
    Cut,
    Copy,
    Paste,
    SelectAll,
    Deselect,
    Delete,
    Duplicate,
    Array,
    Rename,
    MoveToLevel,
    NewLevel,
    NewVehicleType,
    Fillet,
    Split,
    SplitCrossings,
    Join,
    Weld,
    Reverse,
    OneWay,
    TwoWay,
    Straighten,
    AlignX,
    AlignY,
    Distribute,
    RotateLeft,
    FlipHorizontal,
    FlipVertical,
    Refine,
    ZoomToAll,
    ZoomToSelection,
    ZoomToScale,
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
    SidePanel,
    Table,
    Route,
    Compare,
    Network,
    Dark,
    Density,
    SweptAreas,
    ThesisRule,
    ToolSelect,
    ToolPoints,
    ToolLine,
    ToolArc,
    ToolCurve,
    ToolBezier,
    ToolNode,
    ToolStation,
    ToolMeasure,
    Find,
    Shortcuts,
    Settings,
    About,
    Cancel,
    FinishPath,
}

impl Command {
    /// Returns `true` if it may move the camera.
    pub(crate) fn moves_camera(self) -> bool {
        matches!(
            self,
            Self::PanLeft
                | Self::PanRight
                | Self::PanUp
                | Self::PanDown
                | Self::ZoomToAll
                | Self::ZoomToSelection
                | Self::ZoomToScale
                | Self::ZoomIn
                | Self::ZoomOut
                | Self::Back
                | Self::Forward
        )
    }

    /// Its name outside of menus, without the points that announce a dialog.
    pub(crate) fn name(self) -> String {
        self.label().trim_end_matches('…').to_owned()
    }

    /// The text of its menu entry.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::NewLayout => t("New layout"),
            Self::Open => t("Open…"),
            Self::OpenRecent => t("Open recent…"),
            Self::ExampleSite => t("Example site"),
            Self::Reload => t("Reload"),
            Self::Save => t("Save"),
            Self::SaveAs => t("Save as…"),
            Self::FloorPlan => t("Floor plan…"),
            Self::SaveProject => t("Save project…"),
            Self::PlaceFloorPlan => t("Place floor plan…"),
            Self::ExportPng => t("Export PNG…"),
            Self::ExportSvg => t("Export SVG…"),
            Self::ExportPdf => t("Export PDF…"),
            Self::CopyPicture => t("Copy picture"),
            Self::Close => t("Close file"),
            Self::Quit => t("Quit"),
            Self::Undo => t("Undo"),
            Self::Redo => t("Redo"),
            Self::Cut => t("Cut"),
            Self::Copy => t("Copy"),
            Self::Paste => t("Paste"),
            Self::SelectAll => t("Select all"),
            Self::Deselect => t("Deselect all"),
            Self::Delete => t("Delete"),
            Self::Duplicate => t("Duplicate"),
            Self::Array => t("Array…"),
            Self::Rename => t("Rename…"),
            Self::MoveToLevel => t("Move to level…"),
            Self::NewLevel => t("New level…"),
            Self::NewVehicleType => t("New vehicle type…"),
            Self::Fillet => t("Fillet a corner…"),
            Self::Split => t("Split at the pointer or the middle"),
            Self::SplitCrossings => t("Split at crossings"),
            Self::Join => t("Join at a node"),
            Self::Weld => t("Weld ends…"),
            Self::Reverse => t("Reverse"),
            Self::OneWay => t("Make one-way"),
            Self::TwoWay => t("Make two-way"),
            Self::Straighten => t("Straighten"),
            Self::AlignX => t("Align to one x"),
            Self::AlignY => t("Align to one y"),
            Self::Distribute => t("Distribute…"),
            Self::RotateLeft => t("Rotate left by 90°"),
            Self::FlipHorizontal => t("Flip horizontally"),
            Self::FlipVertical => t("Flip vertically"),
            Self::Refine => t("Refine: insert control points"),
            Self::ZoomToAll => t("Zoom to all"),
            Self::ZoomToSelection => t("Zoom to selection"),
            Self::ZoomToScale => t("Zoom to 1:100"),
            Self::ZoomIn => t("Zoom in"),
            Self::ZoomOut => t("Zoom out"),
            Self::PanLeft => t("Pan left"),
            Self::PanRight => t("Pan right"),
            Self::PanUp => t("Pan up"),
            Self::PanDown => t("Pan down"),
            Self::Back => t("Previous view"),
            Self::Forward => t("Next view"),
            Self::Hide => t("Hide selection"),
            Self::Isolate => t("Isolate selection"),
            Self::ShowAll => t("Show all paths"),
            Self::NextFile => t("Next file"),
            Self::Arrows => t("Arrows"),
            Self::Symbols => t("Nodes and stations"),
            Self::Labels => t("Labels"),
            Self::Grid => t("Grid"),
            Self::SidePanel => t("Side panel"),
            Self::Table => t("Table"),
            Self::Route => t("Route"),
            Self::Compare => t("Compare with another file"),
            Self::Network => t("Network of a drawing"),
            Self::Dark => t("Dark"),
            Self::Density => t("Density: paths per pixel"),
            Self::SweptAreas => t("Swept areas"),
            Self::ThesisRule => t("Line widths of the thesis"),
            Self::ToolSelect => t("Select and move"),
            Self::ToolPoints => t("Nodes and control points"),
            Self::ToolLine => t("Draw lines"),
            Self::ToolArc => t("Draw an arc"),
            Self::ToolCurve => t("Draw a curve"),
            Self::ToolBezier => t("Draw a Bezier curve"),
            Self::ToolNode => t("Create nodes"),
            Self::ToolStation => t("Create stations"),
            Self::ToolMeasure => t("Measure"),
            Self::Find => t("Find by name or query"),
            Self::Shortcuts => t("Keyboard shortcuts"),
            Self::Settings => t("Settings…"),
            Self::About => t("About Guideway"),
            Self::Cancel => t("Cancel"),
            Self::FinishPath => t("Finish path"),
        }
    }
}
