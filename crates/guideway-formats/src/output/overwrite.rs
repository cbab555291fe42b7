//! Writes into the old file, where a rename would cut its other names, change its owner, or is
//! impossible because the file is mounted singly.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

use guideway_layout::shown_path;

use super::disk::Disk;
use super::place::Existing;

/// Bytes per step.
const STEP_BYTES: usize = 1 << 16;

/// Replaces the content of a file with that of another. The room is reserved first.
///
/// # Errors
/// When the disk fails. If the old content is then damaged, the new one is kept beside it, and the
/// error names that file.
pub(super) fn overwrite(disk: &dyn Disk, mut old: Existing, new: &mut File) -> io::Result<()> {
    reserve(&old.file, new.metadata()?.len())?;
    let path = old.path.clone();
    write(disk, &mut old.file, new)
        .and_then(|()| disk.sync(&old.file))
        .and_then(|()| disk.close(old.file))
        .map_err(|problem| rescue(problem, &path, new))
}

fn write(disk: &dyn Disk, old: &mut File, new: &mut File) -> io::Result<()> {
    new.rewind()?;
    let mut buffer = vec![0; STEP_BYTES];
    let mut length = 0;
    loop {
        let mut rest = match new.read(&mut buffer)? {
            0 => return old.set_len(length),
            read => &buffer[..read],
        };
        while !rest.is_empty() {
            let written = disk.write(old, rest)?;
            if written == 0 {
                return Err(ErrorKind::WriteZero.into());
            }
            rest = &rest[written..];
            length += written as u64;
        }
    }
}

/// Asks the disk for the room of the new content, so that it is not full halfway.
fn reserve(file: &File, bytes: u64) -> io::Result<()> {
    #[cfg(target_os = "linux")]
    if bytes > 0 {
        use rustix::fs::{FallocateFlags, fallocate};
        use rustix::io::Errno;
        match fallocate(file, FallocateFlags::KEEP_SIZE, 0, bytes) {
            // Some disks cannot reserve.
            Ok(()) | Err(Errno::NOTSUP | Errno::NOSYS | Errno::INVAL) => {}
            Err(error) => return Err(error.into()),
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (file, bytes);
    Ok(())
}

/// Keeps the new content in a file of its own.
fn rescue(problem: io::Error, path: &Path, new: &mut File) -> io::Error {
    let beside = |folder: &Path| {
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".rescued");
        folder.join(name)
    };
    let keep = |to: PathBuf, new: &mut File| {
        new.rewind()?;
        let mut file = File::create_new(&to)?;
        io::copy(new, &mut file)?;
        file.sync_all().map(|()| to)
    };
    let folder = super::place::folder(path);
    let kept = keep(beside(folder), new).or_else(|_| keep(beside(&std::env::temp_dir()), new));
    let said = match kept {
        Ok(kept) => format!("the new content is whole in {}", shown_path(&kept)),
        Err(error) => format!("the new content could not be kept either: {error}"),
    };
    // A file that had the old content to its end may have lost it.
    let damage = match fs::metadata(path) {
        Ok(_) => "the file may be damaged",
        Err(_) => "the file is gone",
    };
    io::Error::new(problem.kind(), format!("{problem}; {damage}, but {said}"))
}
