//! Writes files atomically: a file appears whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, TempDir};

/// A file was not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot write the file: {problem}", .path.display())]
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
        match self.problem.kind() {
            io::ErrorKind::NotFound => "Create the folder first, or check its spelling",
            io::ErrorKind::IsADirectory => "Give a file name, not a folder",
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                "Free some room on that disk, or save to another"
            }
            io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
                "Save to a folder that you may write to"
            }
            _ => "Check that the folder exists and that you may write to it",
        }
    }
}

/// Temporary folders of the files that are being written.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // The list is complete at any time, so the panic of another thread does not spoil it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes a file atomically: `write` receives a path in a temporary folder beside the target, and
/// the file that it writes there is renamed to the target. A device such as `/dev/null` is written
/// directly.
///
/// # Errors
/// When the folder cannot be written, its disk is full, or `write` fails. The temporary folder is
/// then removed, and an existing target is unchanged.
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
    // A symbolic link stays one: the file that it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let unfinished = Unfinished::begin(&target).map_err(fail)?;
    let result = write(&unfinished.file)?;
    unfinished.rename_to(&target).map_err(fail)?;
    Ok(result)
}

/// Removes the files that [`replace_file`] has not finished, and blocks every thread that begins or
/// finishes one from then on. For the thread of a signal handler, right before it ends the process.
pub fn remove_unfinished() {
    let folders = unfinished();
    for folder in folders.iter() {
        // Another thread may create a file in the folder meanwhile, so one attempt may fail. A
        // folder that survives three attempts stays: the process ends.
        let mut tries = (0..3).map(|_| fs::remove_dir_all(folder));
        let _ = tries.any(|result| result.is_ok());
    }
    // Never unlocked: a thread that begins or renames a file waits until the process ends.
    std::mem::forget(folders);
}

/// A file in a temporary folder. Dropping it removes both.
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
        let missing = || io::Error::new(io::ErrorKind::NotFound, "the folder does not exist");
        if !parent.is_dir() {
            return Err(missing());
        }
        let name = target.file_name().ok_or_else(missing)?;
        // Locked before the folder exists, so that `remove_unfinished` misses none.
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
    fn replaces_an_existing_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for text in ["one", "two"] {
            replace_file(&path, |file| put(file, text)).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn failure_keeps_the_old_file_and_no_temporary_one() {
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
    fn rejects_a_folder_as_target() {
        let folder = tempfile::tempdir().unwrap();
        let error = replace_file(folder.path(), |_| Ok::<(), SaveError>(())).unwrap_err();
        assert!(error.remedy().contains("folder"), "{error}");
    }
}
