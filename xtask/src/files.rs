//! The files below a folder.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// The files below a folder, sorted: their names relative to it, with `/` between the parts, and
/// their paths. Links are files: those of Wine lead to folders of this computer's user.
///
/// # Errors
/// When a folder cannot be read.
pub fn files_below(folder: &Path) -> Result<Vec<(String, PathBuf)>> {
    let mut files = Vec::new();
    let mut next = vec![folder.to_owned()];
    while let Some(inner) = next.pop() {
        for entry in fs::read_dir(&inner).with_context(|| inner.display().to_string())? {
            let entry = entry?;
            let path = entry.path();
            if entry.file_type()?.is_dir() {
                next.push(path);
                continue;
            }
            let parts = path.strip_prefix(folder)?.components();
            let parts = parts.map(|part| part.as_os_str().to_string_lossy());
            let name: Vec<_> = parts.collect();
            files.push((name.join("/"), path));
        }
    }
    files.sort();
    Ok(files)
}
