//! The state of commands in menus and the toolbar: text, tick, and whether they can run.

use super::bottom_panel::BottomView;
use crate::command::Command;
use crate::display_settings::DisplaySettings;
use crate::files::OpenFiles;
use crate::language::t;
use crate::tools::Tool;

/// Everything that the state of a command depends on.
pub(crate) struct CommandState<'a> {
    pub(crate) files: &'a OpenFiles,
    pub(crate) settings: &'a DisplaySettings,
    pub(crate) has_floor_plan: bool,
    /// True if swept areas are shown.
    pub(crate) has_swept_areas: bool,
    /// True if the side panel is shown.
    pub(crate) has_side_panel: bool,
    /// The view of the bottom panel that is open.
    pub(crate) bottom: Option<BottomView>,
    pub(crate) tool: Tool,
}

impl CommandState<'_> {
    /// The text of a command; undo and redo name their step.
    pub(super) fn label(&self, command: Command) -> String {
        let document = self.files.document();
        let (undo, redo) = document.map_or((None, None), |document| document.undo_redo_names());
        let step = match command {
            Command::Undo => undo,
            Command::Redo => redo,
            _ => None,
        };
        let label = command.label();
        step.map_or_else(|| label.to_owned(), |step| format!("{label}: {}", t(step)))
    }

    /// Returns `true` if a command has something to act on.
    pub(crate) fn is_possible(&self, command: Command) -> bool {
        if command == Command::PlaceFloorPlan {
            return self.has_floor_plan;
        }
        let Some(layer) = self.files.active() else {
            return !needs_file(command);
        };
        // While an edit has the document, what comes after it is not known.
        let Some(document) = layer.document() else {
            return true;
        };
        let (undo, redo) = document.undo_redo_names();
        match command {
            Command::Undo => undo.is_some(),
            Command::Redo => redo.is_some(),
            Command::ShowAll => document.scene().hidden_count() > 0,
            Command::NextFile => self.files.layers().len() > 1,
            Command::FinishPath => self.tool.curve().is_some(),
            command if takes_groups(command) => !document.selected().is_empty(),
            Command::Hide => {
                let selected = document.selected();
                selected.has_elements() || !selected.levels.is_empty()
            }
            command if needs_selection(command) => document.selected().has_elements(),
            _ => true,
        }
    }

    /// Returns `true` if a command is a switch that is on.
    pub(crate) fn is_on(&self, command: Command) -> bool {
        match command {
            Command::Arrows => self.settings.has_arrows,
            Command::Symbols => self.settings.has_symbols,
            Command::Labels => self.settings.has_labels,
            Command::Grid => self.settings.has_grid,
            Command::Density => self.settings.shows_density(),
            Command::ThesisRule => self.settings.is_thesis_rule,
            Command::Dark => self.settings.is_dark,
            Command::SweptAreas => self.has_swept_areas,
            Command::SidePanel => self.has_side_panel,
            Command::Table => self.bottom == Some(BottomView::Table),
            Command::Route => self.bottom == Some(BottomView::Route),
            Command::Compare => self.bottom == Some(BottomView::Compare),
            Command::Network => self.bottom == Some(BottomView::Network),
            Command::ToolSelect => self.tool == Tool::Select,
            Command::ToolPoints => self.tool == Tool::Points,
            Command::ToolLine => self.tool == Tool::Line,
            Command::ToolArc => self.tool == Tool::Arc,
            Command::ToolCurve => self.tool == Tool::Curve,
            Command::ToolBezier => self.tool == Tool::Bezier,
            Command::ToolNode => self.tool == Tool::Node,
            Command::ToolStation => self.tool == Tool::Station,
            Command::ToolMeasure => self.tool == Tool::Measure,
            _ => false,
        }
    }
}

/// Returns `true` if a command acts on selected levels and vehicle types too.
fn takes_groups(command: Command) -> bool {
    matches!(
        command,
        Command::Deselect
            | Command::Delete
            | Command::Duplicate
            | Command::ZoomToSelection
            | Command::Cut
            | Command::Copy
            | Command::Rename
    )
}

fn needs_selection(command: Command) -> bool {
    matches!(
        command,
        Command::Deselect
            | Command::Delete
            | Command::Duplicate
            | Command::RotateLeft
            | Command::FlipHorizontal
            | Command::FlipVertical
            | Command::Refine
            | Command::ZoomToSelection
            | Command::Hide
            | Command::Isolate
            | Command::Cut
            | Command::Copy
            | Command::Array
            | Command::Rename
            | Command::MoveToLevel
            | Command::Fillet
            | Command::Split
            | Command::SplitCrossings
            | Command::Join
            | Command::Weld
            | Command::Reverse
            | Command::OneWay
            | Command::TwoWay
            | Command::Straighten
            | Command::AlignX
            | Command::AlignY
            | Command::Distribute
    )
}

fn needs_file(command: Command) -> bool {
    needs_selection(command)
        || matches!(
            command,
            Command::Reload
                | Command::Save
                | Command::SaveAs
                | Command::ExportPng
                | Command::ExportSvg
                | Command::ExportPdf
                | Command::CopyPicture
                | Command::Close
                | Command::Undo
                | Command::Redo
                | Command::SelectAll
                | Command::NewLevel
                | Command::NewVehicleType
                | Command::Find
                | Command::NextFile
                | Command::ShowAll
                | Command::FinishPath
                | Command::Paste
                | Command::Table
                | Command::Route
                | Command::Compare
                | Command::Network
                | Command::ToolPoints
                | Command::ToolLine
                | Command::ToolArc
                | Command::ToolCurve
                | Command::ToolBezier
                | Command::ToolNode
                | Command::ToolStation
        )
}
