//! LIF writers: a save of a file changes its edited parts only; any other layout is written as a
//! whole, one line per node, edge and station, in batches on all cores.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | prepare | layout | levels, nodes, path ends, edges | `network`, `edges` |
//! | convert | rows of the layout | JSON objects | `elements`, `levels`, `columns`, `actions` |
//! | write | objects | text | `file`, `options` |
//! | account | layout | losses | `losses` |

mod actions;
mod columns;
mod edges;
mod elements;
mod file;
mod levels;
mod losses;
mod network;
mod options;

use std::io::{self, Write};

use guideway_layout::Layout;

use super::save;
use super::version::Version;
use crate::Losses;
use crate::finite::check_finite;
use crate::source::WrittenPaths;

pub(super) use self::edges::{EdgeGroups, EdgeRef, Edges};
pub(super) use self::elements::{Elements, add_missing};
pub(super) use self::losses::{add_between_levels, add_lost, add_required};
pub(super) use self::network::{Network, level_of, path_types};
pub use self::options::WriteOptions;

/// Writes a layout: levels as layouts, nodes, stations, and paths as edges. Returns the losses.
///
/// If the layout was read from a file of the same version, the file stays as it is, byte by byte,
/// except for the parts that were edited. Else a path that is not the straight line between its
/// nodes has a trajectory: the curve of its source, or the same curve with clamped knots. Positions
/// have a resolution of one micrometer.
///
/// # Errors
/// When `out` fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> io::Result<Losses> {
    write_watched(layout, out, options, &WrittenPaths::unwatched())
}

/// Writes as [`write_layout`] does, and counts the paths.
pub(crate) fn write_watched(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
    written_paths: &WrittenPaths<'_>,
) -> io::Result<Losses> {
    check_finite(layout)?;
    let is_same_version = Version::of_layout(layout) == Some(options.version);
    let progress = written_paths.progress();
    if is_same_version && let Some(losses) = save::save(layout, out, options.version, progress)? {
        return Ok(losses);
    }
    file::write_file(layout, out, options, written_paths)
}
