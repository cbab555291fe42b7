//! Open files: loading, saving, watching, and the list of recent files.
//!
//! | part | owns | file |
//! |---|---|---|
//! | [`OpenFiles`] | the open files, the active one, watcher, recent files | `open_files` |
//! | [`Layer`] | one open file: loader, document slot, picture, tasks | `layer`, `layer_poll` |
//! | [`layer_tool_context`] | what the tools see of a file | `layer_tool_context` |
//! | [`Loader`](loader::Loader) | the thread that reads a file | `loader` |
//! | [`DraftFile`](draft_file::DraftFile) | the first state of a layout without a file | `draft_file` |
//! | `NewLayouts` | layouts that wait for a name | `new_layouts` |
//! | [`FileWriter`] | the file being written | `file_writer` |
//! | [`Watcher`](watcher::Watcher) | the thread that detects changes on disk | `watcher` |
//! | [`RecentFiles`](recent_files::RecentFiles) | files of earlier runs | `recent_files` |

mod draft_file;
mod file_writer;
mod layer;
mod layer_context;
mod layer_event;
mod layer_look;
mod layer_poll;
mod layer_tool_context;
mod loader;
mod new_layouts;
mod open_files;
mod recent_files;
mod save_state;
mod watcher;

pub(crate) use draft_file::DEFAULT_EXTENSION;
pub(crate) use file_writer::{FileWriter, WriteOutcome, WriteTarget, Written};
pub(crate) use layer::Layer;
pub(crate) use layer_context::LayerContext;
pub(crate) use layer_event::LayerEvent;
pub(crate) use layer_look::LayerLook;
pub(crate) use layer_tool_context::layer_tool_context;
pub(crate) use loader::NewLayout;
pub(crate) use open_files::OpenFiles;
pub(crate) use save_state::{BegunSave, SavedFile, is_unknown};
pub(crate) use watcher::Stamp;
