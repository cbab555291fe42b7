//! The place of an output file: links are followed, folders and protected files are refused.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Symbolic links that are followed one after the other, as Linux does.
const MAX_LINKS: usize = 40;

/// The thing at the path of an output file.
pub(super) enum Place {
    /// A device or a pipe, to which bytes go directly.
    Stream(File),
    /// Nothing.
    Absent(PathBuf),
    /// A file, open for writing.
    Existing(Existing),
}

/// A file that is to be replaced.
pub(super) struct Existing {
    /// Its path without symbolic links.
    pub(super) path: PathBuf,
    pub(super) file: File,
    #[cfg_attr(
        target_family = "wasm",
        expect(dead_code, reason = "files there have neither rights nor owners")
    )]
    pub(super) metadata: Metadata,
}

impl Place {
    /// Looks at the path of an output file.
    pub(super) fn find(path: &Path) -> io::Result<Self> {
        let write = |path: &Path| OpenOptions::new().write(true).open(path);
        if cfg!(windows) && is_device_of_windows(path) {
            return Ok(Self::Stream(write(path)?));
        }
        match fs::metadata(path) {
            Ok(there) if there.is_dir() => Err(ErrorKind::IsADirectory.into()),
            Ok(there) if !there.is_file() => Ok(Self::Stream(write(path)?)),
            Ok(there) if there.permissions().readonly() => {
                // The administrator could write it nevertheless, and a rename would replace it.
                let reason = "the file is write-protected";
                Err(io::Error::new(ErrorKind::PermissionDenied, reason))
            }
            Ok(_) => {
                let path = fs::canonicalize(path)?;
                let file = write(&path)?;
                let metadata = file.metadata()?;
                Ok(Self::Existing(Existing {
                    path,
                    file,
                    metadata,
                }))
            }
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(Self::Absent(end(path)?)),
            Err(error) => Err(error),
        }
    }
}

/// Returns `true` if Windows takes a path for a device: `NUL` or `CON` in any folder, or a path
/// below `\\.\`. It calls them files when asked.
fn is_device_of_windows(path: &Path) -> bool {
    let names = ["NUL", "CON", "NUL:", "CON:"];
    let name = path.file_name().unwrap_or_default();
    let is_name = names.iter().any(|device| name.eq_ignore_ascii_case(device));
    is_name || path.as_os_str().as_encoded_bytes().starts_with(br"\\.\")
}

/// The end of a chain of symbolic links to a file that does not exist.
fn end(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        match fs::read_link(&path) {
            Ok(to) => path = folder(&path).join(to),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// The folder of a file.
pub(super) fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Returns `true` if two paths lead to one existing file, by device and file number: links and
/// second mounts have other names.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    same_file::is_same_file(a, b).unwrap_or(false)
}

/// Returns `true` if a path leads to this open file.
pub(super) fn is_open_file(path: &Path, file: &File) -> bool {
    let open = file.try_clone().and_then(same_file::Handle::from_file);
    let named = same_file::Handle::from_path(path);
    matches!((open, named), (Ok(open), Ok(named)) if open == named)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_the_devices_of_windows() {
        for device in ["NUL", "nul", "a/CON", "nul:", r"\\.\COM1"] {
            assert!(is_device_of_windows(Path::new(device)), "{device}");
        }
        for file in ["NUL.png", "annul", "a/NULL", "con/site.png", r"\\server\a"] {
            assert!(!is_device_of_windows(Path::new(file)), "{file}");
        }
    }
}
