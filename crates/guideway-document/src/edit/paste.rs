//! Copies elements inside a document, and pastes a [`Clip`] into one.

use std::collections::HashMap;
use std::sync::Arc;

use guideway_layout::{Attribute, Layout, Level, TypeEntries};
use guideway_scene::{EditError, Table, TableEdit};
use guideway_spline::{Affine, Point};

use super::clip::Clip;
use super::copies::{Copies, Source};
use super::error::OperationError;
use super::property_value::{column_type, takes};
use crate::PathSet;
use crate::change::{Change, CopiesOf};
use crate::document::Document;
use crate::elements::Elements;

impl Document {
    /// Copies the selected paths with their nodes and stations, and selects the copied paths. See
    /// [`Self::copy`].
    ///
    /// # Errors
    /// As [`Self::copy`].
    pub fn copy_selection(&mut self, count: u32, step_m: Point<f64>) -> Result<(), EditError> {
        let selected = Arc::clone(&self.selection);
        self.copy(&selected, count, step_m).map(drop)
    }

    /// Copies elements `count` times, each copy `step_m` from the previous one, and selects the
    /// copied paths. Copies the end nodes of the paths too, and the stations whose nodes are all
    /// copied. Copies keep properties and style; their names are numbered. Returns their rows.
    ///
    /// # Errors
    /// When an element does not exist, a copy would exceed the coordinate limit, or the copies are
    /// more than [`CopiesOf::MAX_COUNT`] or than a document takes; the document is unchanged.
    pub fn copy(
        &mut self,
        elements: &Elements,
        count: u32,
        step_m: Point<f64>,
    ) -> Result<Elements, EditError> {
        self.check_exist(elements)?;
        let all = self.with_places(elements);
        if all.is_empty() || count == 0 {
            return Ok(Elements::default());
        }
        let copies = CopiesOf {
            elements: Arc::new(all),
            count,
            step_m,
        };
        self.check_copies(&copies)?;
        let rows = Table::ALL.map(|of| {
            let first = of.row_count(self.layout()) as u32;
            first..first + copies.elements.rows(of).len() as u32 * count
        });
        self.perform("copy", vec![Change::Copy(copies)])?;
        let [paths, nodes, stations] = rows.map(|rows| rows.collect::<PathSet>());
        self.selection = Arc::new(Elements::of_paths(&paths));
        Ok(Elements {
            paths,
            nodes,
            stations,
            ..Elements::default()
        })
    }

    /// Pastes copied elements, transformed, with all their properties and vehicle types. Selects
    /// what is pasted. A name that is taken gets a number. `level` puts everything on one level;
    /// else each element goes to the level of the same identifier or name. Returns what is new.
    ///
    /// A copied level becomes a new one, with its elements. A copied vehicle type may use what the
    /// one of its name may use, with the same properties; without one it only has the properties
    /// that it has everywhere.
    ///
    /// # Errors
    /// When the document lacks a level, has a column in another type or unit, or an element would
    /// exceed the coordinate limit.
    pub fn paste(
        &mut self,
        clip: &Clip,
        by: Affine,
        level: Option<u32>,
    ) -> Result<Elements, OperationError> {
        let mut pasted = Elements::default();
        self.together("paste", |document| {
            // Before the elements, which may name a type that is copied.
            let copied = clip.layout().vehicle_types.iter();
            let types = copied.map(|copied| document.copy_type(copied));
            let types = types.collect::<Result<_, _>>()?;
            let source = &clip.layout().levels;
            let copied = clip.levels().iter();
            let copied: Vec<Level> = copied.map(|row| source[row as usize].clone()).collect();
            let rows = document.copy_levels(&copied)?;
            let new_levels: HashMap<u32, u32> = clip.levels().iter().zip(rows.clone()).collect();
            pasted = document.paste_elements(clip.layout(), by, level, &new_levels)?;
            pasted.levels = rows.into_iter().collect();
            pasted.vehicle_types = types;
            Ok::<(), OperationError>(())
        })?;
        let mut selection = pasted.clone();
        // The elements of a pasted level go with it.
        for of in Table::ALL {
            let rows = pasted.rows(of).iter().filter(|&row| {
                let level = of.level(self.layout(), row);
                level.is_none_or(|level| !pasted.levels.contains(level))
            });
            *selection.rows_mut(of) = rows.collect();
        }
        self.selection = Arc::new(selection);
        Ok(pasted)
    }

    /// Pastes the elements of a layout. `new_levels` are the rows of the levels that come along.
    fn paste_elements(
        &mut self,
        source: &Layout,
        by: Affine,
        level: Option<u32>,
        new_levels: &HashMap<u32, u32>,
    ) -> Result<Elements, OperationError> {
        let elements = Elements {
            paths: (0..source.paths.len() as u32).collect(),
            nodes: (0..source.nodes.len() as u32).collect(),
            stations: (0..source.stations.len() as u32).collect(),
            ..Elements::default()
        };
        for of in Table::ALL {
            check_columns(of, source, self.layout())?;
        }
        let levels = levels_of(source, self.layout(), level, new_levels)?;
        let mut copies = Copies::into(&self.scene);
        let all = Source {
            layout: source,
            elements: &elements,
            is_own: false,
            number: None,
            levels: Some(&levels),
        };
        copies.add(&all, by);
        let rows = copies.rows();
        let edits = copies.into_edits().into_iter();
        let mut changes: Vec<Change> = edits.map(Change::Scene).collect();
        for of in Table::ALL {
            let first = rows.rows(of).min().unwrap_or(0);
            changes.extend(values_of(of, source, first));
        }
        self.perform("paste", changes)?;
        Ok(rows)
    }
}

/// Level of the document for each level of the source that is in use.
fn levels_of(
    source: &Layout,
    target: &Layout,
    level: Option<u32>,
    new_levels: &HashMap<u32, u32>,
) -> Result<Vec<Option<u32>>, OperationError> {
    let rows = |of: Table| (0..of.row_count(source) as u32).map(move |row| (of, row));
    let used = Table::ALL.into_iter().flat_map(rows);
    let used: PathSet = used.filter_map(|(of, row)| of.level(source, row)).collect();
    let same = |(row, of_source): (usize, &Level)| {
        if let Some(&new) = new_levels.get(&(row as u32)) {
            return Ok(Some(new));
        }
        let name = of_source.name.as_deref();
        let found = target.level_named(&of_source.id);
        let found = found.or_else(|| target.level_named(name?));
        match (level.or(found), target.levels.is_empty()) {
            (None, false) if used.contains(row as u32) => Err(OperationError::UnknownLevel {
                level: of_source.id.clone(),
            }),
            (level, _) => Ok(level),
        }
    };
    source.levels.iter().enumerate().map(same).collect()
}

/// Columns that hold for all vehicle types, then those per type.
fn columns(of: Table, layout: &Layout) -> [Vec<&Attribute>; 2] {
    let entries = of.entries(layout);
    let has_values = |column: &&Attribute| column.values.iter().any(|value| value.is_some());
    let per_type = entries.map(|entries| entries.attributes.iter().filter(has_values).collect());
    [
        of.attributes(layout).iter().filter(has_values).collect(),
        per_type.unwrap_or_default(),
    ]
}

/// Checks that no column of the target changes its type or its unit.
fn check_columns(of: Table, source: &Layout, target: &Layout) -> Result<(), OperationError> {
    let known = |per_type: bool, name: &str| match per_type {
        true => of.entries(target)?.attributes.get(name),
        false => of.attributes(target).get(name),
    };
    for (columns, per_type) in columns(of, source).into_iter().zip([false, true]) {
        for column in columns {
            let Some(own) = known(per_type, &column.name) else {
                continue;
            };
            let mut values = column.values.iter().flatten();
            let has_unit = own.quantity == column.quantity || own.values.is_empty();
            if !has_unit || !values.all(|value| takes(&own.values, value)) {
                return Err(OperationError::OtherColumn {
                    column: column.name.clone(),
                    there: column_type(column),
                    here: column_type(own),
                });
            }
        }
    }
    Ok(())
}

/// Sets the values of the pasted elements of a table, whose rows begin at `first`.
fn values_of(of: Table, source: &Layout, first: u32) -> Vec<Change> {
    let [shared, per_type] = columns(of, source);
    let mut changes = Vec::new();
    let mut set = |vehicle_type: Option<&str>, column: &Attribute, places: &[(u32, usize)]| {
        let has_value = |(_, place): &&(u32, usize)| column.values.get(*place).is_some();
        let places: Vec<(u32, usize)> = places.iter().filter(has_value).copied().collect();
        if places.is_empty() {
            return;
        }
        let rows = places.iter().map(|(row, _)| first + row);
        let values: Vec<usize> = places.iter().map(|(_, place)| *place).collect();
        let edit = TableEdit::SetValues {
            of,
            vehicle_type: vehicle_type.map(Arc::from),
            column: column.name.as_str().into(),
            quantity: column.quantity,
            rows: rows.collect(),
            values: Arc::new(column.values.select(&values)),
        };
        changes.push(edit.into());
    };
    let all: Vec<(u32, usize)> = (0..of.row_count(source))
        .map(|row| (row as u32, row))
        .collect();
    shared
        .into_iter()
        .for_each(|column| set(None, column, &all));
    let Some(entries) = of.entries(source).filter(|_| !per_type.is_empty()) else {
        return changes;
    };
    for (name, places) in entries_by_type(entries) {
        per_type
            .iter()
            .for_each(|column| set(Some(name), column, &places));
    }
    changes
}

/// Elements and their entries, by vehicle type.
fn entries_by_type(entries: &TypeEntries) -> Vec<(&str, Vec<(u32, usize)>)> {
    let mut by_type = std::collections::BTreeMap::<&str, Vec<(u32, usize)>>::new();
    for element in 0..entries.len() {
        for entry in entries.entries(element) {
            let places = by_type.entry(entries.type_of(entry)).or_default();
            places.push((element as u32, entry));
        }
    }
    by_type.into_iter().collect()
}
