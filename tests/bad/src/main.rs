//! Adds files to the archive of a format, or unpacks or packs all of it:
//! `cargo run -p guideway-bad-files -- add FORMAT FILE...`, `... -- unpack FORMAT FOLDER`.

use std::fs;
use std::io::{Error, Result};
use std::path::{Path, PathBuf};

use guideway_bad_files::{Archive, archive_path, inputs};

fn main() -> Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    match args[..] {
        ["add", format, ref files @ ..] if !files.is_empty() => add(format, files),
        ["unpack", format, folder] => unpack(format, Path::new(folder)),
        ["pack", format, folder] => pack(format, Path::new(folder)),
        _ => Err(Error::other(
            "usage: add FORMAT FILE... | unpack FORMAT FOLDER | pack FORMAT FOLDER",
        )),
    }
}

fn add(format: &str, files: &[&str]) -> Result<()> {
    write(format, inputs(format)?, files.iter().map(PathBuf::from))
}

fn pack(format: &str, folder: &Path) -> Result<()> {
    let files = fs::read_dir(folder)?.map(|file| Ok(file?.path()));
    let files: Vec<PathBuf> = files.collect::<Result<_>>()?;
    write(format, inputs(format)?.emptied(), files)
}

/// Writes an archive with more files.
fn write(
    format: &str,
    mut archive: Archive,
    files: impl IntoIterator<Item = PathBuf>,
) -> Result<()> {
    for file in files {
        let name = file.file_name().unwrap_or_default();
        let name = name.to_string_lossy();
        if !archive.insert(&name, fs::read(&file)?) {
            let path = archive_path(format);
            return Err(Error::other(format!(
                "{}: {} has a file `{name}`, or the name has characters other than letters, \
                 digits and `-._`; rename the file",
                file.display(),
                path.display()
            )));
        }
    }
    fs::write(archive_path(format), archive.to_string())
}

fn unpack(format: &str, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    for (name, bytes) in inputs(format)?.iter() {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
