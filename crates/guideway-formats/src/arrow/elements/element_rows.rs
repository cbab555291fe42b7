//! Element rows: identifiers, attributes and plain columns of the rows of one kind.

use guideway_layout::{Attribute, Attributes, Diagnostics, TextColumn, Value};

use crate::Problem;
use crate::arrow::attribute_columns::AttributeColumn;
use crate::arrow::attribute_table::{AttributeTable, by_name};
use crate::arrow::batch::Batch;
use crate::arrow::budget::Budget;
use crate::arrow::element::Element;
use crate::arrow::id_column::IdColumn;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;

/// Memory per row, in bytes, that a compressed file need not have.
const ROW_BYTES: u64 = 64;
/// Memory per value of an element with attributes of its own, in bytes.
const OWN_VALUE_BYTES: u64 = 128;

/// Rows of one kind under construction.
pub(super) struct ElementRows<'a> {
    kind: Element,
    reading: Reading<'a>,
    ids: IdColumn<'a>,
    attributes: AttributeTable<'a>,
    roles: Vec<(Role, AttributeColumn<'a>)>,
    count: usize,
}

/// Rows of one kind.
pub(super) struct ReadRows<'a> {
    budget: &'a Budget,
    pub(super) ids: TextColumn,
    /// Several columns may have values of one attribute.
    columns: Vec<Attribute>,
    roles: Vec<(Role, Attribute)>,
}

impl<'a> ElementRows<'a> {
    /// Makes the rows of a kind, with plain columns of text or numbers.
    pub(super) fn new(kind: Element, reading: Reading<'a>, roles: &[Role]) -> Self {
        let column = |&role: &Role| {
            let index = reading.columns.get(role)?;
            Some((role, AttributeColumn::new(reading, index, 0)))
        };
        Self {
            kind,
            reading,
            ids: IdColumn::new(reading, 0),
            attributes: AttributeTable::new(reading, 0),
            roles: roles.iter().filter_map(column).collect(),
            count: 0,
        }
    }

    /// Appends the rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let rows = batch.drawn_rows();
        self.count += rows;
        let (actual, limit) = (self.count as u64, self.reading.limits.elements);
        if actual > limit.min(u64::from(u32::MAX - 1)) {
            return Err(Problem::LimitReached {
                what: "elements of one kind",
                limit,
                actual,
            });
        }
        self.reading.budget.charge(rows as u64 * ROW_BYTES)?;
        self.ids.add(batch)?;
        self.attributes.add(batch)?;
        let mut roles = self.roles.iter_mut();
        roles.try_for_each(|(_, column)| column.add(batch))
    }

    /// Returns the number of rows so far.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Returns the rows.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> Result<ReadRows<'a>, Problem> {
        let mut roles = Vec::new();
        for (role, column) in self.roles {
            let attribute = column.finish(false, diagnostics)?;
            roles.extend(attribute.map(|attribute| (role, attribute)));
        }
        let elements = format!("rows of the kind {}", self.kind.name());
        Ok(ReadRows {
            budget: self.reading.budget,
            ids: self.ids.finish(&elements, diagnostics),
            columns: self.attributes.finish(false, diagnostics)?,
            roles,
        })
    }
}

impl ReadRows<'_> {
    /// Returns the number of rows.
    pub(super) fn len(&self) -> usize {
        self.ids.len()
    }

    fn value(&self, role: Role, row: usize) -> Option<Value<'_>> {
        let (_, column) = self.roles.iter().find(|(r, _)| *r == role)?;
        column.values.get(row)
    }

    /// Returns the number in a plain column.
    pub(super) fn number(&self, role: Role, row: usize) -> Option<f64> {
        match self.value(role, row)? {
            Value::Float(number) => Some(number),
            Value::Int(number) => Some(number as f64),
            // Only unsigned numbers beyond the range of i64 are text here.
            Value::Text(text) => text.parse().ok(),
            Value::Bool(_) | Value::Json(_) => None,
        }
    }

    /// Returns the row number in a plain column; a number that is none gives `u32::MAX`, which no
    /// row has.
    pub(super) fn index(&self, role: Role, row: usize) -> Option<u32> {
        let value = self.value(role, row)?;
        Some(match value {
            Value::Int(number) => u32::try_from(number).unwrap_or(u32::MAX),
            _ => u32::MAX,
        })
    }

    /// Returns the text in a plain column.
    pub(super) fn text(&self, role: Role, row: usize) -> Option<&str> {
        match self.value(role, row)? {
            Value::Text(text) | Value::Json(text) => Some(text),
            _ => None,
        }
    }

    /// Returns the attributes of one row as a table of one row.
    ///
    /// # Errors
    /// When the file expands to too many of them.
    pub(super) fn attributes_of(
        &self,
        row: usize,
        diagnostics: &mut Diagnostics,
    ) -> Result<Attributes, Problem> {
        let columns = self.columns.iter();
        let of_row = columns.filter(|column| column.values.get(row).is_some());
        self.budget
            .charge(of_row.clone().count() as u64 * OWN_VALUE_BYTES)?;
        let of_row = of_row.map(|column| Attribute {
            name: column.name.clone(),
            values: column.values.select(&[row]),
            quantity: column.quantity,
            source_type: column.source_type.clone(),
        });
        Ok(by_name(of_row, diagnostics))
    }

    /// Returns the attributes of all rows.
    pub(super) fn into_attributes(self, diagnostics: &mut Diagnostics) -> Attributes {
        by_name(self.columns, diagnostics)
    }
}
