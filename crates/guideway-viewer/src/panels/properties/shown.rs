//! The selected elements of one table, with everything that the panel shows of them.

use std::sync::Arc;

use guideway_document::{Elements, PathSet, levels_by_height};
use guideway_layout::{Layout, Level, Property};
use guideway_scene::Table;

use super::draft::{Owners, Subject, Target};
use super::facts::Facts;
use super::field::{Field, MAX_COMPARED, empty_field, fields, types_of};
use super::shape::PathShape;
use crate::language::counted;

/// The selected elements of one table.
pub(super) struct Shown {
    pub(super) of: Table,
    pub(super) rows: Arc<PathSet>,
    pub(super) facts: Facts,
    pub(super) fields: Vec<Field>,
    pub(super) levels: Vec<String>,
    pub(super) levels_by_height: Vec<u32>,
    /// Vehicle types that the elements have entries for, by name.
    pub(super) types: Vec<String>,
    /// Lengths of paths; `None` for other elements.
    pub(super) shape: Option<PathShape>,
}

impl Shown {
    /// Reads the selected elements of a table.
    pub(super) fn new(layout: &Layout, of: Table, selected: &Elements) -> Self {
        let rows = selected.rows(of);
        let name = |level: &Level| level.name_or_id().to_owned();
        let some: Vec<usize> = rows
            .iter()
            .take(MAX_COMPARED)
            .map(|row| row as usize)
            .collect();
        let entries = of.entries(layout);
        Self {
            of,
            facts: Facts::new(layout, of, rows),
            fields: fields(layout, of, rows),
            types: entries.map_or_else(Vec::new, |entries| types_of(entries, &some)),
            shape: (of == Table::Paths).then(|| PathShape::new(layout, rows)),
            rows: Arc::new(rows.clone()),
            levels: layout.levels.iter().map(name).collect(),
            levels_by_height: levels_by_height(layout),
        }
    }

    /// The field of these elements for a fact or property.
    pub(super) fn target(&self, subject: Subject) -> Target {
        Target {
            of: Owners::Elements(self.of, Arc::clone(&self.rows)),
            subject,
        }
    }

    /// The field of a property that no element has yet.
    pub(super) fn empty_field(&self, property: &Property) -> Option<Field> {
        let is_there = self.fields.iter().any(|field| field.name == property.name);
        (!is_there).then(|| empty_field(property))
    }

    /// The elements, apart from other tables.
    pub(super) fn elements(&self) -> Elements {
        let rows = PathSet::clone(&self.rows);
        let mut elements = Elements::default();
        *elements.rows_mut(self.of) = rows;
        elements
    }

    /// Their number: `2 paths`.
    pub(super) fn heading(&self) -> String {
        counted(self.rows.len(), self.of.element())
    }
}
