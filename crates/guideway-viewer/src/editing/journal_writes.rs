//! Writes of a journal and its base to a disk that may be full: each is there whole, or not at all.

use std::fs::{self, File, Metadata, Permissions};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use guideway_compose::lock_regular_file;

use super::journal_header::header;

/// Creates and locks a journal for the present state of a layout file, without entries.
pub(super) fn create(journal: &Path, layout_file: &Path) -> io::Result<File> {
    let header = header(layout_file, 0)?;
    let mut file = lock_regular_file(journal, true)?;
    if file.metadata()?.len() > 0 {
        let reason = "another window left unsaved work in it";
        return Err(io::Error::new(ErrorKind::ResourceBusy, reason));
    }
    let written = fs::metadata(layout_file)
        .and_then(|layout| file.set_permissions(permissions(&layout)))
        .and_then(|()| file.write_all(&header));
    or_remove(written, journal)?;
    Ok(file)
}

/// Writes the content of a file, which no longer has a name, under a name again.
pub(super) fn rewrite(vanished: &mut File, journal: &Path) -> io::Result<File> {
    let mut file = lock_regular_file(journal, true)?;
    let permissions = vanished.metadata()?.permissions();
    let written = file
        .set_permissions(permissions)
        .and_then(|()| vanished.rewind())
        .and_then(|()| io::copy(vanished, &mut file));
    or_remove(written, journal)?;
    Ok(file)
}

/// Removes a journal of which only a part was written.
pub(super) fn or_remove<T>(written: io::Result<T>, journal: &Path) -> io::Result<T> {
    written.inspect_err(|_| {
        // It may be gone.
        let _ = fs::remove_file(journal);
    })
}

/// Appends to a journal all or nothing: behind a part of an entry nothing is replayed.
pub(super) fn append(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    let end = file.seek(SeekFrom::End(0))?;
    file.write_all(bytes).inspect_err(|_| {
        // The error of the write is the one to tell.
        let _ = file.set_len(end);
    })
}

/// Copies a file whole or not at all. A link of the name of the copy is replaced, not followed.
pub(super) fn copy(from: &Path, to: &Path) -> io::Result<()> {
    let new = with_suffix(to, "-new");
    // Left by a run that was killed.
    let _ = fs::remove_file(&new);
    let (mut source, mut target) = (File::open(from)?, File::create_new(&new)?);
    let copied = target
        .set_permissions(permissions(&source.metadata()?))
        .and_then(|()| io::copy(&mut source, &mut target))
        .and_then(|_| fs::rename(&new, to));
    if copied.is_err() {
        let _ = fs::remove_file(&new);
    }
    copied
}

/// The permissions of a file that tells of a layout: nobody reads it who may not read the layout,
/// and this user may write it.
fn permissions(of_layout: &Metadata) -> Permissions {
    let mut permissions = of_layout.permissions();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        permissions.set_mode(permissions.mode() | 0o600);
    }
    #[cfg(not(unix))]
    permissions.set_readonly(false);
    permissions
}

/// The name of a file with a suffix behind it.
pub(super) fn with_suffix(file: &Path, suffix: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}
