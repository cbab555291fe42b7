//! Arrow reader: decodes batches on one thread while others assemble paths and columns of the
//! previous ones.

use std::slice;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Int64Type;
use arrow_array::{Array, NullArray, RecordBatch};
use arrow_schema::{DataType, Schema};
use guideway_layout::{Code, Diagnostics, Layout, Limits, Place, Provenance};

use super::assemble::PathAssembler;
use super::batch::Batch;
use super::budget::Budget;
use super::cast::cast;
use super::container::{self, Message};
use super::decode::{Decoded, Decoder};
use super::path_columns::PathColumns;
use super::path_ids;
use super::schema::{self, ColumnRoles};
use crate::input::Input;
use crate::source::Source;
use crate::{Format, Problem, ReadError};

/// Reads a table of paths from an Arrow IPC file or stream.
///
/// # Errors
/// When the input is damaged, has another structure or exceeds a limit, or the caller cancels the
/// read.
pub(crate) fn read(source: Source<'_>, input: &Input<'_>) -> Result<Layout, ReadError> {
    // Inside the thread pool, so that no thread is woken per batch.
    let layout = rayon::scope(|_| read_table(source, input));
    layout.map_err(|problem| source.fail(problem))
}

fn read_table(source: Source<'_>, input: &Input<'_>) -> Result<Layout, Problem> {
    let limits = &source.options.limits;
    let mut diagnostics = Diagnostics::with_limit(limits.diagnostics_per_code);
    let container = container::open(input)?;
    let schema = &container.schema;
    let version = schema::version(schema, &mut diagnostics)?;
    let columns = ColumnRoles::find(schema, &mut diagnostics)?;
    let budget = Budget::for_file(input.len());
    let mut batches = BatchStream {
        source,
        input,
        decoder: Decoder::new(input, Arc::new(schema.clone()), columns.control_points),
        messages: container.messages.iter(),
        total: container.messages.len(),
        budget: &budget,
    };
    let mut next = batches.next()?;
    let mut reader = TableReader::new(next.as_ref(), &batches, schema, &columns, diagnostics)?;
    while let Some(batch) = next {
        let (added, decoded) = rayon::join(|| reader.add(&batch), || batches.next());
        added?;
        next = decoded?;
    }
    reader.into_layout(source.name, version)
}

/// Decoded batches of a file, in order.
struct BatchStream<'a> {
    source: Source<'a>,
    input: &'a Input<'a>,
    decoder: Decoder<'a>,
    messages: slice::Iter<'a, Message>,
    total: usize,
    budget: &'a Budget,
}

impl BatchStream<'_> {
    fn next(&mut self) -> Result<Option<Decoded>, Problem> {
        while let Some(message) = self.messages.next() {
            if let Some(progress) = self.source.options.progress {
                let done = self.total - self.messages.len() - 1;
                progress.advance(done as u64, self.total as u64);
                if progress.cancelled() {
                    return Err(Problem::Cancelled);
                }
            }
            if let Some(batch) = self.decoder.decode(message, self.budget)? {
                return Ok(Some(batch));
            }
        }
        Ok(None)
    }
}

/// Layout under construction from the batches of a table.
struct TableReader<'a> {
    input: &'a Input<'a>,
    limits: &'a Limits,
    columns: &'a ColumnRoles,
    diagnostics: Diagnostics,
    assembler: PathAssembler,
    table: PathColumns<'a>,
    /// Batches with rows whose fate is not final.
    pending: Vec<Batch>,
    batch_count: u64,
    /// Identifier of the last row of the previous batch, if rows may continue paths.
    last_id: Option<String>,
}

impl<'a> TableReader<'a> {
    /// Reserves memory as if all batches were like the first, bounded by the size of the file.
    fn new(
        first: Option<&Decoded>,
        batches: &BatchStream<'a>,
        schema: &'a Schema,
        columns: &'a ColumnRoles,
        diagnostics: Diagnostics,
    ) -> Result<Self, Problem> {
        let limits = &batches.source.options.limits;
        let mut assembler = PathAssembler::default();
        let mut rows = 0;
        if let Some(first) = first {
            let file_bytes = batches.decoder.file_bytes();
            let count = 1 + batches.messages.len();
            let Decoded { batch, polygons } = first;
            let point_bytes = polygons.coordinates.point_bytes();
            let points = polygons.range_of_rows(0..polygons.len()).len();
            let points = points.saturating_mul(count);
            // A row has at least four points and a few bytes per column.
            let row_bytes = 4 * point_bytes + 8 * batch.num_columns();
            rows = batch.num_rows().saturating_mul(count);
            rows = rows.min(file_bytes / row_bytes);
            assembler.reserve(polygons, points.min(file_bytes / point_bytes), rows);
        }
        Ok(Self {
            input: batches.input,
            limits,
            columns,
            diagnostics,
            assembler,
            table: PathColumns::new(schema, columns, rows, limits, batches.budget),
            pending: Vec::new(),
            batch_count: 0,
            last_id: None,
        })
    }

    /// Assembles the curves of a batch, which frees their buffers, while the columns take previous
    /// batches.
    fn add(&mut self, Decoded { batch, polygons }: &Decoded) -> Result<(), Problem> {
        let first_row = self.assembler.rows();
        let continues = match self.columns.part {
            None => None,
            Some(part) => Some(self.continues(batch, part, first_row)?),
        };
        let finished = self.finished_batches();
        let (assembler, table) = (&mut self.assembler, &mut self.table);
        let (input, limits) = (self.input, self.limits);
        let (assembled, added) = rayon::join(
            || match continues {
                None => assembler.add(polygons, input, limits),
                Some(continues) => assembler.add_parts(polygons, &continues, input, limits),
            },
            || finished.iter().try_for_each(|batch| table.add(batch)),
        );
        added?;
        assembled?;
        let mut columns = batch.columns().to_vec();
        columns[self.columns.control_points] = Arc::new(NullArray::new(0));
        self.pending.push(Batch {
            rows: first_row..self.assembler.rows(),
            columns,
            drawn: Vec::new(),
            refused: Vec::new(),
        });
        self.batch_count += 1;
        Ok(())
    }

    /// Takes the pending batches whose rows are all final.
    fn finished_batches(&mut self) -> Vec<Batch> {
        let final_rows = self.assembler.final_rows();
        let count = self.pending.partition_point(|b| b.rows.end <= final_rows);
        let mut batches: Vec<Batch> = self.pending.drain(..count).collect();
        for batch in &mut batches {
            self.assembler.assign_rows(batch);
        }
        batches
    }

    /// Returns per row whether it continues the path of the previous row.
    fn continues(
        &mut self,
        batch: &RecordBatch,
        part: usize,
        first_row: usize,
    ) -> Result<Vec<bool>, Problem> {
        let parts = cast(batch.column(part), &DataType::Int64)?;
        let parts = parts.as_primitive::<Int64Type>();
        let ids = path_ids::id_texts(self.columns.id, batch.columns())?;
        let id = |row: usize| ids.as_ref().and_then(|ids| ids.get(row));
        let mut continues = Vec::with_capacity(batch.num_rows());
        for row in 0..batch.num_rows() {
            let claims = parts.is_valid(row) && parts.value(row) > 0;
            let previous = match row {
                0 => self.last_id.as_deref(),
                _ => id(row - 1),
            };
            let matches = first_row + row > 0 && previous == id(row);
            if claims && !matches {
                self.diagnostics.push(
                    Code::UnknownValue,
                    || Place::element(format!("row {}", first_row + row)),
                    || "the row continues a path, but the previous row has another id".into(),
                    "It is drawn as a separate path; write the rows of a path in sequence",
                );
            }
            continues.push(claims && matches);
        }
        if let Some(last) = batch.num_rows().checked_sub(1) {
            self.last_id = id(last).map(str::to_owned);
        }
        Ok(continues)
    }

    fn into_layout(mut self, name: &str, version: u32) -> Result<Layout, Problem> {
        self.assembler.end_rows();
        for batch in self.finished_batches() {
            self.table.add(&batch)?;
        }
        let rows = self.assembler.rows() as u64;
        let geometry = self.assembler.into_geometry();
        let (paths, refused, levels) = self.table.finish(geometry, &mut self.diagnostics);
        Ok(Layout {
            provenance: Provenance {
                source: name.to_owned(),
                format: Format::Arrow.name().to_owned(),
                format_version: version.to_string(),
                counts: vec![
                    ("rows".into(), rows),
                    ("record batches".into(), self.batch_count),
                ],
                text: None,
            },
            paths,
            refused,
            levels,
            diagnostics: self.diagnostics,
            ..Layout::default()
        })
    }
}
