//! The journal of finished tiles beside the output: opened before tiles are made, removed when the
//! output is whole.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use guideway::formats::lock_regular_file;
use guideway::layout::{UserError, shown_path};
use guideway::tiles::Journal;

use super::args::Args;
use crate::cli::input::is_stdin;

/// A journal and its name.
pub(super) struct Unfinished {
    path: PathBuf,
    pub(super) journal: Journal,
}

impl Unfinished {
    /// Opens the journal of a run. One of other files, options or another version begins anew.
    ///
    /// # Errors
    /// When the file cannot be opened or read, or another run has locked it.
    pub(super) fn open(args: &Args) -> Result<Self, UserError> {
        let mut name = args.output.clone().into_os_string();
        name.push(".unfinished");
        let path = PathBuf::from(name);
        let fail = |what: String| {
            let message = format!("{}: {what}", shown_path(&path));
            let remedy = "Wait for the other run if there is one, or check that the folder of the \
                          output can be written";
            UserError::new("journal", message, remedy)
        };
        let file = lock_regular_file(&path, true).map_err(|error| fail(error.to_string()))?;
        let journal = Journal::open(file, key(args)).map_err(|error| fail(error.to_string()))?;
        Ok(Self { path, journal })
    }

    /// Removes the journal, after the output was written.
    pub(super) fn remove(self) {
        // The next run finds a journal that cannot be removed, and it is whole.
        let _ = fs::remove_file(&self.path);
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if self.journal.is_empty() {
            // Nothing is lost with it, so an error of the arguments leaves no file.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// A number that differs between runs of different tiles.
fn key(args: &Args) -> u64 {
    let mut hasher = DefaultHasher::new();
    env!("CARGO_PKG_VERSION").hash(&mut hasher);
    // All options: their names and values.
    format!("{args:?}").hash(&mut hasher);
    args.files().for_each(|file| hash_state(file, &mut hasher));
    hasher.finish()
}

/// Adds what changes when a file is written.
fn hash_state(file: &Path, hasher: &mut DefaultHasher) {
    if is_stdin(file) {
        // Nobody knows whether it is the same again.
        SystemTime::now().hash(hasher);
    }
    let Ok(metadata) = fs::metadata(file) else {
        return;
    };
    metadata.len().hash(hasher);
    metadata.modified().ok().hash(hasher);
}
