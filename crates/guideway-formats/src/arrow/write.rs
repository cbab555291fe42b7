//! Arrow table writer: writes runs row by row into record batches.

use std::collections::HashMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::Schema;
use guideway_layout::Value;
use guideway_spline::{Point, Real};

use super::column_names::{CONTROL_POINTS, ID, PATHS_VERSION, VERSION_KEY};
use super::write_column::{Cells, Column, IdCells, PolygonCells, Precision};
use super::write_file::{BATCH_POINTS, BATCH_ROWS, BATCH_TEXT_BYTES, IpcFile};
use crate::output::NewFile;
use crate::write_error::{WriteError, WriteProblem, fail};

/// Writes a table of paths row by row, in memory independent of the number of rows.
///
/// The rows go to a [`NewFile`]; [`Self::finish`] replaces the target with it. A writer dropped
/// before leaves the target unchanged.
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
pub struct ArrowWriter<W: Write = NewFile> {
    /// Name of the stream in messages.
    path: PathBuf,
    file: IpcFile<W>,
    ids: IdCells,
    polygons: PolygonCells,
    columns: Vec<Column>,
    cells: Vec<Cells>,
}

impl ArrowWriter {
    /// Makes a writer to `path` with `columns` in addition to identifiers and control points.
    ///
    /// # Errors
    /// When no file can be created in the folder of `path`, or two columns share a name.
    pub fn create(
        path: &Path,
        precision: Precision,
        columns: Vec<Column>,
    ) -> Result<Self, WriteError> {
        Self::to_stream(NewFile::create(path)?, path, precision, columns)
    }

    /// Writes the last batch and replaces the target. Returns the size of the file in bytes.
    ///
    /// # Errors
    /// When the disk is full, or the target cannot be replaced; the target is then unchanged.
    pub fn finish(self) -> Result<u64, WriteError> {
        let file = self.finish_stream()?;
        let bytes = file.bytes();
        file.commit()?;
        Ok(bytes)
    }
}

impl<W: Write> ArrowWriter<W> {
    /// Makes a writer to a stream, which errors call `name`: see [`ArrowWriter::create`].
    ///
    /// # Errors
    /// When the stream fails, or two columns share a name.
    pub fn to_stream(
        out: W,
        name: &Path,
        precision: Precision,
        columns: Vec<Column>,
    ) -> Result<Self, WriteError> {
        Self::begin(out, name, precision, columns).map_err(|p| fail(name, p))
    }

    fn begin(
        file: W,
        path: &Path,
        precision: Precision,
        columns: Vec<Column>,
    ) -> Result<Self, WriteProblem> {
        let (ids, polygons) = (IdCells::default(), PolygonCells::new(precision));
        let mut fields = vec![IdCells::field(ID), polygons.field(CONTROL_POINTS, false)];
        for column in &columns {
            if fields.iter().any(|f| *f.name() == column.name) {
                return Err(WriteProblem::Value {
                    column: column.name.clone(),
                    detail: "two columns have this name".into(),
                });
            }
            fields.push(column.field());
        }
        let metadata = HashMap::from([(VERSION_KEY.to_owned(), PATHS_VERSION.to_string())]);
        let schema = Schema::new_with_metadata(fields, metadata);
        Ok(Self {
            path: path.to_owned(),
            file: IpcFile::begin(file, schema.into())?,
            ids,
            polygons,
            cells: columns.iter().map(Column::cells).collect(),
            columns,
        })
    }

    /// Appends a row: a run of control points in meters, and an optional value per column.
    ///
    /// # Errors
    /// When the run has fewer than four points, a value does not match its column, or the disk is
    /// full.
    pub fn push_run<T: Real>(
        &mut self,
        id: &str,
        run: &[Point<T>],
        values: &[Option<Value<'_>>],
    ) -> Result<(), WriteError> {
        self.push_inner(id, run, values)
            .map_err(|p| fail(&self.path, p))
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
                detail: format!("the value {value} of path {id:?} does not match its type"),
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
            arrays.push(cells.take(column));
        }
        let batch = RecordBatch::try_new(self.file.schema(), arrays)?;
        self.file.write(&batch)
    }

    /// Writes the last batch. Returns the stream.
    ///
    /// # Errors
    /// When the stream fails.
    pub fn finish_stream(mut self) -> Result<W, WriteError> {
        if self.polygons.rows() > 0 {
            self.write_batch().map_err(|p| fail(&self.path, p))?;
        }
        self.file.finish().map_err(|p| fail(&self.path, p))
    }
}
