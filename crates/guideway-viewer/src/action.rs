//! The requests that parts of the window send to the application.

use std::path::{Path, PathBuf};

use guideway_compose::VectorFormat;
use guideway_document::{Element, Group, SelectMode};
use guideway_layout::CheckOptions;

use crate::backdrop::PlanPlacement;
use crate::command::Command;
use crate::editing::EditTask;
use crate::file_purpose::{Picked, PromptKind};
use crate::services::LostPart;

/// A request from a panel, dialog or tool. Parts return actions; [`App`](crate::app::App) routes
/// each to the part that owns the state.
pub(crate) enum Action {
    /// Runs a command, as its menu entry does.
    Command(Command),
    /// Edits the active document.
    Edit(EditTask),
    /// Renames a vehicle type by this edit of the active document.
    RenameVehicleType(EditTask, TypeRename),
    /// Follows the new name of a vehicle type of the active document.
    VehicleTypeRenamed(TypeRename),
    /// Opens the dialog of a new level or vehicle type.
    ShowGroup(GroupRequest),
    /// Selects the paths that match the query of the find panel.
    SelectByQuery(SelectMode),
    /// Searches for the name of the find panel.
    Search,
    /// Zooms to an element and selects it if it is a path.
    ZoomTo(Element),
    /// Zooms to what belongs to a level or a vehicle type, and selects it.
    ZoomToGroup(Group),
    /// Zooms to an element of the file of this index, which may not be the active one.
    FlyTo(usize, Element),
    /// Checks the active document.
    Check(CheckOptions),
    /// Opens a layout or a project.
    Open(PathBuf),
    /// Saves the active file under this name; asks before another file is replaced.
    SaveAs(PathBuf),
    /// Saves the active file under this name, over what is there.
    SaveOver(PathBuf),
    /// Saves the active file under this name, although its format cannot hold these parts.
    SaveLossy(PathBuf, Vec<LostPart>),
    /// Saves the project under this name; asks before a file is replaced.
    SaveProject(PathBuf),
    /// Saves the project under this name, over what is there.
    SaveProjectOver(PathBuf),
    /// Opens the dialog of the desktop for the name that is being typed.
    Browse(PromptKind),
    /// Takes the answer of the dialog of the desktop.
    Picked(Picked),
    /// Writes the picture as a file; asks before another file is replaced.
    Export(Export),
    /// Writes the picture as a file, over what is there.
    ExportOver(Export),
    /// Replaces the floor plan; an empty text removes it.
    SetFloorPlan(String),
    /// Shows the floor plan at another place.
    PlaceFloorPlan(PlanPlacement),
    /// Opens the network of the open panel as a new layout.
    MakeNetwork,
    /// Edits the file of this index from now on.
    Activate(usize),
    /// Moves a file in the list of files.
    MoveLayer { from: usize, to: usize },
    /// Closes the file of this index; asks if it has unsaved changes.
    Close(usize),
    /// Closes the file of this index; its unsaved changes are lost.
    CloseWithoutSaving(usize),
    /// Reads the active file again; its unsaved changes are lost.
    ReloadWithoutSaving,
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
    /// Saves the files that the leave dialog is about, then closes them.
    SaveAndLeave,
}

/// A vehicle type that gets another name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct TypeRename {
    pub(crate) old: String,
    pub(crate) new: String,
}

/// The object that a dialog creates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GroupRequest {
    NewLevel,
    NewVehicleType,
}

/// A picture to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Export {
    /// As PNG of this width in pixels.
    Png { path: PathBuf, width_px: u32 },
    /// As SVG or PDF.
    Vector { path: PathBuf, format: VectorFormat },
}

impl Export {
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Png { path, .. } | Self::Vector { path, .. } => path,
        }
    }
}
