//! [`Cells`]: compares the columns of one kind of element, row by row, for all vehicle types and
//! for each.

use std::collections::{BTreeMap, BTreeSet};
use std::mem::discriminant;

use super::change::ChangedValue;
use super::columns::are_equal;
use crate::{Attribute, Attributes, ElementKind, Layout, TypeEntries, Value};

/// The columns of one kind of element.
#[derive(Clone, Copy)]
pub(super) struct Table<'a> {
    columns: &'a Attributes,
    /// `None` for elements whose values hold for all vehicle types.
    types: Option<&'a TypeEntries>,
}

impl<'a> Table<'a> {
    /// The columns of the nodes, paths or stations of a layout.
    pub(super) fn of(layout: &'a Layout, kind: ElementKind) -> Self {
        let (columns, types) = match kind {
            ElementKind::Path => {
                let paths = &layout.paths;
                (&paths.attributes, Some(paths.vehicle_types()))
            }
            ElementKind::Station => (&layout.stations.attributes, None),
            _ => {
                let nodes = &layout.nodes;
                (&nodes.attributes, Some(nodes.vehicle_types()))
            }
        };
        Self { columns, types }
    }

    fn types_of(self, row: usize) -> impl Iterator<Item = &'a str> {
        let types = self.types.into_iter();
        types.flat_map(move |types| types.of(row))
    }

    /// The vehicle types of an element as text; `all` if it has none.
    pub(super) fn type_list(self, row: usize) -> String {
        let names: BTreeSet<&str> = self.types_of(row).collect();
        match names.is_empty() {
            true => "all".to_owned(),
            false => Vec::from_iter(names).join(", "),
        }
    }

    /// Name of the vehicle type of an entry.
    pub(super) fn type_of(self, entry: u32) -> Option<&'a str> {
        Some(self.types?.type_of(entry as usize))
    }

    fn entry(self, row: usize, vehicle_type: &str) -> Option<usize> {
        self.types?.entry_for(row, vehicle_type)
    }

    fn column(self, name: &str) -> [Option<&'a Attribute>; 2] {
        [
            self.columns.get(name),
            self.types.and_then(|types| types.attributes.get(name)),
        ]
    }

    /// A value with the unit of its column: that of a vehicle type, else that for all.
    pub(super) fn text(self, row: usize, of: Option<&str>, name: &str) -> Option<String> {
        let [own, per_type] = self.column(name);
        let value = self.value([own, per_type], row, of)?;
        let quantity = own.or(per_type).and_then(|column| column.quantity);
        Some(match quantity {
            Some(quantity) => format!("{value} {}", quantity.unit()),
            None => value.to_string(),
        })
    }

    fn value(
        self,
        [own, per_type]: [Option<&'a Attribute>; 2],
        row: usize,
        of: Option<&str>,
    ) -> Option<Value<'a>> {
        let of_type = || per_type?.values.get(self.entry(row, of?)?);
        of_type().or_else(|| own?.values.get(row))
    }
}

/// The vehicle types that two rows have in common, in the order of their names.
pub(super) fn common_types<'a>(tables: [Table<'a>; 2], rows: [usize; 2]) -> BTreeSet<&'a str> {
    let [before, after] = [0, 1].map(|i| tables[i].types_of(rows[i]).collect::<BTreeSet<_>>());
    before.intersection(&after).copied().collect()
}

/// A column of both tables, wherever they hold it.
struct ColumnPair<'a> {
    /// Row of its name.
    name: u32,
    /// The column for all vehicle types, and that per type, of both tables.
    columns: [[Option<&'a Attribute>; 2]; 2],
}

/// The columns of one kind of element in two layouts.
pub(super) struct Cells<'a> {
    tables: [Table<'a>; 2],
    columns: Vec<ColumnPair<'a>>,
    relative_tolerance: f64,
}

impl<'a> Cells<'a> {
    /// The columns of two tables; appends their names.
    pub(super) fn new(
        tables: [Table<'a>; 2],
        relative_tolerance: f64,
        names: &mut Vec<&'a str>,
    ) -> Self {
        let mut pairs: BTreeMap<&str, [[Option<&Attribute>; 2]; 2]> = BTreeMap::new();
        for (i, table) in tables.into_iter().enumerate() {
            let of_types = table.types.map(|types| &types.attributes);
            for (j, columns) in [Some(table.columns), of_types].into_iter().enumerate() {
                for column in columns.into_iter().flat_map(|columns| columns.iter()) {
                    pairs.entry(&column.name).or_default()[i][j] = Some(column);
                }
            }
        }
        let columns = pairs.into_iter().map(|(name, columns)| {
            names.push(name);
            let name = names.len() as u32 - 1;
            ColumnPair { name, columns }
        });
        Self {
            tables,
            columns: columns.collect(),
            relative_tolerance,
        }
    }

    /// Finds the values of a row of both tables that differ. A value of all vehicle types counts
    /// once, wherever the layouts hold it.
    pub(super) fn compare(&self, rows: [usize; 2], found: &mut impl FnMut(ChangedValue)) {
        let [before, after] = [0, 1].map(|i| self.tables[i].types_of(rows[i]));
        let common = match before.eq(after) {
            true => self.tables[0].types_of(rows[0]).collect(),
            false => {
                let common = common_types(self.tables, rows);
                let counts = [0, 1].map(|i| {
                    let types: BTreeSet<&str> = self.tables[i].types_of(rows[i]).collect();
                    types.len()
                });
                if counts != [common.len(); 2] {
                    found(ChangedValue::VehicleTypes);
                }
                common
            }
        };
        for column in &self.columns {
            self.compare_column(column, rows, &common, found);
        }
    }

    fn compare_column(
        &self,
        column: &ColumnPair<'_>,
        rows: [usize; 2],
        common: &BTreeSet<&str>,
        found: &mut impl FnMut(ChangedValue),
    ) {
        let name = column.name;
        let values =
            |of: Option<&str>| [0, 1].map(|i| self.tables[i].value(column.columns[i], rows[i], of));
        let mut types = common.iter();
        let first = values(types.next().copied());
        if types.all(|of| values(Some(of)) == first) {
            if self.differ(column, first) {
                found(ChangedValue::Column { name, entry: None });
            }
            return;
        }
        for &of in common {
            if self.differ(column, values(Some(of))) {
                let entry = self.tables[0].entry(rows[0], of).map(|entry| entry as u32);
                found(ChangedValue::Column { name, entry });
            }
        }
    }

    /// Returns `true` if two values differ, not only in the type of their column.
    fn differ(&self, column: &ColumnPair<'_>, values: [Option<Value<'_>>; 2]) -> bool {
        if are_equal(values, self.relative_tolerance) {
            return false;
        }
        let [Some(a), Some(b)] = values else {
            return true;
        };
        let quantity = |i: usize| {
            let [own, per_type] = column.columns[i];
            own.or(per_type).and_then(|column| column.quantity)
        };
        discriminant(&a) == discriminant(&b)
            || quantity(0) != quantity(1)
            || a.to_string() != b.to_string()
    }
}
