//! The unfinished file of an output: beside the target, locked while its process lives, so that a
//! later run sweeps the files of runs that were killed.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::disk::Disk;

const PREFIX: &str = ".guideway-";
const SUFFIX: &str = ".part";
/// Names that are tried before a folder counts as unusable.
const MAX_NAMES: usize = 1000;

/// The files that are being written.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    // The list is complete at any time, so the panic of another thread does not spoil it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the files that are being written, and blocks every thread that begins or finishes one
/// from then on. For the thread of a signal handler, right before it ends the process.
pub fn remove_unfinished() {
    remove_all(unfinished());
}

/// As [`remove_unfinished`], for a process that ends at any place in its code: removes nothing if a
/// file is being begun or finished at this moment, maybe by this thread.
pub fn try_remove_unfinished() {
    if let Ok(files) = UNFINISHED.try_lock() {
        remove_all(files);
    }
}

fn remove_all(files: MutexGuard<'static, Vec<PathBuf>>) {
    for file in files.iter() {
        // A file that cannot be removed stays: the process ends.
        let _ = fs::remove_file(file);
    }
    // Never unlocked: a thread that begins or renames a file waits until the process ends.
    std::mem::forget(files);
}

/// An unfinished file. Dropping it removes the file.
pub(super) struct Part {
    path: PathBuf,
    /// Keeps the lock until the file is at its place, also after the file was closed.
    lock: File,
}

impl Part {
    /// Sweeps a folder and creates a file in it.
    pub(super) fn create(disk: &dyn Disk, folder: &Path, mode: u32) -> io::Result<(Self, File)> {
        sweep(folder);
        // Locked before the file exists, so that `remove_unfinished` misses none.
        let mut listed = unfinished();
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        for _ in 0..MAX_NAMES {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!("{PREFIX}{}-{number}{SUFFIX}", process::id()));
            let file = match disk.create(&path, mode) {
                Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
                result => result?,
            };
            // A disk without locks keeps its stale files.
            let is_lost = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
            if is_lost || is_swept(&file) {
                // Another process took it for a stale one, and removes it.
                continue;
            }
            let lock = file.try_clone().inspect_err(|_| {
                // A later run sweeps a file that cannot be removed.
                let _ = fs::remove_file(&path);
            })?;
            listed.push(path.clone());
            return Ok((Self { path, lock }, file));
        }
        Err(io::Error::other("the folder has no free name"))
    }

    /// The content, for reading.
    pub(super) fn file(&mut self) -> &mut File {
        &mut self.lock
    }

    /// Moves the file to its place.
    pub(super) fn rename(&self, disk: &dyn Disk, to: &Path) -> io::Result<()> {
        let mut listed = unfinished();
        disk.rename(&self.path, to)?;
        listed.retain(|file| *file != self.path);
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        let mut listed = unfinished();
        if listed.contains(&self.path) {
            listed.retain(|file| *file != self.path);
            // A later run sweeps a file that cannot be removed.
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Removes the unfinished files of processes that ended. What cannot be read or removed stays.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_part = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
        if !is_part || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let Ok(file) = OpenOptions::new().write(true).open(entry.path()) else {
            continue;
        };
        if file.try_lock().is_ok() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Returns `true` if another process swept the file before it was locked.
fn is_swept(file: &File) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        file.metadata().is_ok_and(|file| file.nlink() == 0)
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        false
    }
}
