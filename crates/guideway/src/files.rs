use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, TempPath};

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

/// Files being written right now, under their temporary names.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // A list of names is whole at any time, so one thread's panic does not spoil it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Writes a file so that it appears whole or not at all: under a temporary name in the same folder,
/// then renamed. A device such as `/dev/null` is written directly.
///
/// # Errors
/// When the folder cannot be written, its disk is full, or `write` fails; then nothing is left behind
/// and a file of the same name is as it was.
pub fn replace_file(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), SaveError> {
    replace(path, write).map_err(|problem| SaveError {
        path: path.to_owned(),
        problem,
    })
}

/// Removes whatever [`replace_file`] has not finished, and keeps any file from being begun or finished
/// from then on. For a signal handler's thread, right before it ends the process.
pub fn remove_unfinished() {
    let files = unfinished();
    for file in files.iter() {
        // Nothing can be done about a file that does not go away while the process ends.
        let _ = fs::remove_file(file);
    }
    // Never unlocked: whoever is about to begin or rename a file waits until the process is gone.
    std::mem::forget(files);
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(target) if target.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(target) if !target.is_file() => {
            let mut device = BufWriter::new(File::options().write(true).open(path)?);
            write(&mut device)?;
            return device.flush();
        }
        _ => {}
    }
    // A link stays a link: what it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let (file, unfinished) = Unfinished::begin(&target)?;
    let mut file = BufWriter::with_capacity(1 << 16, file);
    write(&mut file)?;
    file.into_inner().map_err(io::IntoInnerError::into_error)?;
    unfinished.rename_to(&target)
}

/// A file under its temporary name; gone when dropped.
struct Unfinished(Option<TempPath>);

impl Unfinished {
    fn begin(target: &Path) -> io::Result<(File, Self)> {
        let folder = match target.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        if !folder.is_dir() {
            return Err(io::Error::new(
                io::ErrorKind::NotFound,
                "there is no such folder",
            ));
        }
        let mut builder = Builder::new();
        builder.prefix(".guideway-").suffix(".part");
        #[cfg(unix)]
        {
            // As any new file, rather than private as a temporary one; the umask takes its part.
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        // Locked before there is a file, so that none can escape `remove_unfinished`.
        let mut listed = unfinished();
        let (file, temporary) = builder.tempfile_in(folder)?.into_parts();
        listed.push(temporary.to_path_buf());
        Ok((file, Self(Some(temporary))))
    }

    fn rename_to(mut self, target: &Path) -> io::Result<()> {
        self.end(|temporary| temporary.persist(target).map_err(|e| e.error))
    }

    fn end(&mut self, how: impl FnOnce(TempPath) -> io::Result<()>) -> io::Result<()> {
        let Some(temporary) = self.0.take() else {
            return Ok(());
        };
        let mut listed = unfinished();
        listed.retain(|file| file != &*temporary);
        how(temporary)
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // Nothing can be done here about a file that does not go away.
        let _ = self.end(TempPath::close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            replace_file(&path, |file| file.write_all(text.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), text);
        }
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let fail = |file: &mut dyn Write| {
            file.write_all(b"new")?;
            Err(io::ErrorKind::StorageFull.into())
        };
        let error = replace_file(&path, fail).unwrap_err();
        assert!(error.remedy().contains("room"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_folder_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let error = replace_file(folder.path(), |_| Ok(())).unwrap_err();
        assert!(error.remedy().contains("folder"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn a_full_device_is_an_error_and_stays_a_device() {
        let full = Path::new("/dev/full");
        if full.exists() {
            let error = replace_file(full, |file| file.write_all(b"x")).unwrap_err();
            assert_eq!(error.problem.kind(), io::ErrorKind::StorageFull);
            assert!(full.exists());
        }
    }
}
