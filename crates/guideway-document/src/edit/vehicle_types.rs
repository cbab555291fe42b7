//! Creates, renames and deletes vehicle types, and sets those of paths and nodes.

use std::collections::BTreeSet;
use std::sync::Arc;

use guideway_layout::{ElementKind, TypeEntries, Value, Values, VehicleType};
use guideway_scene::{EditError, Table, TableEdit};

use super::error::OperationError;
use super::levels::PropertyValues;
use super::property_value::set_all;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;

/// Columns of the parts of a name that a format has in two members.
const NAME_PARTS: [&str; 2] = ["manufacturer", "seriesName"];

/// The fate of the entries of a deleted vehicle type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TypeUse<'a> {
    /// The type is only deleted if no path and no node names it, and it has no properties.
    Keep,
    /// Paths and nodes get this type instead, with the properties of the deleted one; those that
    /// have it already keep its properties.
    Replace(&'a str),
    /// Paths and nodes lose the type. A path that only it may use would be open to all types, and
    /// is refused.
    Remove,
}

impl Document {
    /// Creates a vehicle type, which no path names yet.
    ///
    /// # Errors
    /// When the name is empty or taken, or a value does not fit its property.
    pub fn create_vehicle_type(
        &mut self,
        name: &str,
        properties: PropertyValues<'_>,
    ) -> Result<(), OperationError> {
        self.check_type_is_free(name)?;
        let mut types = self.layout().vehicle_types.clone();
        set_properties(&mut types, name, properties)?;
        let edit = TableEdit::SetVehicleTypes(types.into());
        Ok(self.perform("create vehicle type", vec![edit.into()])?)
    }

    /// Renames a vehicle type, also where paths and nodes name it, and sets properties that it has
    /// everywhere. The others stay.
    ///
    /// # Errors
    /// When there is no such vehicle type, the new name is empty or taken, or a value does not fit
    /// its property.
    pub fn change_vehicle_type(
        &mut self,
        old: &str,
        new: &str,
        properties: PropertyValues<'_>,
    ) -> Result<(), OperationError> {
        self.check_type_exists(old)?;
        let mut changes = Vec::new();
        let mut types = self.layout().vehicle_types.clone();
        if old != new {
            self.check_type_is_free(new)?;
            // Removed elements keep the old name, and have it again when they come back by an undo.
            changes.extend(self.entries_with(old, Some(new), |of, row| self.scene.exists(of, row)));
        }
        if let Some(renamed) = types.iter_mut().find(|t| t.id == old && old != new) {
            set_name(renamed, new);
        }
        if !properties.is_empty() {
            set_properties(&mut types, new, properties)?;
        }
        let before = &self.layout().vehicle_types;
        let mut pairs = before.iter().zip(&types);
        if before.len() != types.len() || pairs.any(|(a, b)| a != b) {
            changes.push(TableEdit::SetVehicleTypes(types.into()).into());
        }
        let is_selected = self.selection.vehicle_types.contains(old);
        self.perform("change vehicle type", changes)?;
        if is_selected && old != new {
            let types = &mut Arc::make_mut(&mut self.selection).vehicle_types;
            types.remove(old);
            types.insert(new.to_owned());
        }
        Ok(())
    }

    /// Deletes a vehicle type and its properties.
    ///
    /// # Errors
    /// When there is no such vehicle type, it is in use and to be kept, its replacement does not
    /// exist, or a path would be open to all types.
    pub fn delete_vehicle_type(
        &mut self,
        name: &str,
        uses: TypeUse<'_>,
    ) -> Result<(), OperationError> {
        self.check_type_exists(name)?;
        let tables = [Table::Paths, Table::Nodes].map(|of| (of, self.users_of_type(of, name)));
        let is_table_row = |t: &&VehicleType| t.id == name;
        let of_table = self.layout().vehicle_types.iter().find(is_table_row);
        match uses {
            TypeUse::Keep => {
                let existing = |of: Table, rows: &[u32]| {
                    let exists = |row: &&u32| self.scene.exists(of, **row);
                    rows.iter().filter(exists).count()
                };
                let counts = tables.each_ref().map(|(of, rows)| existing(*of, rows));
                let properties = of_table.map_or(0, |t| t.attributes.iter().len());
                if counts != [0, 0] || properties > 0 {
                    return Err(OperationError::VehicleTypeInUse {
                        name: name.to_owned(),
                        paths: counts[0],
                        nodes: counts[1],
                        properties,
                    });
                }
            }
            TypeUse::Replace(other) if other == name => {
                let name = name.to_owned();
                return Err(OperationError::SameVehicleType { name });
            }
            TypeUse::Replace(other) => self.check_type_exists(other)?,
            TypeUse::Remove => {
                let entries = self.layout().paths.vehicle_types();
                let is_only = |row: &&u32| {
                    self.scene.exists(Table::Paths, **row) && entries.of(**row as usize).len() == 1
                };
                if let Some(&path) = tables[0].1.iter().find(is_only) {
                    return Err(OperationError::OpensPath {
                        path: self.layout().paths.id(path as usize).to_owned(),
                        name: name.to_owned(),
                    });
                }
            }
        }
        let other = match uses {
            TypeUse::Replace(other) => Some(other),
            TypeUse::Keep | TypeUse::Remove => None,
        };
        let mut changes = self.entries_with(name, other, |_, _| true);
        if of_table.is_some() {
            let left = self.layout().vehicle_types.iter().filter(|t| t.id != name);
            changes.push(TableEdit::SetVehicleTypes(left.cloned().collect()).into());
        }
        Ok(self.perform("delete vehicle type", changes)?)
    }

    /// The changes that put another vehicle type, or none, in place of one, in some elements.
    fn entries_with(
        &self,
        name: &str,
        other: Option<&str>,
        is_changed: impl Fn(Table, u32) -> bool,
    ) -> Vec<Change> {
        let mut changes = Vec::new();
        for of in [Table::Paths, Table::Nodes] {
            let rows = self.users_of_type(of, name).into_iter();
            let rows: Vec<u32> = rows.filter(|&row| is_changed(of, row)).collect();
            let entries = of.entries(self.layout()).filter(|_| !rows.is_empty());
            if let Some(entries) = entries {
                let entries = Arc::new(replaced_types(entries, &rows, name, other));
                let rows = rows.into();
                changes.push(TableEdit::SetEntries { of, rows, entries }.into());
            }
        }
        changes
    }

    /// The changes that put a copy of a vehicle type beside it, in all elements that exist.
    pub(super) fn entries_of_copy(&self, name: &str, copy: &str) -> Vec<Change> {
        let of_table = |of: Table| {
            let rows = self.users_of_type(of, name).into_iter();
            let rows: Vec<u32> = rows.filter(|&row| self.scene.exists(of, row)).collect();
            let entries = of.entries(self.layout()).filter(|_| !rows.is_empty())?;
            let with_copy = |row: u32| {
                let own = entries.of(row as usize).map(|own| (own, own));
                own.chain([(copy, name)]).collect()
            };
            let entries = Arc::new(with_sources(entries, &rows, with_copy));
            let rows = rows.into();
            Some(TableEdit::SetEntries { of, rows, entries }.into())
        };
        let tables = [Table::Paths, Table::Nodes].into_iter();
        tables.filter_map(of_table).collect()
    }

    /// The rows that name a vehicle type, those of removed elements too.
    fn users_of_type(&self, of: Table, name: &str) -> Vec<u32> {
        let Some(entries) = of.entries(self.layout()) else {
            return Vec::new();
        };
        let names = |row: &u32| entries.entry_for(*row as usize, name).is_some();
        (0..entries.len() as u32).filter(names).collect()
    }

    /// The numbers of existing paths and nodes that name one of these vehicle types.
    pub fn count_users_of_types(&self, names: &BTreeSet<String>) -> [u64; 2] {
        [Table::Paths, Table::Nodes].map(|of| {
            let rows = names.iter().flat_map(|name| self.users_of_type(of, name));
            let rows = rows.filter(|&row| self.scene.exists(of, row));
            rows.collect::<PathSet>().len()
        })
    }

    fn check_type_exists(&self, name: &str) -> Result<(), OperationError> {
        match self.layout().vehicle_type_names().contains(name) {
            true => Ok(()),
            false => Err(OperationError::UnknownVehicleType {
                name: name.to_owned(),
            }),
        }
    }

    fn check_type_is_free(&self, name: &str) -> Result<(), OperationError> {
        let what = "vehicle type";
        if name.is_empty() {
            return Err(OperationError::EmptyId { what });
        }
        match self.layout().vehicle_type_names().contains(name) {
            true => Err(OperationError::IdTaken {
                what,
                id: name.to_owned(),
            }),
            false => Ok(()),
        }
    }

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

/// Gives a vehicle type another name. The parts of the name follow: the manufacturer stays if the
/// name begins with it.
pub(super) fn set_name(renamed: &mut VehicleType, name: &str) {
    name.clone_into(&mut renamed.id);
    let [manufacturer, series] = NAME_PARTS;
    let kept = match renamed.attributes.value(0, manufacturer) {
        Some(Value::Text(maker)) => renamed.id.strip_prefix(maker),
        _ => None,
    };
    let rest = kept
        .and_then(|rest| rest.strip_prefix(' '))
        .map(str::to_owned);
    for part in NAME_PARTS {
        match rest
            .as_deref()
            .filter(|_| renamed.attributes.get(part).is_some())
        {
            Some(rest) if part == series => {
                renamed.attributes.set(0, series, Value::Text(rest));
            }
            Some(_) => {}
            None => drop(renamed.attributes.remove(part)),
        }
    }
}

/// Sets properties of a vehicle type, which is added if the table lacks it.
fn set_properties(
    types: &mut Vec<VehicleType>,
    name: &str,
    properties: PropertyValues<'_>,
) -> Result<(), OperationError> {
    let row = types.iter().position(|t| t.id == name);
    let row = row.unwrap_or_else(|| {
        types.push(VehicleType {
            id: name.to_owned(),
            ..VehicleType::default()
        });
        types.len() - 1
    });
    let attributes = &mut types[row].attributes;
    set_all(ElementKind::VehicleType, attributes, properties)
}

/// The entries of elements with another type, or none, in place of one.
fn replaced_types(
    entries: &TypeEntries,
    rows: &[u32],
    name: &str,
    other: Option<&str>,
) -> TypeEntries {
    let types_of = |row: u32| {
        let own = entries.of(row as usize);
        let has_other = other.is_some_and(|o| entries.entry_for(row as usize, o).is_some());
        let renamed = own.map(|own| match own == name {
            true => other.filter(|_| !has_other).map(|other| (other, name)),
            false => Some((own, own)),
        });
        renamed.flatten().collect()
    };
    with_sources(entries, rows, types_of)
}

/// The entries of elements for other types, with the properties of the types that stay.
fn with_types<'a>(
    entries: &TypeEntries,
    rows: &[u32],
    types_of: impl Fn(u32) -> Vec<&'a str>,
) -> TypeEntries {
    let same = |name| (name, name);
    with_sources(entries, rows, |row| {
        types_of(row).into_iter().map(same).collect()
    })
}

/// The entries of elements for other types. Each comes with the type whose properties it takes.
fn with_sources<'a>(
    entries: &TypeEntries,
    rows: &[u32],
    types_of: impl Fn(u32) -> Vec<(&'a str, &'a str)>,
) -> TypeEntries {
    let mut changed = TypeEntries::default();
    let mut sources = Vec::new();
    for &row in rows {
        let types = types_of(row);
        let source = |(_, from): &(&str, &str)| entries.entry_for(row as usize, from);
        sources.extend(types.iter().map(source));
        let names: Vec<&str> = types.iter().map(|(name, _)| *name).collect();
        changed.push(&names);
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
