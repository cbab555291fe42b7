//! Arrow file writer: writes record batches to a stream.

use std::io::Write;

use arrow_array::RecordBatch;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::SchemaRef;

use super::column_names::{HILBERT_ORDER, ORDER_KEY};
use super::extents::{EXTENTS_KEY, Extents};
use crate::write_error::WriteProblem;

/// Rows per record batch.
pub(super) const BATCH_ROWS: usize = 16_384;
/// Control points that end a batch early, so that long curves take no more memory.
pub(super) const BATCH_POINTS: usize = 4 << 20;
/// Bytes of text that end a batch early.
pub(super) const BATCH_TEXT_BYTES: usize = 64 << 20;

/// An Arrow file under construction.
pub(super) struct IpcFile<W: Write> {
    writer: FileWriter<W>,
    schema: SchemaRef,
    extents: Extents,
}

impl<W: Write> IpcFile<W> {
    /// Begins a file without compression.
    pub(super) fn begin(out: W, schema: SchemaRef) -> Result<Self, WriteProblem> {
        // 64 bytes: buffers of a mapped file are then aligned for AVX-512 loads.
        let options = IpcWriteOptions::try_new(64, false, arrow_ipc::MetadataVersion::V5)?;
        Ok(Self {
            writer: FileWriter::try_new_with_options(out, &schema, options)?,
            schema,
            extents: Extents::default(),
        })
    }

    /// The schema of its batches.
    pub(super) fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }

    /// Appends a batch.
    pub(super) fn write(&mut self, batch: &RecordBatch) -> Result<(), WriteProblem> {
        self.extents.push(batch);
        Ok(self.writer.write(batch)?)
    }

    /// States that the paths follow a Hilbert curve.
    pub(super) fn set_hilbert_ordered(&mut self) {
        self.writer.write_metadata(ORDER_KEY, HILBERT_ORDER);
    }

    /// Ends the file, with the extents of its batches. Returns the stream.
    pub(super) fn finish(mut self) -> Result<W, WriteProblem> {
        self.writer
            .write_metadata(EXTENTS_KEY, self.extents.into_text());
        Ok(self.writer.into_inner()?)
    }
}
