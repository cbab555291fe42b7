use std::fmt::Display;

use arrow_array::Array;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int64Type};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{DataType, Field};
use guideway_layout::{Attribute, Cells, Code, Diagnostics, Limits, Place, Values};

use super::batch::{Batch, cast, count_lost};
use super::budget::Budget;
use super::guard::{damaged, guarded};
use super::schema::is_text;
use super::text::Texts;
use super::text_sink::TextSink;
use crate::Problem;

/// A column that becomes an attribute, batch by batch.
pub(super) struct Growing<'a> {
    index: usize,
    field: &'a Field,
    limits: &'a Limits,
    budget: &'a Budget,
    held: Held<'a>,
}

/// What the values of a column become.
enum Held<'a> {
    /// There are none.
    Nothing,
    Bool(Cells<bool>),
    Int(Cells<i64>),
    Float(Cells<f64>),
    Text(Labels<'a>),
    /// Text made from values of a type that layouts do not have.
    Written(Labels<'a>),
}

/// Texts, of which some may be missing.
struct Labels<'a> {
    sink: TextSink<'a>,
    present: Vec<bool>,
}

impl<'a> Growing<'a> {
    /// Column `index`, with room for about so many rows.
    pub(super) fn new(
        index: usize,
        field: &'a Field,
        rows: usize,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Self {
        let labels = || Labels::new(rows, limits, budget);
        let held = match value_type(field) {
            DataType::Null => Held::Nothing,
            DataType::Boolean => Held::Bool(Cells::with_capacity(rows)),
            t if t.is_integer() => Held::Int(Cells::with_capacity(rows)),
            t if t.is_floating() => Held::Float(Cells::with_capacity(rows)),
            _ if is_text(field.data_type()) => Held::Text(labels()),
            _ => Held::Written(labels()),
        };
        Self {
            index,
            field,
            limits,
            budget,
            held,
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = &batch.columns[self.index];
        match &mut self.held {
            Held::Nothing => {}
            Held::Bool(out) => {
                let column = cast(column, &DataType::Boolean)?;
                let column = column.as_boolean();
                let get = |row| column.is_valid(row).then(|| column.value(row));
                let rows = batch.kept.iter().cloned().flatten();
                rows.for_each(|row| out.push(get(row)));
            }
            Held::Int(out) => {
                let numbers = cast(column, &DataType::Int64)?;
                if count_lost(column, &numbers) > 0 {
                    // Numbers of 64 bits without a sign: if one is too large, all become text.
                    let labels = Labels::of_numbers(out, self.limits, self.budget)?;
                    self.held = Held::Written(labels);
                    return self.add(batch);
                }
                batch.add_cells(out, numbers.as_primitive::<Int64Type>(), |v| v);
            }
            Held::Float(out) => match column.as_primitive_opt::<Float32Type>() {
                Some(narrow) => batch.add_cells(out, narrow, f64::from),
                None => {
                    let numbers = cast(column, &DataType::Float64)?;
                    batch.add_cells(out, numbers.as_primitive::<Float64Type>(), |v| v);
                }
            },
            Held::Text(labels) => labels.add_texts(batch, self.index)?,
            Held::Written(labels) => labels.add_written(batch, self.index)?,
        }
        Ok(())
    }

    /// The attribute, if the column holds values.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> Option<Attribute> {
        let field = self.field;
        let value_type = value_type(field);
        let unless = |held: DataType| (*value_type != held).then(|| value_type.to_string());
        let (values, source_type) = match self.held {
            Held::Nothing => {
                note(field, "has no values and is left out", diagnostics);
                return None;
            }
            Held::Bool(values) => (Values::Bool(values), None),
            Held::Int(values) => (Values::Int(values), unless(DataType::Int64)),
            Held::Float(values) => (Values::Float(values), unless(DataType::Float64)),
            Held::Text(labels) => (labels.into_values(), None),
            Held::Written(labels) => {
                note(field, "is kept as text", diagnostics);
                (labels.into_values(), None)
            }
        };
        Some(Attribute {
            name: field.name().clone(),
            values,
            source_type,
        })
    }
}

impl<'a> Labels<'a> {
    fn new(rows: usize, limits: &'a Limits, budget: &'a Budget) -> Self {
        Self {
            sink: TextSink::new(limits, budget, rows),
            present: Vec::with_capacity(rows),
        }
    }

    fn of_numbers(
        numbers: &Cells<i64>,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Result<Self, Problem> {
        let mut labels = Self::new(numbers.len(), limits, budget);
        for number in numbers.iter() {
            labels.push(number)?;
        }
        Ok(labels)
    }

    /// Appends what a value is written as.
    fn push(&mut self, value: Option<impl Display>) -> Result<(), Problem> {
        self.present.push(value.is_some());
        match value {
            Some(value) => self.sink.push_written(value),
            None => self.sink.push(""),
        }
    }

    fn add_texts(&mut self, batch: &Batch, index: usize) -> Result<(), Problem> {
        let Self { sink, present } = self;
        let texts = Texts::of_text(&batch.columns[index])?;
        for rows in batch.kept.iter().cloned() {
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

    fn add_written(&mut self, batch: &Batch, index: usize) -> Result<(), Problem> {
        let column = &batch.columns[index];
        let nulls = column.logical_nulls();
        let options = FormatOptions::default();
        guarded("attribute", || {
            let formatter = ArrayFormatter::try_new(column, &options)
                .map_err(|e| damaged("attribute", e.to_string()))?;
            for row in batch.kept.iter().cloned().flatten() {
                let here = nulls.as_ref().is_none_or(|n| n.is_valid(row));
                self.push(here.then(|| formatter.value(row)))?;
            }
            Ok(())
        })
    }

    fn into_values(self) -> Values {
        Values::Text {
            text: self.sink.into_column(),
            present: self.present,
        }
    }
}

fn value_type(field: &Field) -> &DataType {
    match field.data_type() {
        DataType::Dictionary(_, values) => values,
        plain => plain,
    }
}

fn note(field: &Field, what: &str, diagnostics: &mut Diagnostics) {
    diagnostics.push(
        Code::Attribute,
        || Place::element(format!("column {}", field.name())),
        || format!("a column of type {} {what}", field.data_type()),
        "Write it as bool, int, float or text to keep it as it is",
    );
}
