use std::collections::HashMap;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch};
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::{ArrowError, Schema, SchemaRef};
use guideway_layout::Value;
use guideway_spline::{Point, Real};
use tempfile::NamedTempFile;

use super::write_columns::{Cells, Column, IdCells, Polygon};
use super::{CONTROL_POINTS, ID, VERSION, VERSION_KEY};

/// Rows of a record batch.
const BATCH_ROWS: usize = 16_384;
/// A batch ends early at so many control points, so that few long curves take no more memory.
const BATCH_POINTS: usize = 4 << 20;
/// Likewise for text.
const BATCH_TEXT_BYTES: usize = 64 << 20;

/// How coordinates are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// 4 bytes each: exact to some 0.1 mm at 1 km from the origin.
    F32,
    /// 8 bytes each.
    F64,
}

/// Why a table could not be written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", .path.display())]
pub struct WriteError {
    /// The file that was to be written.
    pub path: PathBuf,
    /// What is wrong.
    pub problem: WriteProblem,
}

/// What is wrong with a table that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteProblem {
    /// The operating system refused.
    #[error("cannot write the file: {0}")]
    Io(#[from] io::Error),
    /// A curve has too few control points.
    #[error("path {id:?} has a run of {points} control points")]
    TooFewPoints {
        /// Identifier of the path.
        id: String,
        /// Number of control points.
        points: usize,
    },
    /// The values of a row are not those of the columns.
    #[error("column {column:?}: {detail}")]
    Value {
        /// Name of the column.
        column: String,
        /// What does not fit.
        detail: String,
    },
    /// The Arrow library refused.
    #[error("cannot make the table: {0}")]
    Arrow(#[source] ArrowError),
}

impl WriteError {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self.problem {
            WriteProblem::Io(_) => "Check that the folder exists, may be written to and has room",
            WriteProblem::TooFewPoints { .. } => "Give the path four or more",
            WriteProblem::Value { .. } => "Give each row a value of the type of every column",
            WriteProblem::Arrow(_) => "Please report this",
        }
    }
}

impl From<ArrowError> for WriteProblem {
    fn from(error: ArrowError) -> Self {
        match error {
            ArrowError::IoError(_, error) => Self::Io(error),
            other => Self::Arrow(other),
        }
    }
}

/// Writes a table of paths, row by row; the memory taken does not grow with the number of rows.
///
/// What is written goes into a temporary file beside the target, which [`Self::finish`] puts in its
/// place. A writer dropped before that leaves the target as it was.
///
/// ```no_run
/// use guideway_formats::arrow::{ArrowWriter, Column, ColumnType, Precision};
/// use guideway_layout::Value;
/// use guideway_spline::Point;
///
/// let columns = vec![Column::new("max_speed", ColumnType::Float32)];
/// let mut writer = ArrowWriter::create("site.arrow".as_ref(), Precision::F32, columns)?;
/// let run = [0.0, 1.0, 2.0, 3.0].map(|x| Point::new(x, 0.0_f32));
/// writer.push_run("A-1", &run, &[Some(Value::Float(1.5))])?;
/// writer.finish()?;
/// # Ok::<(), guideway_formats::arrow::WriteError>(())
/// ```
pub struct ArrowWriter {
    target: PathBuf,
    writer: FileWriter<io::BufWriter<NamedTempFile>>,
    schema: SchemaRef,
    ids: IdCells,
    polygons: Polygon,
    columns: Vec<Column>,
    cells: Vec<Cells>,
}

impl ArrowWriter {
    /// A writer to `path` with further `columns` beside identifiers and control points.
    ///
    /// # Errors
    /// When no file can be made in the folder of `path`, or two columns have one name.
    pub fn create(
        path: &Path,
        precision: Precision,
        columns: Vec<Column>,
    ) -> Result<Self, WriteError> {
        Self::create_inner(path, precision, columns).map_err(|p| fail(path, p))
    }

    fn create_inner(
        path: &Path,
        precision: Precision,
        columns: Vec<Column>,
    ) -> Result<Self, WriteProblem> {
        let (ids, polygons) = (IdCells::default(), Polygon::new(precision));
        let mut fields = vec![IdCells::field(ID), polygons.field(CONTROL_POINTS)];
        for column in &columns {
            if fields.iter().any(|f| *f.name() == column.name) {
                return Err(WriteProblem::Value {
                    column: column.name.clone(),
                    detail: "there are two columns of this name".into(),
                });
            }
            fields.push(column.field());
        }
        let metadata = HashMap::from([(VERSION_KEY.to_owned(), VERSION.to_string())]);
        let schema = Arc::new(Schema::new_with_metadata(fields, metadata));
        // 64 bytes: readers that map the file then find every buffer aligned for their widest loads.
        let options = IpcWriteOptions::try_new(64, false, arrow_ipc::MetadataVersion::V5)?;
        let file = io::BufWriter::with_capacity(1 << 20, temporary_beside(path)?);
        Ok(Self {
            target: path.to_owned(),
            writer: FileWriter::try_new_with_options(file, &schema, options)?,
            schema,
            ids,
            polygons,
            cells: columns.iter().map(Column::cells).collect(),
            columns,
        })
    }

    /// Appends a row: a run of control points, in meters, and a value or none for every column.
    ///
    /// # Errors
    /// When the run has fewer than four points, a value does not fit its column, or the disk is full.
    pub fn push_run<T: Real>(
        &mut self,
        id: &str,
        run: &[Point<T>],
        values: &[Option<Value<'_>>],
    ) -> Result<(), WriteError> {
        self.push_inner(id, run, values)
            .map_err(|p| fail(&self.target, p))
    }

    fn push_inner<T: Real>(
        &mut self,
        id: &str,
        run: &[Point<T>],
        values: &[Option<Value<'_>>],
    ) -> Result<(), WriteProblem> {
        if run.len() < 4 {
            return Err(WriteProblem::TooFewPoints {
                id: id.to_owned(),
                points: run.len(),
            });
        }
        if values.len() != self.columns.len() {
            return Err(WriteProblem::Value {
                column: id.to_owned(),
                detail: format!("{} values for {} columns", values.len(), self.columns.len()),
            });
        }
        let unfit = values
            .iter()
            .zip(&self.columns)
            .find(|(value, column)| value.is_some_and(|v| !column.fits(v)));
        if let Some((Some(value), column)) = unfit {
            return Err(WriteProblem::Value {
                column: column.name.clone(),
                detail: format!("the value {value} of path {id:?} does not fit"),
            });
        }
        self.ids.push(id);
        self.polygons.push(run);
        let mut text_bytes = self.ids.bytes();
        for (cells, &value) in self.cells.iter_mut().zip(values) {
            cells.push(value);
            text_bytes += cells.text_bytes();
        }
        let full = self.polygons.rows() >= BATCH_ROWS
            || self.polygons.points() >= BATCH_POINTS
            || text_bytes >= BATCH_TEXT_BYTES;
        if full {
            self.write_batch()?;
        }
        Ok(())
    }

    fn write_batch(&mut self) -> Result<(), WriteProblem> {
        let mut arrays: Vec<ArrayRef> = vec![self.ids.take(), self.polygons.take()?];
        for (cells, column) in self.cells.iter_mut().zip(&self.columns) {
            arrays.push(cells.take(column)?);
        }
        let batch = RecordBatch::try_new(self.schema.clone(), arrays)?;
        Ok(self.writer.write(&batch)?)
    }

    /// Writes what is left, and puts the file in its place.
    ///
    /// # Errors
    /// When the disk is full, or the target cannot be replaced; it is then as it was.
    pub fn finish(self) -> Result<(), WriteError> {
        let target = self.target.clone();
        self.finish_inner().map_err(|p| fail(&target, p))
    }

    fn finish_inner(mut self) -> Result<(), WriteProblem> {
        if self.polygons.rows() > 0 {
            self.write_batch()?;
        }
        let file = self.writer.into_inner()?;
        let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
        file.persist(&self.target).map_err(|e| e.error)?;
        Ok(())
    }
}

/// A temporary file in the folder of `path`: only within one file system can it take its place at once.
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile<File>> {
    // Renaming would put a file in the place of a device.
    if fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return Err(io::Error::other("there is something that is not a file"));
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
        // As for any new file, less what the user's mask takes away.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

pub(super) fn fail(path: &Path, problem: WriteProblem) -> WriteError {
    WriteError {
        path: path.to_owned(),
        problem,
    }
}
