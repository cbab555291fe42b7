//! The state of a file on disk.

use std::fs;
use std::path::Path;
use std::time::SystemTime;

/// Time and size of a file, which identify its state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStamp {
    /// Time of the last change.
    pub modified: SystemTime,
    /// Size in bytes.
    pub bytes: u64,
}

impl FileStamp {
    /// The state of a file; `None` without a file.
    pub fn of(file: &Path) -> Option<Self> {
        let metadata = fs::metadata(file).ok()?;
        Some(Self {
            modified: metadata.modified().ok()?,
            bytes: metadata.len(),
        })
    }
}
