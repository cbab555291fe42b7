//! Attribute columns: converts the columns without a meaning to attributes, batch by batch.

use std::fmt::Display;

use arrow_array::Array;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int64Type};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{DataType, Field};
use guideway_layout::{Attribute, Cells, Code, Diagnostics, Limits, Place, Values};

use super::batch::Batch;
use super::budget::Budget;
use super::cast::{cast, count_lost};
use super::catch_decode_panic::catch_decode_panic;
use super::problems::damaged;
use super::schema::is_text;
use super::text_array::TextArray;
use super::text_sink::TextSink;
use crate::Problem;

/// An attribute under construction from a column.
pub(super) struct AttributeColumn<'a> {
    index: usize,
    field: &'a Field,
    limits: &'a Limits,
    budget: &'a Budget,
    cells: AttributeCells<'a>,
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
}

impl<'a> AttributeColumn<'a> {
    /// Makes an attribute of column `index`, with capacity for an estimated number of rows.
    pub(super) fn new(
        index: usize,
        field: &'a Field,
        rows: usize,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Self {
        let texts = || TextCells::new(rows, limits, budget);
        let cells = match value_type(field) {
            DataType::Null => AttributeCells::Null,
            DataType::Boolean => AttributeCells::Bool(Cells::with_capacity(rows)),
            t if t.is_integer() => AttributeCells::Int(Cells::with_capacity(rows)),
            t if t.is_floating() => AttributeCells::Float(Cells::with_capacity(rows)),
            _ if is_text(field.data_type()) => AttributeCells::Text(texts()),
            _ => AttributeCells::Formatted(texts()),
        };
        Self {
            index,
            field,
            limits,
            budget,
            cells,
        }
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = &batch.columns[self.index];
        match &mut self.cells {
            AttributeCells::Null => {}
            AttributeCells::Bool(out) => {
                let column = cast(column, &DataType::Boolean)?;
                let column = column.as_boolean();
                let get = |row| column.is_valid(row).then(|| column.value(row));
                let rows = batch.drawn.iter().cloned().flatten();
                rows.for_each(|row| out.push(get(row)));
            }
            AttributeCells::Int(out) => {
                let numbers = cast(column, &DataType::Int64)?;
                if count_lost(column, &numbers) > 0 {
                    // An unsigned number beyond the range of i64: all values are converted to text.
                    let texts = TextCells::from_numbers(out, self.limits, self.budget)?;
                    self.cells = AttributeCells::Formatted(texts);
                    return self.add(batch);
                }
                batch.add_cells(out, numbers.as_primitive::<Int64Type>(), |v| v);
            }
            AttributeCells::Float(out) => match column.as_primitive_opt::<Float32Type>() {
                Some(narrow) => batch.add_cells(out, narrow, f64::from),
                None => {
                    let numbers = cast(column, &DataType::Float64)?;
                    batch.add_cells(out, numbers.as_primitive::<Float64Type>(), |v| v);
                }
            },
            AttributeCells::Text(texts) => texts.add_texts(batch, self.index)?,
            AttributeCells::Formatted(texts) => texts.add_formatted(batch, self.index)?,
        }
        Ok(())
    }

    /// Returns the attribute, if the column has values.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> Option<Attribute> {
        let field = self.field;
        let value_type = value_type(field);
        let source_unless =
            |stored: DataType| (*value_type != stored).then(|| value_type.to_string());
        let (values, source_type) = match self.cells {
            AttributeCells::Null => {
                report(field, "has no values and is ignored", diagnostics);
                return None;
            }
            AttributeCells::Bool(values) => (Values::Bool(values), None),
            AttributeCells::Int(values) => (Values::Int(values), source_unless(DataType::Int64)),
            AttributeCells::Float(values) => {
                (Values::Float(values), source_unless(DataType::Float64))
            }
            AttributeCells::Text(texts) => (texts.into_values(), None),
            AttributeCells::Formatted(texts) => {
                report(field, "is stored as text", diagnostics);
                (texts.into_values(), None)
            }
        };
        Some(Attribute {
            quantity: None,
            name: field.name().clone(),
            values,
            source_type,
        })
    }
}

impl<'a> TextCells<'a> {
    fn new(rows: usize, limits: &'a Limits, budget: &'a Budget) -> Self {
        Self {
            sink: TextSink::new(limits, budget, rows),
            present: Vec::with_capacity(rows),
        }
    }

    fn from_numbers(
        numbers: &Cells<i64>,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Result<Self, Problem> {
        let mut texts = Self::new(numbers.len(), limits, budget);
        for number in numbers.iter() {
            texts.push(number)?;
        }
        Ok(texts)
    }

    /// Appends a value, formatted as text.
    fn push(&mut self, value: Option<impl Display>) -> Result<(), Problem> {
        self.present.push(value.is_some());
        match value {
            Some(value) => self.sink.push_formatted(value),
            None => self.sink.push(""),
        }
    }

    fn add_texts(&mut self, batch: &Batch, index: usize) -> Result<(), Problem> {
        let Self { sink, present } = self;
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
        let options = FormatOptions::default();
        catch_decode_panic("attribute", || {
            let formatter = ArrayFormatter::try_new(column, &options)
                .map_err(|e| damaged("attribute", e.to_string()))?;
            for row in batch.drawn.iter().cloned().flatten() {
                let here = nulls.as_ref().is_none_or(|n| n.is_valid(row));
                self.push(here.then(|| formatter.value(row)))?;
            }
            Ok(())
        })
    }

    fn into_values(self) -> Values {
        let text = self.sink.into_column();
        Values::Text(guideway_layout::TextCells::from_column(
            &text,
            &self.present,
        ))
    }
}

fn value_type(field: &Field) -> &DataType {
    match field.data_type() {
        DataType::Dictionary(_, values) => values,
        plain => plain,
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
