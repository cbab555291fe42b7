//! Sets and removes properties of paths, nodes and stations.

use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_layout::{Attributes, TypeEntries, Value, Values};
use guideway_scene::{Table, TableEdit};

use super::error::OperationError;
use super::property_value::{accepted, kind_of};
use super::vehicle_types::with_type;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;

/// A property of elements, for all vehicle types or for one of them.
#[derive(Clone, Copy, Debug)]
pub struct PropertyRef<'a> {
    /// The table of the elements.
    pub of: Table,
    /// Name of the property, such as `maxSpeed`.
    pub name: &'a str,
    /// Sets the value for this type only; else for all, those with values of their own too.
    pub vehicle_type: Option<&'a str>,
}

impl Document {
    /// Sets a property of elements to one value, or removes it.
    ///
    /// A known property ([`guideway_layout::Property`]) has its SI unit; an unknown one becomes a
    /// column of its own.
    ///
    /// # Errors
    /// When an element does not exist, elements of this table do not have the property, the value
    /// does not fit it, or a path is not open to the vehicle type.
    pub fn set_property(
        &mut self,
        property: PropertyRef<'_>,
        rows: &PathSet,
        value: Option<Value<'_>>,
    ) -> Result<(), OperationError> {
        let step = if value.is_some() {
            "set property"
        } else {
            "remove property"
        };
        let changes = self.property_changes(property, rows, value)?;
        Ok(self.perform(step, changes)?)
    }

    /// The changes that set a property.
    pub(super) fn property_changes(
        &self,
        property: PropertyRef<'_>,
        rows: &PathSet,
        value: Option<Value<'_>>,
    ) -> Result<Vec<Change>, OperationError> {
        let PropertyRef {
            of,
            name,
            vehicle_type,
        } = property;
        self.check_rows_exist(of, rows)?;
        if rows.is_empty() {
            return Ok(Vec::new());
        }
        let layout = self.layout();
        let entries = of.entries(layout);
        let columns = [
            Some(of.attributes(layout)),
            entries.map(|entries| &entries.attributes),
        ];
        let known = columns
            .into_iter()
            .flatten()
            .find_map(|columns| columns.get(name));
        let (value, quantity) = accepted(kind_of(of), name, known, value)?;
        let set = |vehicle_type: Option<&str>, rows: Vec<u32>, values: Values| {
            let edit = TableEdit::SetValues {
                of,
                vehicle_type: vehicle_type.map(Arc::from),
                column: name.into(),
                quantity,
                rows: rows.into(),
                values: Arc::new(values),
            };
            Change::from(edit)
        };
        let all: Vec<u32> = rows.iter().collect();
        let one = |value: Option<Value<'_>>| [value].into_iter().collect::<Values>();
        let mut changes = Vec::new();
        match vehicle_type {
            None => {
                // A value for all types is in no entry.
                let own = entries.map(|entries| types_with_value(entries, rows, name));
                for (vehicle_type, rows) in own.unwrap_or_default() {
                    changes.push(set(Some(vehicle_type), rows, one(None)));
                }
                if value.is_some() || of.attributes(layout).get(name).is_some() {
                    changes.push(set(None, all, one(value)));
                }
            }
            Some(name_of_type) => {
                changes.extend(self.entries_for(property, rows, name_of_type)?);
                if let (Table::Paths, Some(entries)) = (of, entries) {
                    let shared = of.attributes(layout);
                    let others = types_to_fill(entries, shared, rows, property, name_of_type);
                    for (vehicle_type, rows) in others {
                        let own = rows.iter().map(|&row| shared.value(row as usize, name));
                        let values = own.collect();
                        changes.push(set(Some(vehicle_type), rows, values));
                    }
                    let has_value = |&row: &u32| shared.value(row as usize, name).is_some();
                    let filled: Vec<u32> = rows.iter().filter(has_value).collect();
                    if !filled.is_empty() {
                        changes.push(set(None, filled, one(None)));
                    }
                }
                let has_column = columns[1].is_some_and(|columns| columns.get(name).is_some());
                if value.is_some() || has_column {
                    changes.push(set(Some(name_of_type), all, one(value)));
                }
            }
        }
        Ok(changes)
    }

    /// Checks that paths have an entry for a vehicle type, and gives nodes without one an entry.
    fn entries_for(
        &self,
        property: PropertyRef<'_>,
        rows: &PathSet,
        vehicle_type: &str,
    ) -> Result<Option<Change>, OperationError> {
        let (of, layout) = (property.of, self.layout());
        let Some(entries) = of.entries(layout) else {
            return Ok(None);
        };
        let lacks = |&row: &u32| entries.entry_for(row as usize, vehicle_type).is_none();
        let lacking: Vec<u32> = rows.iter().filter(lacks).collect();
        match (of, lacking.first()) {
            (_, None) => Ok(None),
            (Table::Paths, Some(&row)) => Err(OperationError::NoEntry {
                path: of.id(layout, row).to_owned(),
                vehicle_type: vehicle_type.to_owned(),
            }),
            _ => {
                let entries = with_type(entries, &lacking, vehicle_type);
                let edit = TableEdit::SetEntries {
                    of,
                    rows: lacking.into(),
                    entries: Arc::new(entries),
                };
                Ok(Some(edit.into()))
            }
        }
    }
}

/// Vehicle types that have values of their own at some rows, with these rows.
fn types_with_value<'a>(
    entries: &'a TypeEntries,
    rows: &PathSet,
    name: &str,
) -> BTreeMap<&'a str, Vec<u32>> {
    let mut types: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
    let Some(column) = entries.attributes.get(name) else {
        return types;
    };
    for row in rows {
        let own = entries.entries(row as usize);
        for entry in own.filter(|&entry| column.values.get(entry).is_some()) {
            types.entry(entries.type_of(entry)).or_default().push(row);
        }
    }
    types
}

/// Vehicle types other than `except` that take over the value that a path has for all types, with
/// the rows of these paths.
fn types_to_fill<'a>(
    entries: &'a TypeEntries,
    shared: &Attributes,
    rows: &PathSet,
    property: PropertyRef<'_>,
    except: &str,
) -> BTreeMap<&'a str, Vec<u32>> {
    let mut types: BTreeMap<&str, Vec<u32>> = BTreeMap::new();
    let has_shared = |&row: &u32| shared.value(row as usize, property.name).is_some();
    for row in rows.iter().filter(has_shared) {
        for entry in entries.entries(row as usize) {
            let vehicle_type = entries.type_of(entry);
            let has_own = entries.attributes.value(entry, property.name).is_some();
            if vehicle_type != except && !has_own {
                types.entry(vehicle_type).or_default().push(row);
            }
        }
    }
    types
}
