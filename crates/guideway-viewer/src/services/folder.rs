//! The names in a folder.

use std::fs::{self, DirEntry};
use std::path::Path;

/// Names of the entries of a folder that `accepts` a name, of its first `limit` entries; names of
/// folders end with `/`. Empty without the folder.
pub(crate) fn names_in(folder: &Path, limit: usize, accepts: &dyn Fn(&str) -> bool) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let name = |entry: DirEntry| {
        let name = entry.file_name().into_string().ok()?;
        // A link to a folder is a folder.
        accepts(&name).then(|| match entry.path().is_dir() {
            true => name + "/",
            false => name,
        })
    };
    entries.take(limit).filter_map(name).collect()
}
