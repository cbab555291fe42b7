//! Attribute columns: converts the columns without a meaning to attributes, batch by batch.

use std::fmt::Display;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{Array, Int64Array};
use arrow_schema::{DataType, Field};
use guideway_layout::{Attribute, Cells, Code, Diagnostics, Place, Values};

use super::attribute_names::attribute_of;
use super::batch::Batch;
use super::cast::{count_lost, numbers, truth_values};
use super::cell_formatter::CellFormatter;
use super::column_names::PATHS_VERSION;
use super::column_types::{is_text, value_type};
use super::reading::Reading;
use super::schema::{is_json, quantity};
use super::text_array::TextArray;
use super::text_sink::TextSink;
use crate::Problem;

/// An attribute of a table under construction from a column.
pub(super) struct AttributeColumn<'a> {
    index: usize,
    field: &'a Field,
    reading: Reading<'a>,
    /// Estimated number of rows.
    rows: usize,
    /// Number of rows before the first value.
    missing: usize,
    /// `None` before the first value: a column of another table takes no memory.
    cells: Option<AttributeCells<'a>>,
}

/// Values of an attribute, by type.
enum AttributeCells<'a> {
    /// The column has no values.
    Null,
    Bool(Cells<bool>),
    Int(Cells<i64>),
    Float(Cells<f64>),
    Text(TextCells<'a>),
    /// Text formatted from values of a type that layouts do not have.
    Formatted(TextCells<'a>),
}

/// Texts, of which some may be missing.
struct TextCells<'a> {
    sink: TextSink<'a>,
    present: Vec<bool>,
    /// Number of values that have no text, and are missing.
    lost: u64,
}

impl<'a> AttributeColumn<'a> {
    /// Makes an attribute of column `index`, with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, index: usize, rows: usize) -> Self {
        Self {
            index,
            field: reading.schema.field(index),
            reading,
            rows,
            missing: 0,
            cells: None,
        }
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = &batch.columns[self.index];
        let Some(cells) = &mut self.cells else {
            let mut rows = batch.drawn.iter().cloned().flatten();
            if column.null_count() > 0 && rows.all(|row| column.is_null(row)) {
                self.missing += batch.drawn_rows();
                return Ok(());
            }
            self.cells = Some(self.first_cells()?);
            return self.add(batch);
        };
        match cells {
            AttributeCells::Null => {}
            AttributeCells::Bool(out) => {
                let column = truth_values(column)?;
                let get = |row| column.is_valid(row).then(|| column.value(row));
                let rows = batch.drawn.iter().cloned().flatten();
                rows.for_each(|row| out.push(get(row)));
            }
            AttributeCells::Int(out) => {
                let whole: Int64Array = numbers(column)?;
                if count_lost(column, &whole) > 0 {
                    // An unsigned number beyond the range of i64: all values are converted to text.
                    let texts = TextCells::from_numbers(out, self.reading)?;
                    self.cells = Some(AttributeCells::Formatted(texts));
                    return self.add(batch);
                }
                batch.add_cells(out, &whole, |v| v);
            }
            AttributeCells::Float(out) => match column.as_primitive_opt::<Float32Type>() {
                Some(narrow) => batch.add_cells(out, narrow, f64::from),
                None => batch.add_cells(out, &numbers::<Float64Type>(column)?, |v| v),
            },
            AttributeCells::Text(texts) => texts.add_texts(batch, self.index)?,
            AttributeCells::Formatted(texts) => texts.add_formatted(batch, self.index)?,
        }
        Ok(())
    }

    /// Returns the attribute; `None` if it has no values, unless it `keeps_empty` columns.
    pub(super) fn finish(
        mut self,
        keeps_empty: bool,
        diagnostics: &mut Diagnostics,
    ) -> Result<Option<Attribute>, Problem> {
        let field = self.field;
        let value_type = value_type(field.data_type());
        let source_unless =
            |stored: DataType| (*value_type != stored).then(|| value_type.to_string());
        let cells = match self.cells.take() {
            None if keeps_empty => self.first_cells()?,
            None => return Ok(None),
            Some(cells) => cells,
        };
        let (values, source_type) = match cells {
            AttributeCells::Null => {
                report(field, "has no values and is ignored", diagnostics);
                return Ok(None);
            }
            AttributeCells::Bool(values) => (Values::Bool(values), None),
            AttributeCells::Int(values) => (Values::Int(values), source_unless(DataType::Int64)),
            AttributeCells::Float(values) => {
                (Values::Float(values), source_unless(DataType::Float64))
            }
            AttributeCells::Text(texts) if is_json(field) => {
                (Values::Json(texts.into_cells()), None)
            }
            AttributeCells::Text(texts) => (Values::Text(texts.into_cells()), None),
            AttributeCells::Formatted(texts) => {
                report(field, "is stored as text", diagnostics);
                if texts.lost > 0 {
                    let lost = format!("has {} values that have no text", texts.lost);
                    report(field, &lost, diagnostics);
                }
                (Values::Text(texts.into_cells()), None)
            }
        };
        Ok(Some(Attribute {
            quantity: quantity(field),
            name: match self.reading.columns.version {
                PATHS_VERSION => field.name().clone(),
                _ => attribute_of(field.name()).to_owned(),
            },
            values,
            source_type,
        }))
    }

    /// Makes the cells of the rows so far, which have no values.
    fn first_cells(&self) -> Result<AttributeCells<'a>, Problem> {
        let (rows, missing) = (self.rows, self.missing);
        Ok(match value_type(self.field.data_type()) {
            DataType::Null => AttributeCells::Null,
            DataType::Boolean => AttributeCells::Bool(without_values(rows, missing)),
            t if t.is_integer() => AttributeCells::Int(without_values(rows, missing)),
            t if t.is_floating() => AttributeCells::Float(without_values(rows, missing)),
            _ => {
                let mut texts = TextCells::new(self.reading, rows);
                for _ in 0..missing {
                    texts.push(None::<&str>)?;
                }
                match is_text(self.field.data_type()) {
                    true => AttributeCells::Text(texts),
                    false => AttributeCells::Formatted(texts),
                }
            }
        })
    }
}

/// Makes cells with capacity for `rows` rows, of which the first ones have no value.
fn without_values<T: Copy + Default>(rows: usize, missing: usize) -> Cells<T> {
    let mut cells = Cells::with_capacity(rows);
    (0..missing).for_each(|_| cells.push(None));
    cells
}

impl<'a> TextCells<'a> {
    fn new(reading: Reading<'a>, rows: usize) -> Self {
        Self {
            sink: TextSink::new(reading.limits, reading.budget, rows),
            present: Vec::with_capacity(rows),
            lost: 0,
        }
    }

    fn from_numbers(numbers: &Cells<i64>, reading: Reading<'a>) -> Result<Self, Problem> {
        let mut texts = Self::new(reading, numbers.len());
        for number in numbers.iter() {
            texts.push(number)?;
        }
        Ok(texts)
    }

    /// Appends a value, formatted as text. One that cannot be formatted is lost.
    fn push(&mut self, value: Option<impl Display>) -> Result<(), Problem> {
        let has_text = match &value {
            Some(value) => self.sink.push_formatted(value)?,
            None => false,
        };
        self.present.push(has_text);
        self.lost += u64::from(value.is_some() && !has_text);
        match has_text {
            true => Ok(()),
            false => self.sink.push(""),
        }
    }

    fn add_texts(&mut self, batch: &Batch, index: usize) -> Result<(), Problem> {
        let Self { sink, present, .. } = self;
        let texts = TextArray::new(&batch.columns[index])?;
        for rows in batch.drawn.iter().cloned() {
            let (first_row, first) = (rows.start, present.len());
            present.resize(first + rows.len(), true);
            let missing = |row: usize| {
                present[first + row - first_row] = false;
                String::new()
            };
            sink.push_rows(Some(&texts), rows, missing)?;
        }
        Ok(())
    }

    fn add_formatted(&mut self, batch: &Batch, index: usize) -> Result<(), Problem> {
        let column = &batch.columns[index];
        let nulls = column.logical_nulls();
        let formatter = CellFormatter::new(column);
        for row in batch.drawn.iter().cloned().flatten() {
            let here = nulls.as_ref().is_none_or(|n| n.is_valid(row));
            self.push(here.then(|| formatter.cell(row)))?;
        }
        Ok(())
    }

    fn into_cells(self) -> guideway_layout::TextCells {
        let text = self.sink.into_column();
        guideway_layout::TextCells::from_column(&text, &self.present)
    }
}

fn report(field: &Field, what: &str, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Code::Attribute,
        || Place::element(format!("column {}", field.name())),
        || format!("a column of type {} {what}", field.data_type()),
        "Write it as bool, int, float or text to keep its type",
    );
}
