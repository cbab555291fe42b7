//! The Arrow C stream interface: a layout as tables for databases and data frames, and back.

use std::sync::Arc;

use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use guideway::arrow::{collected_batches, read_batches};
use guideway::formats::{ReadOptions, WriteError};

use crate::arguments::{reference, refused, write};
use crate::border::{GuidewayStatus, owned, status};
use crate::layout::GuidewayLayout;

/// Makes a layout of a stream of record batches, whose columns `docs/arrow-format.md` describes.
/// Free the layout with `guideway_layout_free`.
///
/// The stream is taken, also when the call fails: its `release` is NULL afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_from_arrow(
    stream: *mut FFI_ArrowArrayStream,
) -> *mut GuidewayLayout {
    owned(|| {
        // SAFETY: the caller passes a stream, which nobody else uses now.
        unsafe { reference(stream.cast_const(), "stream") }?;
        // SAFETY: as above; it is taken out, and a released one stays behind.
        let reader = unsafe { RecordBatchStreamReader::from_raw(stream) };
        let remedy = "Pass a stream that was not released";
        let reader = reader.map_err(|error| refused(error.to_string(), remedy))?;
        let layout = read_batches(reader, &ReadOptions::default())?;
        Ok(GuidewayLayout(Arc::new(layout)))
    })
}

/// Writes a stream of record batches that hold a layout to `stream`, whose old content is
/// overwritten. The caller calls its `release` in the end; the stream lives on without the layout.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_to_arrow(
    layout: *const GuidewayLayout,
    stream: *mut FFI_ArrowArrayStream,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a layout.
        let layout = unsafe { reference(layout, "layout") }?;
        let batches = collected_batches(&layout.0).map_err(|problem| WriteError {
            path: "record batches".into(),
            problem,
        })?;
        let made = FFI_ArrowArrayStream::new(Box::new(batches));
        // SAFETY: the caller passes a place for a stream.
        unsafe { write(stream, made, "stream") }
    })
}
