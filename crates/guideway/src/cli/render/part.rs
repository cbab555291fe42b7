//! Reads the part of a large file that a view shows.

use guideway::formats::{BYTES_READ, FILE_BYTES};
use guideway::layout::{Layout, UserError};

use super::args::{Args, RenderOptions};
use crate::cli::input;
use crate::cli::output::Output;

/// Bytes of a file that were read, and all.
#[derive(Clone, Copy, Debug)]
pub(super) struct BytesRead {
    pub(super) read: u64,
    pub(super) all: u64,
}

impl BytesRead {
    /// Those of a layout that was read in part.
    pub(super) fn of(layout: &Layout) -> Option<Self> {
        let count = |name| layout.provenance.count(name);
        let (read, all) = (count(BYTES_READ)?, count(FILE_BYTES)?);
        Some(Self { read, all })
    }
}

/// Reads the files; of one file and a view with a center and a scale, the paths near the view only,
/// where the others make no difference to the picture. Returns the layout and the time in
/// milliseconds.
pub(super) fn read(
    args: &Args,
    options: &RenderOptions,
    out: &Output,
) -> Result<(Layout, f64), UserError> {
    let [input] = &args.inputs[..] else {
        return input::read_all(&args.inputs, out);
    };
    // A pipe could not be read again.
    let can_skip = input.path.is_file() && !input::is_stdin(&input.path) && !input.is_placed();
    let area = args.area(options).filter(|_| can_skip);
    if area.is_none() {
        return input::read_all(&args.inputs, out);
    }
    let (layout, part_ms) = input::read_area(input, area, out)?;
    if BytesRead::of(&layout).is_none() || !depends_on_all(&layout) {
        return Ok((layout, part_ms));
    }
    let (layout, all_ms) = input::read_all(&args.inputs, out)?;
    Ok((layout, part_ms + all_ms))
}

/// Returns `true` if a picture of some paths depends on the others: a note tells of levels over
/// each other, and structure is gray where there are paths beside it. A table of paths says which
/// levels there are by its paths, a network does by rows of their own.
fn depends_on_all(layout: &Layout) -> bool {
    let is_network = layout.provenance.format_version != "1";
    let may_have_levels = match is_network {
        true => layout.levels.len() > 1,
        false => !layout.levels.is_empty(),
    };
    may_have_levels || layout.paths.column("element").is_some()
}
