//! Gives a new file the owner, the permissions and the extended attributes of the old one.

use std::fs::File;
use std::io;

use super::place::Existing;

/// Mode of a new file, before the umask.
pub(super) const NEW_FILE_MODE: u32 = 0o666;

/// The mode to create the successor of a file with: nobody else may read it meanwhile.
#[cfg(unix)]
pub(super) fn mode(old: &Existing) -> u32 {
    use std::os::unix::fs::MetadataExt;
    (old.metadata.mode() & 0o777) | 0o600
}

#[cfg(not(unix))]
pub(super) fn mode(_: &Existing) -> u32 {
    NEW_FILE_MODE
}

/// Returns `true` if the file has other names, which would keep the old content after a rename.
#[cfg(unix)]
pub(super) fn has_other_names(old: &Existing) -> bool {
    use std::os::unix::fs::MetadataExt;
    old.metadata.nlink() > 1
}

#[cfg(not(unix))]
pub(super) fn has_other_names(_: &Existing) -> bool {
    false
}

/// Copies owner, permissions and extended attributes.
///
/// # Errors
/// When the user may not set one of them.
#[cfg(unix)]
pub(super) fn copy(old: &Existing, new: &File) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, fchown};
    let (from, to) = (&old.metadata, new.metadata()?);
    if (from.uid(), from.gid()) != (to.uid(), to.gid()) {
        fchown(new, Some(from.uid()), Some(from.gid()))?;
    }
    #[cfg(target_os = "linux")]
    attributes::copy(&old.file, new)?;
    // Last: a change of the owner clears some permissions.
    new.set_permissions(from.permissions())
}

#[cfg(not(unix))]
pub(super) fn copy(_: &Existing, _: &File) -> io::Result<()> {
    Ok(())
}

#[cfg(target_os = "linux")]
mod attributes {
    use std::fs::File;
    use std::io;

    use rustix::fs::{XattrFlags, fgetxattr, flistxattr, fsetxattr};
    use rustix::io::Errno;

    /// Largest list of names, and largest value: the limits of Linux.
    const MAX_BYTES: usize = 64 << 10;

    pub(super) fn copy(old: &File, new: &File) -> io::Result<()> {
        let mut names = vec![0; MAX_BYTES];
        let length = match flistxattr(old, &mut names[..]) {
            Err(Errno::NOTSUP | Errno::NOSYS) => return Ok(()),
            length => length?,
        };
        let mut value = vec![0; MAX_BYTES];
        for name in names[..length].split(|byte| *byte == 0) {
            if name.is_empty() {
                continue;
            }
            let read = fgetxattr(old, name, &mut value[..]);
            let copied =
                read.and_then(|length| fsetxattr(new, name, &value[..length], XattrFlags::empty()));
            // Only the administrator sets these, and the folder gives them to new files.
            let is_of_system = name.starts_with(b"security.") || name.starts_with(b"trusted.");
            if !is_of_system {
                copied?;
            }
        }
        Ok(())
    }
}
