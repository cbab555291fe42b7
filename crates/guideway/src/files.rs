use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, TempDir};

/// Why a file could not be saved.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot write the file: {problem}", .path.display())]
pub struct SaveError {
    /// The file to be saved.
    pub path: PathBuf,
    /// What the operating system said.
    #[source]
    pub problem: io::Error,
}

impl SaveError {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self.problem.kind() {
            io::ErrorKind::NotFound => "Make the folder first, or check its spelling",
            io::ErrorKind::IsADirectory => "Give a file name, not a folder",
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                "Free some room on that disk, or save to another"
            }
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                "Save to a folder that you may write to"
            }
            _ => "Check that the folder is there and may be written",
        }
    }
}

/// Folders with what is being written right now.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of names is whole at any time, so one thread's panic does not spoil it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes a file so that it appears whole or not at all: `write` gets another path, in a temporary
/// folder beside the target, and what it has written there is renamed. A device such as `/dev/null` is
/// written directly.
///
/// # Errors
/// When the folder cannot be written, its disk is full, or `write` fails; then nothing is left behind
/// and a file of the same name is as it was.
pub fn replace_file<T, E: From<SaveError>>(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<T, E>,
) -> Result<T, E> {
    let fail = |problem| SaveError {
        path: path.to_owned(),
        problem,
    };
    match fs::metadata(path) {
        Ok(there) if there.is_dir() => return Err(fail(io::ErrorKind::IsADirectory.into()).into()),
        Ok(there) if !there.is_file() => return write(path),
        _ => {}
    }
    // A link stays a link: what it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let unfinished = Unfinished::begin(&target).map_err(fail)?;
    let result = write(&unfinished.file)?;
    unfinished.rename_to(&target).map_err(fail)?;
    Ok(result)
}

/// Removes whatever [`replace_file`] has not finished, and keeps any file from being begun or finished
/// from then on. For a signal handler's thread, right before it ends the process.
pub fn remove_unfinished() {
    let folders = unfinished();
    for folder in folders.iter() {
        // Another thread may put one more file there in the meantime, so once may not do. Nothing can
        // be done about a folder that does not go away while the process ends.
        let mut tries = (0..3).map(|_| fs::remove_dir_all(folder));
        let _ = tries.any(|result| result.is_ok());
    }
    // Never unlocked: whoever is about to begin or rename a file waits until the process is gone.
    std::mem::forget(folders);
}

/// A file in a temporary folder of its own; both are gone when dropped.
struct Unfinished {
    folder: TempDir,
    file: PathBuf,
}

impl Unfinished {
    fn begin(target: &Path) -> io::Result<Self> {
        let parent = match target.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let missing = || io::Error::new(io::ErrorKind::NotFound, "there is no such folder");
        if !parent.is_dir() {
            return Err(missing());
        }
        let name = target.file_name().ok_or_else(missing)?;
        // Locked before there is a folder, so that none can escape `remove_unfinished`.
        let mut listed = unfinished();
        let folder = Builder::new()
            .prefix(".guideway-")
            .suffix(".part")
            .tempdir_in(parent)?;
        listed.push(folder.path().to_owned());
        let file = folder.path().join(name);
        Ok(Self { folder, file })
    }

    fn rename_to(self, target: &Path) -> io::Result<()> {
        let _listed = unfinished();
        fs::rename(&self.file, target)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        unfinished().retain(|folder| folder != self.folder.path());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(file: &Path, text: &str) -> Result<(), SaveError> {
        fs::write(file, text).map_err(|problem| SaveError {
            path: file.to_owned(),
            problem,
        })
    }

    fn names(folder: &Path) -> Vec<String> {
        let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let entries = fs::read_dir(folder).unwrap();
        entries
            .map(|entry| name(entry).to_string_lossy().into_owned())
            .collect()
    }

    #[test]
    fn a_file_is_replaced_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for text in ["one", "two"] {
            replace_file(&path, |file| put(file, text)).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let fail = |file: &Path| {
            put(file, "new")?;
            Err::<(), _>(SaveError {
                path: file.to_owned(),
                problem: io::ErrorKind::StorageFull.into(),
            })
        };
        let error = replace_file(&path, fail).unwrap_err();
        assert!(error.remedy().contains("room"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_folder_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let error = replace_file(folder.path(), |_| Ok::<(), SaveError>(())).unwrap_err();
        assert!(error.remedy().contains("folder"), "{error}");
    }
}
