//! [`SaveError`]: the file that was not written, and the error of the operating system.

use std::io;
use std::path::PathBuf;

use guideway_layout::{UserError, shown_path};

/// A file was not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot write the file: {problem}", shown_path(.path))]
pub struct SaveError {
    /// The target file.
    pub path: PathBuf,
    /// The error of the operating system.
    #[source]
    pub problem: io::Error,
}

impl SaveError {
    /// Advice for the user.
    pub fn remedy(&self) -> &'static str {
        Self::remedy_of(&self.problem)
    }

    /// Advice on an error of a file that is written.
    pub(crate) fn remedy_of(problem: &io::Error) -> &'static str {
        match problem.kind() {
            io::ErrorKind::NotFound => "Create the folder first, or check its spelling",
            io::ErrorKind::IsADirectory => "Give a file name, not a folder",
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                "Free some room on that disk, or save to another"
            }
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                "Make file and folder writable, or save under another name or in another folder"
            }
            io::ErrorKind::FileTooLarge => {
                "Raise the limit with `--limit output-bytes=N` if this size is intended; else save \
                 fewer paths, or in a more compact format, such as Arrow"
            }
            io::ErrorKind::InvalidData => {
                "Correct or remove the element; a file with it could not be read back"
            }
            _ => {
                "Check that the disk is sound, that the folder exists, and that you may write to it"
            }
        }
    }
}

impl From<SaveError> for UserError {
    fn from(error: SaveError) -> Self {
        let remedy = error.remedy();
        Self::new("save", error.to_string(), remedy)
    }
}
