//! Arrow reader: decodes batches on one thread while others assemble paths and columns of the
//! previous ones. The rows of other elements go to their tables at once.

use std::slice;
use std::sync::Arc;

use arrow_array::{Array, Int64Array, NullArray, RecordBatch};
use arrow_schema::Schema;
use guideway_layout::{Code, Diagnostics, GeoOrigin, Layout, Place, Provenance};

use super::assemble::PathAssembler;
use super::batch::Batch;
use super::budget::Budget;
use super::cast;
use super::column_names::{CONTROL_POINTS, ELEMENT, LATITUDE_KEY, LONGITUDE_KEY, PATHS_VERSION};
use super::container::{self, Message};
use super::decode::{Decoded, Decoder};
use super::element::Element;
use super::elements::ElementTables;
use super::extents::Extent;
use super::id_column;
use super::part::Part;
use super::path_columns::PathColumns;
use super::reading::Reading;
use super::row_kinds::RowKinds;
use super::schema::{self, ColumnRoles, Role};
use super::time_zones::report_lost_zones;
use crate::input::Input;
use crate::source::Source;
use crate::{Format, Problem, ReadError};

/// Reads a layout from an Arrow IPC file or stream.
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
    let columns = table_columns(schema, &mut diagnostics)?;
    let part = Part::of(source, input, &container, &columns);
    if part.is_none() {
        input.read_ahead();
    }
    let budget = Budget::for_file(input.len());
    let reading = Reading {
        schema,
        columns: &columns,
        limits,
        budget: &budget,
    };
    let mut batches = BatchStream {
        source,
        decoder: Decoder::new(input, Arc::new(schema.clone()), columns.control_points),
        messages: container.messages.iter(),
        total: container.messages.len(),
        part: part.as_ref(),
        budget: &budget,
    };
    let mut next = batches.next()?;
    let mut reader = TableReader::new(input, reading, diagnostics);
    while let Some(Step::Skipped(extent)) = next {
        reader.skip(extent);
        next = batches.next()?;
    }
    if let Some(Step::Batch(first)) = &next {
        let left = batches.messages.clone();
        reader.reserve(first, 1 + left.filter(|next| !batches.skips(next)).count());
    }
    while let Some(step) = next {
        let (added, decoded) = rayon::join(|| reader.take(&step), || batches.next());
        added?;
        next = decoded?;
    }
    let mut layout = reader.into_layout(source.name)?;
    if container.is_hilbert_ordered {
        layout.paths.set_hilbert_ordered();
    }
    if let Some(part) = part {
        part.count(&mut layout);
    }
    Ok(layout)
}

/// Finds the columns of a table, and reports what is odd about them.
pub(super) fn table_columns(
    schema: &Schema,
    diagnostics: &mut Diagnostics,
) -> Result<ColumnRoles, Problem> {
    report_lost_zones(schema, diagnostics);
    let version = schema::version(schema, diagnostics)?;
    ColumnRoles::find(schema, version, diagnostics)
}

/// The next rows of a table.
enum Step {
    Batch(Box<Decoded>),
    /// A batch beyond the area.
    Skipped(Extent),
}

/// Decoded batches of a file, in order.
struct BatchStream<'a> {
    source: Source<'a>,
    decoder: Decoder<'a>,
    messages: slice::Iter<'a, Message>,
    total: usize,
    part: Option<&'a Part>,
    budget: &'a Budget,
}

impl BatchStream<'_> {
    /// Returns `true` if a message is a record batch beyond the area.
    fn skips(&self, message: &Message) -> bool {
        self.part.is_some_and(|part| part.skips(message))
    }

    fn next(&mut self) -> Result<Option<Step>, Problem> {
        while let Some(message) = self.messages.next() {
            if let Some(progress) = self.source.options.progress {
                let done = self.total - self.messages.len() - 1;
                progress.advance(done as u64, self.total as u64);
                if progress.cancelled() {
                    return Err(Problem::Cancelled);
                }
            }
            if let Some(extent) = message.extent.filter(|_| self.skips(message)) {
                return Ok(Some(Step::Skipped(extent)));
            }
            if let Some(batch) = self.decoder.decode(message, self.budget)? {
                return Ok(Some(Step::Batch(Box::new(batch))));
            }
        }
        Ok(None)
    }
}

/// Layout under construction from the batches of a table.
pub(super) struct TableReader<'a> {
    input: &'a Input<'a>,
    reading: Reading<'a>,
    diagnostics: Diagnostics,
    assembler: PathAssembler,
    paths: PathColumns<'a>,
    elements: ElementTables<'a>,
    /// Batches with rows of paths whose fate is not final.
    pending: Vec<Batch>,
    batch_count: u64,
    /// Number of rows of unknown kinds.
    unknown_rows: u64,
    /// Number of control points with a third number.
    heights: u64,
    /// Identifier of the last row of the previous batch, if rows may continue paths.
    last_id: Option<String>,
}

impl<'a> TableReader<'a> {
    pub(super) fn new(
        input: &'a Input<'a>,
        reading: Reading<'a>,
        diagnostics: Diagnostics,
    ) -> Self {
        Self {
            input,
            reading,
            diagnostics,
            assembler: PathAssembler::new(reading.columns.version),
            paths: PathColumns::new(reading, 0),
            elements: ElementTables::new(reading),
            pending: Vec::new(),
            batch_count: 0,
            unknown_rows: 0,
            heights: 0,
            last_id: None,
        }
    }

    /// Reserves memory as if all batches were like the first, bounded by the size of the file.
    fn reserve(&mut self, first: &Decoded, batches: usize) {
        let (batch, polygons) = (&first.batch, &first.polygons);
        let file_bytes = self.input.len();
        let point_bytes = polygons.coordinates.point_bytes();
        let points = polygons.range_of_rows(0..polygons.len()).len();
        let points = points.saturating_mul(batches).min(file_bytes / point_bytes);
        // A row has at least four points and a few bytes per column.
        let row_bytes = 4 * point_bytes + 8 * batch.num_columns();
        let rows = batch.num_rows().saturating_mul(batches);
        let rows = rows.min(file_bytes / row_bytes);
        self.assembler.reserve(polygons, points, rows);
        self.paths = PathColumns::new(self.reading, rows);
    }

    fn take(&mut self, step: &Step) -> Result<(), Problem> {
        match step {
            Step::Batch(decoded) => self.add(decoded),
            Step::Skipped(extent) => {
                self.skip(*extent);
                Ok(())
            }
        }
    }

    /// Counts the elements of a batch that is not read.
    fn skip(&mut self, extent: Extent) {
        let [paths, nodes] = extent.begun.unwrap_or([extent.rows as u32, 0]);
        self.assembler.skip_paths(extent.rows, paths);
        self.elements.skip_nodes(nodes);
        self.last_id = None;
    }

    /// Assembles the curves of a batch, which frees their buffers, while the columns take previous
    /// batches.
    pub(super) fn add(&mut self, decoded: &Decoded) -> Result<(), Problem> {
        let (batch, polygons) = (&decoded.batch, &decoded.polygons);
        for (column, count) in &decoded.replaced {
            self.diagnostics.push(
                Code::WrongType,
                || Place::element(format!("column {column}")),
                || format!("{count} texts are not UTF-8"),
                "Their other bytes are replaced by \u{FFFD}; write the texts as UTF-8",
            );
        }
        let columns = self.reading.columns;
        let first_row = self.assembler.rows();
        let kinds = RowKinds::of(batch, columns)?;
        self.batch_count += 1;
        self.unknown_rows += kinds.unknown() as u64;
        self.heights += polygons.heights;
        let mut arrays = batch.columns().to_vec();
        arrays[columns.control_points] = Arc::new(NullArray::new(0));
        let mut rows = Batch {
            rows: first_row..first_row + batch.num_rows(),
            columns: arrays,
            drawn: Vec::new(),
            refused: Vec::new(),
        };
        for kind in Element::ALL {
            if kind != Element::Path && kinds.has(kind) {
                rows.drawn = kinds.rows(kind).collect();
                self.elements.add(kind, &rows)?;
            }
        }
        if !kinds.has(Element::Path) {
            self.assembler.skip(batch.num_rows());
            return Ok(());
        }
        rows.drawn = Vec::new();
        let continues = match columns.get(Role::Part) {
            None => None,
            Some(part) => Some(self.continues(batch, part, first_row)?),
        };
        let finished = self.finished_batches();
        let (assembler, paths) = (&mut self.assembler, &mut self.paths);
        let (input, limits) = (self.input, self.reading.limits);
        let (assembled, added) = rayon::join(
            || match continues {
                None => assembler.add(polygons, &kinds, input, limits),
                Some(continues) => assembler.add_parts(polygons, &kinds, &continues, input, limits),
            },
            || finished.iter().try_for_each(|batch| paths.add(batch)),
        );
        added?;
        assembled?;
        self.pending.push(rows);
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
        let parts: Int64Array = cast::numbers(batch.column(part))?;
        let id_index = self.reading.columns.get(Role::Id);
        let ids = id_column::id_texts(id_index, batch.columns());
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

    pub(super) fn into_layout(mut self, name: &str) -> Result<Layout, Problem> {
        self.assembler.end_rows();
        for batch in self.finished_batches() {
            self.paths.add(&batch)?;
        }
        let rows = self.assembler.rows() as u64;
        let mut diagnostics = self.diagnostics;
        if self.unknown_rows > 0 {
            diagnostics.push(
                Code::UnknownValue,
                || Place::element(format!("column {ELEMENT}")),
                || format!("{} rows are of a kind that is not known", self.unknown_rows),
                "They are not read; write the name of a kind of element",
            );
        }
        if self.heights > 0 {
            diagnostics.push(
                Code::Attribute,
                || Place::element(format!("column {CONTROL_POINTS}")),
                || format!("{} control points have more than two numbers", self.heights),
                "The first two are read; write heights in a column of their own",
            );
        }
        let assembled = self.assembler.into_geometry();
        let mut layout = self
            .elements
            .into_layout(self.paths, assembled, &mut diagnostics)?;
        let version = self.reading.columns.version;
        if version > PATHS_VERSION {
            layout.geo_origin = geo_origin(self.reading.schema, &mut diagnostics);
        }
        layout.provenance = Provenance {
            source: name.to_owned(),
            format: Format::Arrow.name().to_owned(),
            format_version: version.to_string(),
            assumed_unit_m: None,
            counts: vec![
                ("rows".into(), rows),
                ("record batches".into(), self.batch_count),
            ],
            text: None,
            file: None,
        };
        layout.diagnostics = diagnostics;
        Ok(layout)
    }
}

/// Returns the place on earth of the origin that the metadata of the schema states.
fn geo_origin(schema: &Schema, diagnostics: &mut Diagnostics) -> Option<GeoOrigin> {
    let stated = [LONGITUDE_KEY, LATITUDE_KEY].map(|key| schema.metadata().get(key));
    if stated == [None, None] {
        return None;
    }
    let degrees = stated.map(|text| text?.trim().parse::<f64>().ok().filter(|d| d.is_finite()));
    let [Some(longitude_deg), Some(latitude_deg)] = degrees else {
        diagnostics.push(
            Code::UnknownValue,
            || Place::element(format!("schema, {LONGITUDE_KEY} and {LATITUDE_KEY}")),
            || "one of them is no number of degrees".into(),
            "The layout is read without a place on earth; write both numbers",
        );
        return None;
    };
    Some(GeoOrigin {
        longitude_deg,
        latitude_deg,
    })
}
