use std::slice;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::Int64Type;
use arrow_array::{Array, NullArray, RecordBatch};
use arrow_schema::{DataType, Schema};
use guideway_layout::{Code, Diagnostics, Layout, Limits, Place, Provenance};

use super::batch::{Batch, cast};
use super::budget::Budget;
use super::container::{self, Message};
use super::decode::{Decoded, Decoder};
use super::gather::Gather;
use super::ids;
use super::schema::{self, Columns};
use super::table::Table;
use crate::input::Input;
use crate::source::Source;
use crate::{Format, Problem, ReadError};

/// Reads a table of paths from an Arrow IPC file or stream.
pub(crate) fn read(source: Source<'_>, input: &Input<'_>) -> Result<Layout, ReadError> {
    // Among the threads that share the work, so that none is woken for each batch.
    let layout = rayon::scope(|_| read_table(source, input));
    layout.map_err(|problem| source.fail(problem))
}

fn read_table(source: Source<'_>, input: &Input<'_>) -> Result<Layout, Problem> {
    let limits = &source.options.limits;
    let mut diagnostics = Diagnostics::with_limit(limits.diagnostics_per_code);
    let container = container::open(input)?;
    let schema = &container.schema;
    let version = schema::version(schema, &mut diagnostics)?;
    let columns = Columns::find(schema, &mut diagnostics)?;
    let budget = Budget::for_file(input.len());
    let mut batches = Batches {
        source,
        input,
        decoder: Decoder::new(input, Arc::new(schema.clone()), columns.control_points),
        messages: container.messages.iter(),
        total: container.messages.len(),
        budget: &budget,
    };
    let mut next = batches.next()?;
    let mut reader = Reader::new(next.as_ref(), &batches, schema, &columns, diagnostics)?;
    while let Some(batch) = next {
        let (added, decoded) = rayon::join(|| reader.add(&batch), || batches.next());
        added?;
        next = decoded?;
    }
    reader.into_layout(source.name, version)
}

/// The batches of a file, one after the other.
struct Batches<'a> {
    source: Source<'a>,
    input: &'a Input<'a>,
    decoder: Decoder<'a>,
    messages: slice::Iter<'a, Message>,
    total: usize,
    budget: &'a Budget,
}

impl Batches<'_> {
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

struct Reader<'a> {
    input: &'a Input<'a>,
    limits: &'a Limits,
    columns: &'a Columns,
    diagnostics: Diagnostics,
    gather: Gather,
    table: Table<'a>,
    /// Batches that the table has not got yet.
    waiting: Vec<Batch>,
    batch_count: u64,
    /// Identifier of the last row of the batch before; only kept where rows may continue paths.
    last_id: Option<String>,
}

impl<'a> Reader<'a> {
    /// With room as if all batches were like the first one, but for no more than the file can hold.
    fn new(
        first: Option<&Decoded>,
        batches: &Batches<'a>,
        schema: &'a Schema,
        columns: &'a Columns,
        diagnostics: Diagnostics,
    ) -> Result<Self, Problem> {
        let limits = &batches.source.options.limits;
        let mut gather = Gather::default();
        let mut rows = 0;
        if let Some(first) = first {
            let file_bytes = batches.decoder.file_bytes();
            let count = 1 + batches.messages.len();
            let Decoded { batch, polygons } = first;
            let point_bytes = polygons.coordinates.point_bytes();
            let points = polygons.range_of_rows(0..polygons.len()).len();
            let points = points.saturating_mul(count);
            // Four points each, and a few bytes a column: many columns have room for fewer.
            let row_bytes = 4 * point_bytes + 8 * batch.num_columns();
            rows = batch.num_rows().saturating_mul(count);
            rows = rows.min(file_bytes / row_bytes);
            gather.reserve(polygons, points.min(file_bytes / point_bytes), rows);
        }
        Ok(Self {
            input: batches.input,
            limits,
            columns,
            diagnostics,
            gather,
            table: Table::new(schema, columns, rows, limits, batches.budget),
            waiting: Vec::new(),
            batch_count: 0,
            last_id: None,
        })
    }

    /// Takes the curves of a batch, so that their buffers can go, while the table gets those before it.
    fn add(&mut self, Decoded { batch, polygons }: &Decoded) -> Result<(), Problem> {
        let first_row = self.gather.rows();
        let continues = match self.columns.part {
            None => None,
            Some(part) => Some(self.continues(batch, part, first_row)?),
        };
        let settled = self.settled();
        let (gather, table) = (&mut self.gather, &mut self.table);
        let (input, limits) = (self.input, self.limits);
        let (gathered, tabled) = rayon::join(
            || match continues {
                None => gather.add(polygons, input, limits),
                Some(continues) => gather.add_parts(polygons, &continues, input, limits),
            },
            || settled.iter().try_for_each(|batch| table.add(batch)),
        );
        tabled?;
        gathered?;
        let mut columns = batch.columns().to_vec();
        columns[self.columns.control_points] = Arc::new(NullArray::new(0));
        self.waiting.push(Batch {
            rows: first_row..self.gather.rows(),
            columns,
            kept: Vec::new(),
            refused: Vec::new(),
        });
        self.batch_count += 1;
        Ok(())
    }

    /// The batches of which it is known by now what becomes of all rows.
    fn settled(&mut self) -> Vec<Batch> {
        let settled = self.gather.settled_rows();
        let count = self.waiting.partition_point(|b| b.rows.end <= settled);
        let mut batches: Vec<Batch> = self.waiting.drain(..count).collect();
        for batch in &mut batches {
            self.gather.tell(batch);
        }
        batches
    }

    /// Which rows continue the path of the row before.
    fn continues(
        &mut self,
        batch: &RecordBatch,
        part: usize,
        first_row: usize,
    ) -> Result<Vec<bool>, Problem> {
        let parts = cast(batch.column(part), &DataType::Int64)?;
        let parts = parts.as_primitive::<Int64Type>();
        let ids = ids::texts(self.columns.id, batch.columns())?;
        let id = |row: usize| ids.as_ref().and_then(|ids| ids.get(row));
        let mut continues = Vec::with_capacity(batch.num_rows());
        for row in 0..batch.num_rows() {
            let wants = parts.is_valid(row) && parts.value(row) > 0;
            let before = match row {
                0 => self.last_id.as_deref(),
                _ => id(row - 1),
            };
            let fits = first_row + row > 0 && before == id(row);
            if wants && !fits {
                self.diagnostics.push(
                    Code::UnknownValue,
                    || Place::element(format!("row {}", first_row + row)),
                    || "the row says that it continues a path, but the row before has another id".into(),
                    "Keep the rows of one path together, part 0 first; it is drawn as a path of its own",
                );
            }
            continues.push(wants && fits);
        }
        if let Some(last) = batch.num_rows().checked_sub(1) {
            self.last_id = id(last).map(str::to_owned);
        }
        Ok(continues)
    }

    fn into_layout(mut self, name: &str, version: u32) -> Result<Layout, Problem> {
        self.gather.settle();
        for batch in self.settled() {
            self.table.add(&batch)?;
        }
        let rows = self.gather.rows() as u64;
        let geometry = self.gather.into_geometry();
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
