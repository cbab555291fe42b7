use std::path::Path;

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

/// Refuses an output that would replace the input, before any work is done.
pub(crate) fn refuse_same_file(input: &Path, output: &Path) -> Result<(), Failure> {
    // An output that is not there yet has no canonical path, and cannot be the input.
    match (input.canonicalize(), output.canonicalize()) {
        (Ok(a), Ok(b)) if a == b => Err(Failure::same_file(output)),
        _ => Ok(()),
    }
}
