//! The question for a file name that the desktop's own dialog asks, and its answer.

use std::path::PathBuf;

/// A question for the name of one file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FileQuestion {
    /// Title of the dialog.
    pub title: String,
    /// Folder that the dialog shows first.
    pub folder: Option<PathBuf>,
    /// Suggested name of a file to write; `None` asks for a file that exists.
    pub new_name: Option<String>,
    /// The formats that the dialog offers, the first of them at the start.
    pub formats: Vec<FileFormat>,
}

/// A format of files, by its extensions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFormat {
    /// Name for the user.
    pub name: String,
    /// Extensions without the leading dot, such as `lif.json`; `*` for any.
    pub extensions: Vec<String>,
}

/// The answer to a [`FileQuestion`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileAnswer {
    /// The user chose this file. The dialog has asked before it replaces one.
    Chosen(PathBuf),
    /// The user chose no file.
    Cancelled,
    /// The desktop showed no dialog.
    NoDialog,
}

/// Waits on another thread for the answer of the user.
pub type PendingFileAnswer = Box<dyn FnOnce() -> FileAnswer + Send>;
