//! Arrow file writer: writes record batches to a temporary file, which replaces the target at the
//! end.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use arrow_array::{ArrayRef, RecordBatch};
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::{Schema, SchemaRef};
use tempfile::NamedTempFile;

use super::write_error::WriteProblem;

/// Rows per record batch.
pub(super) const BATCH_ROWS: usize = 16_384;
/// Control points that end a batch early, so that long curves take no more memory.
pub(super) const BATCH_POINTS: usize = 4 << 20;
/// Bytes of text that end a batch early.
pub(super) const BATCH_TEXT_BYTES: usize = 64 << 20;

/// An Arrow file under construction, in a temporary file in the folder of the target.
pub(super) struct IpcFile {
    target: PathBuf,
    writer: FileWriter<io::BufWriter<NamedTempFile>>,
    schema: SchemaRef,
}

impl IpcFile {
    /// Begins a file without compression.
    pub(super) fn create(target: &Path, schema: Schema) -> Result<Self, WriteProblem> {
        // 64 bytes: buffers of a mapped file are then aligned for AVX-512 loads.
        let options = IpcWriteOptions::try_new(64, false, arrow_ipc::MetadataVersion::V5)?;
        let file = io::BufWriter::with_capacity(1 << 20, temporary_beside(target)?);
        Ok(Self {
            target: target.to_owned(),
            writer: FileWriter::try_new_with_options(file, &schema, options)?,
            schema: schema.into(),
        })
    }

    /// Returns the target.
    pub(super) fn target(&self) -> &Path {
        &self.target
    }

    /// Appends a batch.
    pub(super) fn write(&mut self, columns: Vec<ArrayRef>) -> Result<(), WriteProblem> {
        let batch = RecordBatch::try_new(self.schema.clone(), columns)?;
        Ok(self.writer.write(&batch)?)
    }

    /// Ends the file and replaces the target.
    pub(super) fn finish(self) -> Result<(), WriteProblem> {
        let file = self.writer.into_inner()?;
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(&self.target).map_err(|e| e.error)?;
        Ok(())
    }
}

/// Creates a temporary file in the folder of `path`: a rename is atomic only within one file
/// system.
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile<File>> {
    // A rename would replace a device by a file.
    if fs::metadata(path).is_ok_and(|target| !target.is_file()) {
        return Err(io::Error::other("the target exists and is not a file"));
    }
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".guideway-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The mode of any new file, before the umask.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
