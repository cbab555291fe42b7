//! [`NewFile`]: a file under construction, which replaces its target when it is whole.

use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use super::disk::{Disk, OsDisk};
use super::overwrite::overwrite;
use super::part::Part;
use super::place::{Existing, Place, folder};
use super::{SaveError, metadata};

/// Bytes that are collected before they are written.
const BUFFER_BYTES: usize = 1 << 16;

/// A file under construction. [`Self::commit`] puts it in the place of its target; dropped before,
/// it leaves the target unchanged and nothing else behind. A device such as `/dev/null` is written
/// directly.
///
/// An existing target keeps its owner, permissions, extended attributes, symbolic and hard links. A
/// write-protected one is refused.
pub struct NewFile {
    /// The target, as named by the caller.
    path: PathBuf,
    goal: Goal,
    out: BufWriter<Bytes>,
    bytes: u64,
    max_bytes: u64,
    /// The first error of a write, as the writers of formats wrap it.
    failure: Option<io::Error>,
}

/// The use of the bytes at the end.
enum Goal {
    /// They are where they belong.
    Stream,
    Create(Part, PathBuf),
    Replace(Part, Existing),
    /// The folder takes no second file.
    Overwrite(Part, Existing),
}

/// The open file.
struct Bytes {
    file: File,
    disk: &'static dyn Disk,
}

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.disk.write(&mut self.file, bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl NewFile {
    /// Begins a file that replaces `path`.
    ///
    /// # Errors
    /// When the folder does not exist or cannot be written, or when the target is a folder or
    /// write-protected.
    pub fn create(path: &Path) -> Result<Self, SaveError> {
        Self::create_on(&OsDisk, path)
    }

    pub(super) fn create_on(disk: &'static dyn Disk, path: &Path) -> Result<Self, SaveError> {
        let begun = Goal::begin(disk, path).map_err(|problem| SaveError {
            path: path.to_owned(),
            problem,
        });
        let (goal, file) = begun?;
        Ok(Self {
            path: path.to_owned(),
            goal,
            out: BufWriter::with_capacity(BUFFER_BYTES, Bytes { file, disk }),
            bytes: 0,
            max_bytes: u64::MAX,
            failure: None,
        })
    }

    /// Sets the largest size of the file in bytes. By default there is no limit.
    pub fn set_limit(&mut self, max_bytes: u64) {
        self.max_bytes = max_bytes;
    }

    /// The target.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Bytes written so far.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Waits until all bytes are on the disk, then replaces the target.
    ///
    /// # Errors
    /// When the disk fails or is full; the target is then unchanged, or, if only the new name could
    /// not be brought to the disk, new and whole, which the error says.
    pub fn commit(mut self) -> Result<(), SaveError> {
        if let Some(failure) = self.take_failure() {
            return Err(failure);
        }
        let path = self.path;
        let committed = match self.out.into_inner() {
            Ok(Bytes { file, disk }) => self.goal.reach(disk, file),
            Err(error) => Err(error.into_error()),
        };
        committed.map_err(|problem| SaveError { path, problem })
    }

    /// The first error of a write.
    pub(super) fn take_failure(&mut self) -> Option<SaveError> {
        let path = || self.path.clone();
        self.failure.take().map(|problem| SaveError {
            path: path(),
            problem,
        })
    }

    fn note_failure<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        if let Err(error) = &result
            && self.failure.is_none()
            && error.kind() != ErrorKind::Interrupted
        {
            let same = error.raw_os_error().map(io::Error::from_raw_os_error);
            self.failure = same.or_else(|| Some(io::Error::new(error.kind(), error.to_string())));
        }
        result
    }

    fn check_limit(&self, more: usize) -> io::Result<()> {
        match self.bytes.saturating_add(more as u64) <= self.max_bytes {
            true => Ok(()),
            false => Err(io::Error::new(
                ErrorKind::FileTooLarge,
                format!("larger than the limit of {} bytes", self.max_bytes),
            )),
        }
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.check_limit(bytes.len());
        let written = written.and_then(|()| self.out.write(bytes));
        let written = self.note_failure(written)?;
        self.bytes += written as u64;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.out.flush();
        self.note_failure(flushed)
    }
}

impl Goal {
    fn begin(disk: &'static dyn Disk, path: &Path) -> io::Result<(Self, File)> {
        match Place::find(path)? {
            Place::Stream(file) => Ok((Self::Stream, file)),
            Place::Absent(target) => {
                let folder = folder(&target);
                if !folder.is_dir() {
                    let reason = "the folder does not exist";
                    return Err(io::Error::new(ErrorKind::NotFound, reason));
                }
                let (part, file) = Part::create(disk, folder, metadata::NEW_FILE_MODE)?;
                Ok((Self::Create(part, target), file))
            }
            Place::Existing(old) => {
                let mode = metadata::mode(&old);
                match Part::create(disk, folder(&old.path), mode) {
                    Ok((part, file)) => Ok((Self::Replace(part, old), file)),
                    Err(error) if is_refused(&error) => {
                        let (part, file) = Part::create(disk, &std::env::temp_dir(), 0o600)?;
                        Ok((Self::Overwrite(part, old), file))
                    }
                    Err(error) => Err(error),
                }
            }
        }
    }

    fn reach(self, disk: &dyn Disk, file: File) -> io::Result<()> {
        match self {
            Self::Stream => disk.close(file),
            Self::Create(part, target) => {
                disk.sync(&file)?;
                disk.close(file)?;
                move_to(disk, &part, &target)
            }
            Self::Replace(mut part, old) => {
                if metadata::has_other_names(&old) || metadata::copy(&old, &file).is_err() {
                    return overwrite(disk, old, part.file());
                }
                disk.sync(&file)?;
                disk.close(file)?;
                match move_to(disk, &part, &old.path) {
                    Err(error) if is_refused(&error) => overwrite(disk, old, part.file()),
                    moved => moved,
                }
            }
            Self::Overwrite(mut part, old) => overwrite(disk, old, part.file()),
        }
    }
}

/// Returns `true` if a folder refuses a new file, or a file refuses to be replaced: its folder is
/// protected, or it is mounted singly.
fn is_refused(error: &io::Error) -> bool {
    let kinds = [
        ErrorKind::PermissionDenied,
        ErrorKind::ResourceBusy,
        ErrorKind::CrossesDevices,
    ];
    kinds.contains(&error.kind()) || error.kind() == ErrorKind::ReadOnlyFilesystem
}

/// Moves a whole file to its place and waits until its name is on the disk. The folder is opened
/// before, so that a disk that fails by then leaves the old file.
fn move_to(disk: &dyn Disk, part: &Part, target: &Path) -> io::Result<()> {
    let folder = disk.open_folder(folder(target))?;
    part.rename(disk, target)?;
    let synced = folder.map_or(Ok(()), |folder| disk.sync_folder(&folder));
    // An error, though the file is readable: a script that goes on to delete the source has to know
    // that the file may be gone after a power cut.
    synced.map_err(|problem| {
        // Not of a kind that lets the caller write the file once more.
        io::Error::other(format!(
            "{problem}; the new file is whole and in its place, but its disk did not confirm that: \
             after a power cut the old state may be back"
        ))
    })
}

/// Writes a file by `write` and replaces `path` with it: see [`NewFile`]. An error of the disk
/// takes the place of what `write` makes of it.
///
/// # Errors
/// When the file cannot be written, or `write` fails; an existing target is then unchanged.
pub fn replace_file<T, E: From<SaveError>>(
    path: &Path,
    write: impl FnOnce(&mut NewFile) -> Result<T, E>,
) -> Result<T, E> {
    let mut file = NewFile::create(path)?;
    match write(&mut file) {
        Ok(result) => {
            file.commit()?;
            Ok(result)
        }
        Err(error) => Err(file.take_failure().map_or(error, E::from)),
    }
}
