//! The requests that parts of the window send to the application.

use std::path::PathBuf;

use guideway_document::{Element, SelectMode};
use guideway_layout::CheckOptions;

use crate::command::Command;
use crate::editing::EditTask;
use crate::tools::Tool;

/// A request from a panel, dialog or tool. Parts return actions; [`App`](crate::app::App) routes
/// each to the part that owns the state.
pub(crate) enum Action {
    /// Runs a command, as its menu entry does.
    Command(Command),
    /// Selects a tool.
    SelectTool(Tool),
    /// Edits the active document.
    Edit(EditTask),
    /// Selects the paths that match the query of the find panel.
    SelectByQuery(SelectMode),
    /// Searches for the name of the find panel.
    Search,
    /// Zooms to an element and selects it if it is a path.
    ZoomTo(Element),
    /// Checks the active document.
    Check(CheckOptions),
    /// Opens a file.
    Open(PathBuf),
    /// Saves the active file under this name.
    SaveAs(PathBuf),
    /// Writes the picture as PNG of this width in pixels.
    ExportPng { path: PathBuf, width_px: u32 },
    /// Writes the picture as SVG.
    ExportSvg(PathBuf),
    /// Replaces the floor plan; an empty text removes it.
    SetFloorPlan(String),
    /// Edits the file of this index from now on.
    Activate(usize),
    /// Closes the file of this index.
    Close(usize),
    /// Replays the unsaved work of the file of this index.
    Recover(usize),
    /// Deletes the unsaved work of the file of this index.
    DiscardUnsavedWork(usize),
    /// Selects a render method; `None` selects the best.
    SetMethod(Option<String>),
    /// Applies a changed theme.
    ApplyTheme,
    /// Recolors all files after a change of the display settings.
    Recolor,
    /// Shows a notice to the user.
    Notify(String),
    /// Closes the window although there are unsaved changes.
    QuitWithoutSaving,
}
