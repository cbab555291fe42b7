//! The calls of the operating system by which a file is written.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// The calls by which a file is written. [`OsDisk`] makes them; a test lets each of them fail.
pub(super) trait Disk: Send + Sync {
    /// Creates a file that does not exist, for reading and writing. `mode` is that of Unix, before
    /// the umask.
    fn create(&self, path: &Path, mode: u32) -> io::Result<File>;
    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<usize>;
    /// Waits until the bytes of a file are on its disk.
    fn sync(&self, file: &File) -> io::Result<()>;
    /// Closes a file. Network disks and quotas report some errors only here.
    fn close(&self, file: File) -> io::Result<()>;
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Opens a folder for [`Self::sync_folder`]; `None` where the system has no such handle, or the
    /// user may not read the folder.
    fn open_folder(&self, path: &Path) -> io::Result<Option<File>>;
    /// Waits until the names in a folder are on its disk.
    fn sync_folder(&self, folder: &File) -> io::Result<()>;
}

/// The operating system.
pub(super) struct OsDisk;

impl Disk for OsDisk {
    fn create(&self, path: &Path, mode: u32) -> io::Result<File> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, mode);
        #[cfg(not(unix))]
        let _ = mode;
        options.open(path)
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<usize> {
        file.write(bytes)
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    #[cfg_attr(unix, expect(unsafe_code, reason = "no safe function tells the error"))]
    fn close(&self, file: File) -> io::Result<()> {
        #[cfg(unix)]
        // SAFETY: the descriptor is open, and nothing owns it any more.
        unsafe {
            rustix::io::try_close(std::os::fd::IntoRawFd::into_raw_fd(file))?;
        }
        #[cfg(not(unix))]
        drop(file);
        Ok(())
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    fn open_folder(&self, path: &Path) -> io::Result<Option<File>> {
        match cfg!(unix).then(|| File::open(path)).transpose() {
            Err(error) if error.kind() == ErrorKind::PermissionDenied => Ok(None),
            opened => opened,
        }
    }

    fn sync_folder(&self, folder: &File) -> io::Result<()> {
        match folder.sync_all() {
            // Some network disks sync files only.
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::InvalidInput | ErrorKind::Unsupported
                ) =>
            {
                Ok(())
            }
            synced => synced,
        }
    }
}
