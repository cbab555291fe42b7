//! Arrow layout writer: writes the record batches of a layout to a file.

use std::io::Write;

use arrow_array::RecordBatchReader;
use guideway_layout::Layout;

use super::batches::{Batches, precision_within};
use super::write_column::Precision;
use super::write_file::IpcFile;
use crate::Losses;
use crate::finite::check_finite;
use crate::source::WrittenPaths;
use crate::write_error::WriteProblem;

/// Largest distance by which `f32` may move a control point, in meters; beyond it `f64` is used.
const F32_ERROR_M: f64 = 1e-5;

/// Options of [`write_layout`].
#[derive(Clone, Debug, Default)]
pub struct WriteOptions {
    /// Storage type of control points; `None` for `f32` if its error is at most 0.01 mm, else
    /// `f64`.
    pub precision: Option<Precision>,
}

/// Writes a layout as a table: of version 1 if it has nothing but paths, else of version 2, which
/// holds all elements. Returns the losses, of which there are none.
///
/// # Errors
/// When the output fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> Result<Losses, WriteProblem> {
    write_watched(layout, out, options, &WrittenPaths::unwatched())
}

/// Writes as [`write_layout`] does, and counts the paths.
pub(crate) fn write_watched(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
    written_paths: &WrittenPaths<'_>,
) -> Result<Losses, WriteProblem> {
    check_finite(layout)?;
    let precision = options.precision;
    let precision = precision.unwrap_or_else(|| precision_within(layout, F32_ERROR_M));
    let mut batches = Batches::new(layout, precision);
    let mut file = IpcFile::begin(out, batches.schema())?;
    while let Some(batch) = batches.next_batch(written_paths) {
        file.write(&batch?)?;
    }
    if layout.paths.is_hilbert_ordered() {
        file.set_hilbert_ordered();
    }
    file.finish()?.flush()?;
    Ok(Losses::default())
}
