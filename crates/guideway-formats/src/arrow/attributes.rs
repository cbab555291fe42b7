use std::fmt::{self, Write};
use std::ops::Range;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, ArrowPrimitiveType};
use arrow_cast::display::{ArrayFormatter, FormatOptions};
use arrow_schema::{DataType, Field};
use guideway_layout::{Attribute, Code, Diagnostics, Limits, Place, TextColumn, Values};

use super::budget::Budget;
use super::guard::{damaged, guarded};
use super::schema::is_text;
use super::table::Table;
use super::text::Texts;
use crate::Problem;

/// What the values of a column become.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Bool,
    Int,
    Float,
    Text,
    /// Text made from a value of a type that layouts do not have.
    Written,
}

/// A column that becomes an attribute.
pub(super) struct Plan {
    index: usize,
    name: String,
    kind: Kind,
    /// Where it is not that of the values held.
    source_type: Option<String>,
}

/// Converts columns to attributes.
pub(super) struct Converter<'a> {
    pub(super) table: &'a Table,
    pub(super) limits: &'a Limits,
    pub(super) budget: &'a Budget,
}

impl Converter<'_> {
    /// What column `index` becomes, if it holds values.
    pub(super) fn plan(
        &self,
        index: usize,
        field: &Field,
        diagnostics: &mut Diagnostics,
    ) -> Result<Option<Plan>, Problem> {
        let value_type = match field.data_type() {
            DataType::Dictionary(_, values) => values.as_ref(),
            plain => plain,
        };
        let Some(mut kind) = kind(field.data_type(), value_type) else {
            note(field, "has no values and is left out", diagnostics);
            return Ok(None);
        };
        let mut source_type = match kind {
            Kind::Int if *value_type != DataType::Int64 => Some(value_type.to_string()),
            Kind::Float if *value_type != DataType::Float64 => Some(value_type.to_string()),
            _ => None,
        };
        if kind == Kind::Int && *value_type == DataType::UInt64 && !self.fits_i64(index)? {
            (kind, source_type) = (Kind::Written, None);
        }
        if kind == Kind::Written {
            note(field, "is kept as text", diagnostics);
        }
        Ok(Some(Plan {
            index,
            name: field.name().clone(),
            kind,
            source_type,
        }))
    }

    /// The attribute that a column becomes.
    pub(super) fn attribute(&self, plan: &Plan) -> Result<Attribute, Problem> {
        let values = match plan.kind {
            Kind::Bool => self.bools(plan.index)?,
            Kind::Int => self.ints(plan.index)?,
            Kind::Float => self.floats(plan.index)?,
            Kind::Text => self.texts(plan.index)?,
            Kind::Written => self.written(plan.index)?,
        };
        let mut attribute = Attribute::new(&plan.name, values);
        attribute.source_type.clone_from(&plan.source_type);
        Ok(attribute)
    }

    fn fits_i64(&self, index: usize) -> Result<bool, Problem> {
        for batch in &self.table.batches {
            let column = &batch.columns[index];
            if cast(column, &DataType::Int64)?.logical_null_count() > column.logical_null_count() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn bools(&self, index: usize) -> Result<Values, Problem> {
        let mut out = Vec::with_capacity(self.table.path_count());
        for batch in &self.table.batches {
            let column = cast(&batch.columns[index], &DataType::Boolean)?;
            let column = column.as_boolean();
            let get = |row| column.is_valid(row).then(|| column.value(row));
            out.extend(self.table.kept_in(batch).map(get));
        }
        Ok(Values::Bool(out))
    }

    fn ints(&self, index: usize) -> Result<Values, Problem> {
        let numbers = numbers::<Int64Type>(self.table, index, &DataType::Int64)?;
        Ok(Values::Int(numbers))
    }

    fn floats(&self, index: usize) -> Result<Values, Problem> {
        let numbers = numbers::<Float64Type>(self.table, index, &DataType::Float64)?;
        Ok(Values::Float(numbers))
    }

    fn texts(&self, index: usize) -> Result<Values, Problem> {
        let mut sink = TextSink::new(self.limits, self.table.path_count());
        let mut present = Vec::with_capacity(self.table.path_count());
        for batch in &self.table.batches {
            let texts = Texts::of(&batch.columns[index])
                .ok_or_else(|| damaged("dictionary", "its values are not text"))?;
            for rows in self.table.stretches_in(batch) {
                let (first_row, first) = (rows.start, present.len());
                present.resize(first + rows.len(), true);
                let missing = |row: usize| {
                    present[first + row - first_row] = false;
                    String::new()
                };
                sink.push_rows(Some(&texts), rows, missing, self.budget)?;
            }
        }
        let text = sink.into_column();
        Ok(Values::Text { text, present })
    }

    fn written(&self, index: usize) -> Result<Values, Problem> {
        let mut sink = TextSink::new(self.limits, self.table.path_count());
        let mut present = Vec::with_capacity(self.table.path_count());
        let options = FormatOptions::default();
        for batch in &self.table.batches {
            let column = &batch.columns[index];
            let nulls = column.logical_nulls();
            guarded("attribute", || {
                let formatter = ArrayFormatter::try_new(column, &options)
                    .map_err(|e| damaged("attribute", e.to_string()))?;
                for row in self.table.kept_in(batch) {
                    let here = nulls.as_ref().is_none_or(|n| n.is_valid(row));
                    present.push(here);
                    let mut text = Bounded::new(self.limits.text_bytes);
                    if here && write!(text, "{}", formatter.value(row)).is_err() {
                        return Err(text.problem("the value cannot be written as text"));
                    }
                    sink.push(&text.text, self.budget)?;
                }
                Ok(())
            })?;
        }
        let text = sink.into_column();
        Ok(Values::Text { text, present })
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

/// What values of a type become; none if there are no values of it.
fn kind(data_type: &DataType, value_type: &DataType) -> Option<Kind> {
    Some(match value_type {
        DataType::Null => return None,
        DataType::Boolean => Kind::Bool,
        t if t.is_integer() => Kind::Int,
        t if t.is_floating() => Kind::Float,
        _ if is_text(data_type) => Kind::Text,
        _ => Kind::Written,
    })
}

/// The values of the kept rows as numbers of one type; null where a value does not fit it.
pub(super) fn numbers<T: ArrowPrimitiveType>(
    table: &Table,
    index: usize,
    target: &DataType,
) -> Result<Vec<Option<T::Native>>, Problem> {
    let mut out = Vec::with_capacity(table.path_count());
    for batch in &table.batches {
        let column = cast(&batch.columns[index], target)?;
        let column = column.as_primitive::<T>();
        let get = |row| column.is_valid(row).then(|| column.value(row));
        for rows in table.stretches_in(batch) {
            match column.null_count() {
                0 => out.extend(column.values()[rows].iter().map(|&value| Some(value))),
                _ => out.extend(rows.map(get)),
            }
        }
    }
    Ok(out)
}

/// The column in another type; values that do not fit it become null.
pub(super) fn cast(column: &ArrayRef, target: &DataType) -> Result<ArrayRef, Problem> {
    guarded("column", || {
        arrow_cast::cast(column, target).map_err(|e| damaged("column", e.to_string()))
    })
}

/// Collects a column of text within the limits.
pub(super) struct TextSink<'a> {
    column: TextColumn,
    limits: &'a Limits,
    bytes: usize,
}

impl<'a> TextSink<'a> {
    pub(super) fn new(limits: &'a Limits, rows: usize) -> Self {
        Self {
            column: TextColumn::with_capacity(rows, 0),
            limits,
            bytes: 0,
        }
    }

    pub(super) fn push(&mut self, text: &str, budget: &Budget) -> Result<(), Problem> {
        self.check(text.len(), text.len(), budget)?;
        self.column.push(text);
        Ok(())
    }

    /// Appends some rows, and what `missing` says in place of those that have no text.
    pub(super) fn push_rows(
        &mut self,
        texts: Option<&Texts>,
        rows: Range<usize>,
        mut missing: impl FnMut(usize) -> String,
        budget: &Budget,
    ) -> Result<(), Problem> {
        if let Some(all) = texts.and_then(|texts| texts.side_by_side(rows.clone())) {
            let longest = all.lengths().max().unwrap_or_default();
            self.check(all.text.len(), longest, budget)?;
            self.column.push_all(all.text, all.ends());
            return Ok(());
        }
        for row in rows {
            match texts.and_then(|texts| texts.get(row)) {
                Some(text) => self.push(text, budget)?,
                None => self.push(&missing(row), budget)?,
            }
        }
        Ok(())
    }

    /// Whether so many bytes more may be held, of which so many are one text.
    fn check(&mut self, bytes: usize, longest: usize, budget: &Budget) -> Result<(), Problem> {
        if longest > self.limits.text_bytes {
            return Err(too_long(self.limits.text_bytes, longest));
        }
        budget.charge(bytes as u64)?;
        self.bytes += bytes;
        if self.bytes > TextColumn::MAX_BYTES {
            return Err(Problem::LimitReached {
                what: "bytes in a column of text",
                limit: TextColumn::MAX_BYTES as u64,
                actual: self.bytes as u64,
            });
        }
        Ok(())
    }

    pub(super) fn into_column(self) -> TextColumn {
        self.column
    }
}

/// Text that stops growing at a limit: nested values can be written out far larger than they are stored.
struct Bounded {
    text: String,
    limit: usize,
    full: bool,
}

impl Bounded {
    fn new(limit: usize) -> Self {
        Self {
            text: String::new(),
            limit,
            full: false,
        }
    }

    fn problem(&self, otherwise: &str) -> Problem {
        if self.full {
            return too_long(self.limit, self.limit + 1);
        }
        damaged("attribute", otherwise)
    }
}

impl Write for Bounded {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if self.text.len() + more.len() > self.limit {
            self.full = true;
            return Err(fmt::Error);
        }
        self.text.push_str(more);
        Ok(())
    }
}

fn too_long(limit: usize, actual: usize) -> Problem {
    Problem::LimitReached {
        what: "bytes in one text",
        limit: limit as u64,
        actual: actual as u64,
    }
}
