//! Loads damaged and odd input files by format and name.
//!
//! A folder per format holds `inputs.txt`, an [`Archive`] of small files, and `expect.tsv`, the
//! expected outcome of reading each: file name, tab, and `error` with the code of the error or `ok`
//! with the codes of all diagnostics.
//!
//! To add a file, write `-- NAME --` and its lines into `inputs.txt`, or run
//! `cargo run -p guideway-bad-files -- add FORMAT FILE`, which escapes bytes that are no text; then
//! add its line to `expect.tsv`. `-- unpack FORMAT FOLDER` writes the files for a look with other
//! programs, and `-- pack FORMAT FOLDER` makes the archive anew of the files of a folder.

mod archive;
mod escape;

use std::io::{Error, ErrorKind, Result};
use std::path::{Path, PathBuf};

pub use self::archive::{Archive, ArchiveError};
pub use self::escape::EscapeError;

/// The formats that have a folder; that of `any` holds files of no single format.
pub const FORMATS: [&str; 11] = [
    "any",
    "arrow",
    "dxf",
    "geojson",
    "lanelet2",
    "lif",
    "opendrive",
    "opentcs",
    "rmf",
    "svg",
    "vda5050",
];

/// The folder of a format, for instance `lif`.
pub fn folder(format: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format)
}

/// The path of the archive of a format.
pub fn archive_path(format: &str) -> PathBuf {
    folder(format).join("inputs.txt")
}

/// All input files of a format.
///
/// # Errors
/// When the archive cannot be read or is malformed; the message names its path and line.
pub fn inputs(format: &str) -> Result<Archive> {
    Archive::read(&archive_path(format))
}

/// The bytes of one input file, named by format and name: `lif/valid.json`.
///
/// # Errors
/// As [`inputs`]; when the archive has no file of that name.
pub fn input(path: &str) -> Result<Vec<u8>> {
    let (format, name) = path.split_once('/').unwrap_or(("", path));
    let archive = inputs(format)?;
    let bytes = archive.get(name).ok_or_else(|| {
        let text = format!("{}: no file `{name}`", archive_path(format).display());
        Error::new(ErrorKind::NotFound, text)
    })?;
    Ok(bytes.to_vec())
}
