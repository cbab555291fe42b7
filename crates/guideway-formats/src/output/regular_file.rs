//! Opens files that the program itself keeps, such as journals, where others may have put a pipe or
//! a link of the same name.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

use super::place::is_open_file;

/// Opens a regular file for reading and writing.
fn open_regular_file(path: &Path, is_new: bool) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(is_new);
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        let flags = OFlags::NOFOLLOW | OFlags::NONBLOCK;
        options.custom_flags(flags.bits().cast_signed());
    }
    let file = options.open(path)?;
    match file.metadata()?.is_file() {
        true => Ok(file),
        false => Err(io::Error::other("it is no regular file")),
    }
}

/// Opens a regular file for reading and writing, creates it if `is_new` is allowed, and locks it
/// until it is closed. A symbolic link, a pipe or a device of that name is an error, and is neither
/// followed nor waited for.
///
/// # Errors
/// When the file cannot be opened, is no regular file, another program has locked it, or the disk
/// has no locks.
pub fn lock_regular_file(path: &Path, is_new: bool) -> io::Result<File> {
    loop {
        let file = open_regular_file(path, is_new)?;
        file.try_lock()?;
        // Its last owner may have deleted it since it was opened.
        if is_open_file(path, &file) {
            return Ok(file);
        }
    }
}
