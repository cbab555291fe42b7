//! Sets the vehicle types of paths and nodes.

use std::sync::Arc;

use guideway_layout::{TypeEntries, Values};
use guideway_scene::{EditError, Table, TableEdit};

use super::error::OperationError;
use crate::PathSet;
use crate::document::Document;

impl Document {
    /// Sets the vehicle types that may use paths, or that have properties of their own at nodes.
    /// None opens a path to all types. Types that stay keep their properties.
    ///
    /// # Errors
    /// When an element does not exist, or for stations.
    pub fn set_vehicle_types(
        &mut self,
        of: Table,
        rows: &PathSet,
        types: &[&str],
    ) -> Result<(), OperationError> {
        self.check_rows_exist(of, rows)?;
        let entries = of.entries(self.layout()).ok_or(EditError::NoVehicleTypes)?;
        let rows: Vec<u32> = rows.iter().collect();
        if rows.is_empty() {
            return Ok(());
        }
        let mut unique: Vec<&str> = Vec::new();
        for name in types {
            if !unique.contains(name) {
                unique.push(name);
            }
        }
        let entries = with_types(entries, &rows, |_| unique.clone());
        let edit = TableEdit::SetEntries {
            of,
            rows: rows.into(),
            entries: Arc::new(entries),
        };
        Ok(self.perform("set vehicle types", vec![edit.into()])?)
    }
}

/// The entries of elements with one more type each.
pub(super) fn with_type<'a>(entries: &'a TypeEntries, rows: &[u32], name: &'a str) -> TypeEntries {
    with_types(entries, rows, |row| {
        let own = entries.of(row as usize);
        own.chain([name]).collect()
    })
}

/// The entries of elements for other types, with the properties of the types that stay.
fn with_types<'a>(
    entries: &TypeEntries,
    rows: &[u32],
    types_of: impl Fn(u32) -> Vec<&'a str>,
) -> TypeEntries {
    let mut changed = TypeEntries::default();
    let mut sources = Vec::new();
    for &row in rows {
        let types = types_of(row);
        let source = |name: &&str| entries.entry_for(row as usize, name);
        sources.extend(types.iter().map(source));
        changed.push(&types);
    }
    for column in entries.attributes.iter() {
        let value = |source: &Option<usize>| column.values.get((*source)?);
        let values: Values = sources.iter().map(value).collect();
        let (name, quantity) = (&column.name, column.quantity);
        let has_value = values.iter().any(|value| value.is_some());
        if has_value {
            changed
                .attributes
                .set_rows(name, quantity, 0..sources.len(), &values);
        }
    }
    changed
}
