//! GeoJSON columns: sets properties of features as columns, at most 64 per table.

use std::borrow::Cow;
use std::collections::HashSet;

use guideway_layout::{Attributes, Code, Value};

use super::declared::Owner;
use super::mapper::Mapper;
use super::properties::{ColumnValue, Property};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::fields::{Vocabulary, field};

/// Largest number of columns per table; a file could else create columns without end.
const MAX_COLUMNS: usize = 64;
/// Largest name of a column in bytes.
const MAX_NAME_BYTES: usize = 128;
/// Column of one object with all properties beyond the limits.
const OTHER: &str = "other";

/// A property, with its name in the layout.
pub(super) type Named<'p> = (Cow<'p, str>, Property<'p>);

/// Properties sorted into columns, and the object of the rest.
struct Sorted<'p> {
    columns: Vec<(Cow<'p, str>, ColumnValue<'p>)>,
    other: String,
}

impl Mapper<'_> {
    /// Largest number of columns per table. A file that declares its columns may have as many as
    /// its size justifies.
    pub(super) fn column_limit(file_bytes: usize, features: usize) -> usize {
        MAX_COLUMNS.max(file_bytes.saturating_mul(4) / features.max(1))
    }

    /// Sets the columns of a row of a table.
    pub(super) fn set_columns(
        &mut self,
        (owner, table): (Owner, Table),
        row: usize,
        properties: Vec<Named<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let mut names = std::mem::take(&mut self.columns[owner as usize]);
        let sorted = self.sort(owner, &mut names, properties, at);
        self.columns[owner as usize] = names;
        let sorted = sorted?;
        for (name, value) in &sorted.columns {
            let known = field(Vocabulary::Nav2, name).filter(|_| self.is_graph);
            let is_number = matches!(value, ColumnValue::Int(_) | ColumnValue::Float(_));
            match known.filter(|_| is_number) {
                Some(field) => self.builder.set_field(table, row, field, value.value())?,
                None => self.builder.set(table, row, name, value.value())?,
            }
        }
        if !sorted.other.is_empty() {
            let other = Value::Json(&sorted.other);
            self.builder.set(table, row, OTHER, other)?;
        }
        Ok(())
    }

    /// Returns properties as the only row of a table of their own.
    pub(super) fn single_row(
        &mut self,
        owner: Owner,
        properties: Vec<Named<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<Attributes, ReadError> {
        let sorted = self.sort(owner, &mut HashSet::new(), properties, at)?;
        let mut attributes = Attributes::default();
        for (name, value) in &sorted.columns {
            attributes.set(0, name, value.value());
        }
        if !sorted.other.is_empty() {
            attributes.set(0, OTHER, Value::Json(&sorted.other));
        }
        self.declared.set_units(owner, &mut attributes);
        Ok(attributes)
    }

    /// Sorts properties into columns; `names` are those of the table so far. Reports properties
    /// that become no column of their own.
    fn sort<'p>(
        &mut self,
        owner: Owner,
        names: &mut HashSet<String>,
        properties: Vec<Named<'p>>,
        at: PlaceFn<'_>,
    ) -> Result<Sorted<'p>, ReadError> {
        let max_bytes = self.builder.source.options.limits.text_bytes;
        let mut sorted = Sorted {
            columns: Vec::new(),
            other: String::new(),
        };
        let mut beyond: Vec<Named<'p>> = Vec::new();
        let mut named_other = None;
        for (name, property) in properties {
            if name == OTHER {
                named_other = Some((name, property));
                continue;
            }
            let is_column = names.contains(name.as_ref())
                || names.len() < self.column_limit && name.len() <= MAX_NAME_BYTES;
            if !is_column || property.json().len() > max_bytes && !property.is_text() {
                beyond.push((name, property));
                continue;
            }
            names.insert(name.clone().into_owned());
            let value = self.declared.value(owner, &name, property);
            if let ColumnValue::Text(text) = &value {
                self.builder.check_text(text)?;
            }
            sorted.columns.push((name, value));
        }
        match named_other {
            Some(other) if !beyond.is_empty() => beyond.push(other),
            Some((name, property)) => {
                let value = self.declared.value(owner, &name, property);
                sorted.columns.push((name, value));
            }
            None => {}
        }
        if !beyond.is_empty() {
            sorted.other = object(&beyond);
            self.report_beyond(&mut sorted.other, beyond.len(), max_bytes, at);
        }
        Ok(sorted)
    }

    /// Reports properties beyond the limits; empties their object if it is too long for a column.
    fn report_beyond(
        &mut self,
        other: &mut String,
        count: usize,
        max_bytes: usize,
        at: PlaceFn<'_>,
    ) {
        let limits = format!(
            "{count} properties exceed the limit of {} columns or of names",
            self.column_limit
        );
        let remedy = match other.len() > max_bytes {
            true => {
                other.clear();
                "They are ignored, because they are longer than a text may be; remove properties"
            }
            false => "They are in the column `other`; remove properties, or shorten their names",
        };
        self.builder.report(Code::Attribute, at, || limits, remedy);
    }
}

/// Joins properties to an object.
fn object(properties: &[Named<'_>]) -> String {
    let mut json = String::from("{");
    for (name, property) in properties {
        let separator = if json.len() > 1 { "," } else { "" };
        let name = serde_json::Value::from(name.as_ref());
        json += &format!("{separator}{name}:{}", property.json());
    }
    json + "}"
}
