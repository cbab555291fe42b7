//! Writes files of the state folder atomically: several windows may write one at once.

use std::fs;
use std::io;
use std::path::Path;

/// Writes a file of the folder, which is created if need be.
///
/// # Errors
/// When folder or file cannot be written; the old file is then unchanged.
pub(crate) fn write_state(folder: &Path, name: &str, text: &str) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let new = folder.join(format!("{name}.{}", std::process::id()));
    let written = fs::write(&new, text).and_then(|()| fs::rename(&new, folder.join(name)));
    if written.is_err() {
        // A part of a file has no use.
        let _ = fs::remove_file(&new);
    }
    written
}
