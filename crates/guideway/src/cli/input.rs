use std::io::{self, ErrorKind};
use std::path::Path;

use guideway::SaveError;
use guideway::formats::{ReadOptions, read_file};
use guideway::layout::Layout;

use super::{Failure, Output};

/// Reads a layout, showing how far it is. Returns it with the time that it took, in milliseconds.
pub(crate) fn read(path: &Path, out: &Output) -> Result<(Layout, f64), Failure> {
    let activity = out.activity(format!("reading {}", path.display()));
    let options = ReadOptions {
        progress: Some(&activity),
        ..ReadOptions::default()
    };
    let layout = read_file(path, &options)?;
    Ok((layout, activity.finish()))
}

/// Refuses an output that cannot be written or would replace the input, before any long work is done.
pub(crate) fn check_output(input: Option<&Path>, output: &Path) -> Result<(), Failure> {
    let refuse = |kind, why: &'static str| {
        Err(Failure::from(SaveError {
            path: output.to_owned(),
            problem: io::Error::new(kind, why),
        }))
    };
    if output.is_dir() {
        return refuse(ErrorKind::IsADirectory, "this is a folder");
    }
    let folder = output.parent().filter(|folder| *folder != Path::new(""));
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return refuse(ErrorKind::NotFound, "there is no such folder");
    }
    // An output that is not there yet has no canonical path, and cannot be the input.
    match (input.map(Path::canonicalize), output.canonicalize()) {
        (Some(Ok(a)), Ok(b)) if a == b => Err(Failure::same_file(output)),
        _ => Ok(()),
    }
}
