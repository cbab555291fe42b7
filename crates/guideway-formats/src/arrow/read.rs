use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int32Type, UInt32Type};
use arrow_array::{Array, ArrayRef, NullArray, RecordBatch};
use arrow_buffer::Buffer;
use arrow_schema::{DataType, Schema};
use guideway_layout::{
    Attribute, Code, Diagnostics, Layout, Level, Limits, Paths, Place, Provenance, Refused,
    TextColumn,
};
use rayon::prelude::*;

use super::attributes::{Converter, TextSink, cast, numbers};
use super::budget::Budget;
use super::container::{self, Container};
use super::decode::Decoder;
use super::gather::Gather;
use super::polygons::{Coordinates, Fault, Polygons};
use super::schema::{self, Columns};
use super::table::{Batch, Table};
use super::text::Texts;
use crate::source::Source;
use crate::{Format, Problem, ReadError};

/// Reads a table of paths from an Arrow IPC file or stream.
pub(crate) fn read(source: Source<'_>, bytes: &Buffer) -> Result<Layout, ReadError> {
    read_table(source, bytes).map_err(|problem| source.fail(problem))
}

fn read_table(source: Source<'_>, bytes: &Buffer) -> Result<Layout, Problem> {
    let limits = &source.options.limits;
    let mut diagnostics = Diagnostics::keeping(limits.diagnostics_per_code);
    let container = container::open(bytes)?;
    let version = schema::version(&container.schema, &mut diagnostics)?;
    let columns = Columns::find(&container.schema, &mut diagnostics)?;
    let schema = Arc::new(container.schema.clone());
    let mut reader = Reader {
        source,
        limits,
        columns,
        budget: Budget::for_file(bytes.len()),
        diagnostics,
        gather: Gather::default(),
        batches: Vec::new(),
        last_id: None,
    };
    reader.read_batches(bytes, &container)?;
    reader.into_layout(&schema, version)
}

struct Reader<'a> {
    source: Source<'a>,
    limits: &'a Limits,
    columns: Columns,
    budget: Budget,
    diagnostics: Diagnostics,
    gather: Gather,
    batches: Vec<Batch>,
    /// Identifier of the last row of the batch before; only kept where rows may continue paths.
    last_id: Option<String>,
}

/// What the paths of a table are called.
struct Identified {
    ids: TextColumn,
    refused: Refused,
    /// Number of paths without an identifier.
    unnamed: u64,
}

impl Reader<'_> {
    fn read_batches(&mut self, bytes: &Buffer, container: &Container) -> Result<(), Problem> {
        let total = container.messages.len();
        let mut decoder = Decoder::new(bytes, Arc::new(container.schema.clone()));
        for (index, message) in container.messages.iter().enumerate() {
            if let Some(progress) = self.source.options.progress {
                progress.advance(index as u64, total as u64);
                if progress.cancelled() {
                    return Err(Problem::Cancelled);
                }
            }
            if let Some(batch) = decoder.decode(message, &self.budget)? {
                self.add(&batch, bytes.len(), total - index)?;
            }
        }
        Ok(())
    }

    /// Takes the curves of a batch at once, so that their buffers can go; keeps its other columns.
    fn add(&mut self, batch: &RecordBatch, file_bytes: usize, left: usize) -> Result<(), Problem> {
        let polygons = Polygons::of(batch.column(self.columns.control_points))?;
        self.check_size(&polygons)?;
        if self.batches.is_empty() {
            let point_bytes = match polygons.coordinates {
                Coordinates::F32(_) => 8,
                Coordinates::F64(_) => 16,
            };
            // As if all batches were like this one, but no more than the file can hold.
            let guess = (polygons.point_count() as usize).saturating_mul(left);
            self.gather
                .reserve(&polygons, guess.min(file_bytes / point_bytes));
        }
        let first_row = self.gather.rows();
        match self.columns.part {
            None => self.gather.add(&polygons, self.limits)?,
            Some(part) => {
                let continues = self.continues(batch, part, first_row)?;
                self.gather.add_parts(&polygons, &continues, self.limits)?;
            }
        }
        let mut columns = batch.columns().to_vec();
        columns[self.columns.control_points] = Arc::new(NullArray::new(0));
        self.batches.push(Batch {
            first_row,
            rows: polygons.len(),
            columns,
        });
        Ok(())
    }

    /// Views may name the same points again and again, which are then copied again and again.
    fn check_size(&mut self, polygons: &Polygons) -> Result<(), Problem> {
        let (held, bytes) = match &polygons.coordinates {
            Coordinates::F32(c) => (c.len() / 2, 8),
            Coordinates::F64(c) => (c.len() / 2, 16),
        };
        let again = polygons.point_count().saturating_sub(held as u64);
        self.budget.charge(again.saturating_mul(bytes))
    }

    /// Which rows continue the path of the row before.
    fn continues(
        &mut self,
        batch: &RecordBatch,
        part: usize,
        first_row: usize,
    ) -> Result<Vec<bool>, Problem> {
        let parts = cast(batch.column(part), &DataType::Int64)?;
        let parts = parts.as_primitive::<arrow_array::types::Int64Type>();
        let ids = self.ids(batch.columns())?;
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

    fn ids<'c>(&self, columns: &'c [ArrayRef]) -> Result<Option<Texts<'c>>, Problem> {
        self.columns
            .id
            .map(|id| Texts::of_id(&columns[id]))
            .transpose()
    }

    fn into_layout(mut self, schema: &Schema, version: u32) -> Result<Layout, Problem> {
        let rows = self.gather.rows();
        let refused = std::mem::take(&mut self.gather.refused);
        let table = Table {
            batches: std::mem::take(&mut self.batches),
            kept: std::mem::take(&mut self.gather.kept),
        };
        let geometry = std::mem::take(&mut self.gather).into_geometry();
        let converter = Converter {
            table: &table,
            limits: self.limits,
            budget: &self.budget,
        };
        let mut plans = Vec::new();
        for &index in &self.columns.attributes {
            plans.extend(converter.plan(index, schema.field(index), &mut self.diagnostics)?);
        }
        let (identified, attributes) = rayon::join(
            || self.identify(&table, &refused),
            || -> Vec<Result<Attribute, Problem>> {
                let plans = plans.par_iter();
                plans.map(|plan| converter.attribute(plan)).collect()
            },
        );
        let Identified {
            ids,
            refused,
            unnamed,
        } = identified?;
        self.note_unnamed(unnamed);
        let mut paths = Paths::from_columns(ids, geometry);
        for attribute in attributes {
            paths.attributes.insert(attribute?);
        }
        let levels = self.set_levels(&table, &mut paths)?;
        self.set_style(&table, &mut paths)?;
        Ok(Layout {
            provenance: Provenance {
                source: self.source.name.to_owned(),
                format: Format::Arrow.name().to_owned(),
                format_version: version.to_string(),
                counts: vec![
                    ("rows".into(), rows as u64),
                    ("record batches".into(), table.batches.len() as u64),
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

    /// The identifiers of drawn and of refused paths; the row number where there is none.
    fn identify(&self, table: &Table, faults: &[(usize, Fault)]) -> Result<Identified, Problem> {
        let mut ids = TextSink::new(self.limits, table.path_count());
        let mut refused = Refused::default();
        let mut faults = faults.iter().peekable();
        let mut unnamed = 0_u64;
        for batch in &table.batches {
            let texts = self.ids(&batch.columns)?;
            let text = |row: usize| texts.as_ref().and_then(|texts| texts.get(row));
            for rows in table.stretches_in(batch) {
                let number = |row: usize| {
                    unnamed += 1;
                    (batch.first_row + row).to_string()
                };
                ids.push_rows(texts.as_ref(), rows, number, &self.budget)?;
            }
            let end = batch.first_row + batch.rows;
            while let Some(&(row, fault)) = faults.next_if(|f| f.0 < end) {
                let number = row.to_string();
                let id = text(row - batch.first_row).unwrap_or(&number);
                self.budget.charge(id.len() as u64)?;
                refused.push(id, fault.code(), &fault.detail(self.limits));
            }
        }
        Ok(Identified {
            ids: ids.into_column(),
            refused,
            unnamed,
        })
    }

    fn note_unnamed(&mut self, unnamed: u64) {
        if unnamed == 0 {
            return;
        }
        self.diagnostics.push(
            Code::Attribute,
            || Place::element("column id"),
            || format!("{unnamed} paths have no id; the number of their row is used"),
            "Give every path an id, so that it is found again after the file has changed",
        );
    }

    fn set_levels(&mut self, table: &Table, paths: &mut Paths) -> Result<Vec<Level>, Problem> {
        let Some(index) = self.columns.level else {
            return Ok(Vec::new());
        };
        let mut known: HashMap<String, u32> = HashMap::new();
        let mut levels: Vec<Level> = Vec::new();
        let mut column = Vec::with_capacity(paths.len());
        for batch in &table.batches {
            let Some(texts) = Texts::of(&batch.columns[index]) else {
                continue;
            };
            for row in table.kept_in(batch) {
                let Some(id) = texts.get(row) else {
                    column.push(u32::MAX);
                    continue;
                };
                if let Some(&level) = known.get(id) {
                    column.push(level);
                    continue;
                }
                self.budget.charge(2 * id.len() as u64)?;
                let level = levels.len() as u32;
                known.insert(id.to_owned(), level);
                levels.push(Level {
                    id: id.to_owned(),
                    ..Level::default()
                });
                column.push(level);
            }
        }
        paths.set_levels(column);
        Ok(levels)
    }

    fn set_style(&mut self, table: &Table, paths: &mut Paths) -> Result<(), Problem> {
        if let Some(index) = self.columns.width {
            let widths = numbers::<Float32Type>(table, index, &DataType::Float32)?;
            let fits = |width: &f32| width.is_finite() && *width >= 0.0;
            let bad = widths.iter().flatten().filter(|w| !fits(w)).count();
            self.note_unfit(bad, "width_m", "a number of metres from 0");
            let width = |width: Option<f32>| width.filter(fits).unwrap_or(f32::NAN);
            paths.set_width_m(widths.into_iter().map(width).collect());
        }
        if let Some(index) = self.columns.color {
            let colors = numbers::<UInt32Type>(table, index, &DataType::UInt32)?;
            self.note_unfit(
                count_lost(table, index, &DataType::UInt32)?,
                "color",
                "0xRRGGBBAA",
            );
            paths.set_color_rgba(colors.into_iter().map(Option::unwrap_or_default).collect());
        }
        if let Some(index) = self.columns.rank {
            let ranks = numbers::<Int32Type>(table, index, &DataType::Int32)?;
            self.note_unfit(
                count_lost(table, index, &DataType::Int32)?,
                "rank",
                "a whole number of 32 bits",
            );
            // As for paths that are pushed without a rank: file order.
            let in_order = |(row, rank): (usize, Option<i32>)| {
                rank.unwrap_or_else(|| i32::try_from(row).unwrap_or(i32::MAX))
            };
            paths.set_rank(ranks.into_iter().enumerate().map(in_order).collect());
        }
        Ok(())
    }

    fn note_unfit(&mut self, count: usize, column: &str, expected: &str) {
        if count == 0 {
            return;
        }
        self.diagnostics.push(
            Code::UnknownValue,
            || Place::element(format!("column {column}")),
            || format!("{count} values are not {expected}"),
            "Correct the values; they are taken as not given",
        );
    }
}

/// Number of values that do not fit `target`.
fn count_lost(table: &Table, index: usize, target: &DataType) -> Result<usize, Problem> {
    let mut lost = 0;
    for batch in &table.batches {
        let column = &batch.columns[index];
        if column.data_type() != target {
            let cast = cast(column, target)?;
            lost += cast
                .logical_null_count()
                .saturating_sub(column.logical_null_count());
        }
    }
    Ok(lost)
}
