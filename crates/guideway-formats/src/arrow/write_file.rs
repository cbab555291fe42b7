//! Arrow file writer: writes record batches to a stream.

use std::io::Write;

use crate::write_error::WriteProblem;
use arrow_array::RecordBatch;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::SchemaRef;

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
}

impl<W: Write> IpcFile<W> {
    /// Begins a file without compression.
    pub(super) fn begin(out: W, schema: SchemaRef) -> Result<Self, WriteProblem> {
        // 64 bytes: buffers of a mapped file are then aligned for AVX-512 loads.
        let options = IpcWriteOptions::try_new(64, false, arrow_ipc::MetadataVersion::V5)?;
        Ok(Self {
            writer: FileWriter::try_new_with_options(out, &schema, options)?,
            schema,
        })
    }

    /// The schema of its batches.
    pub(super) fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }

    /// Appends a batch.
    pub(super) fn write(&mut self, batch: &RecordBatch) -> Result<(), WriteProblem> {
        Ok(self.writer.write(batch)?)
    }

    /// Ends the file. Returns the stream.
    pub(super) fn finish(self) -> Result<W, WriteProblem> {
        Ok(self.writer.into_inner()?)
    }
}
