//! Reverses paths, and makes them one-way or two-way.

use std::sync::Arc;

use guideway_layout::{Direction, Values, WrittenCurves};
use guideway_scene::{Table, TableEdit};

use super::curves::runs_of;
use super::error::OperationError;
use super::perform::reshape_as_written;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;

/// Properties that a path exchanges when it is reversed: those of its ends and its sides.
const EXCHANGED: [[&str; 2]; 2] = [
    ["rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed"],
    ["corridor.leftWidth", "corridor.rightWidth"],
];

impl Document {
    /// Reverses paths: their curves, their nodes, and the properties of their ends and sides.
    ///
    /// # Errors
    /// When a path does not exist.
    pub fn reverse(&mut self, paths: &PathSet) -> Result<(), OperationError> {
        self.check_rows_exist(Table::Paths, paths)?;
        if paths.is_empty() {
            return Ok(());
        }
        let rows: Vec<u32> = paths.iter().collect();
        let path = |row: &u32| self.layout().paths.get(*row as usize);
        let curves: Vec<_> = rows
            .iter()
            .map(|row| runs_of(path(row)).reversed())
            .collect();
        let ends = rows
            .iter()
            .map(|row| (*row, [path(row).end_node(), path(row).start_node()]));
        let mut changes = vec![TableEdit::SetEnds(ends.collect()).into()];
        for [a, b] in EXCHANGED {
            changes.extend(self.exchange(&rows, a, b));
        }
        let mut written = WrittenCurves::default();
        for (i, &row) in rows.iter().enumerate() {
            let curve = self.layout().paths.written_curve(row as usize);
            written.set(i, curve.map(|curve| curve.reversed().into()));
        }
        changes.push(reshape_as_written(rows, &curves, written));
        Ok(self.perform("reverse", changes)?)
    }

    /// Makes paths one-way, from start to end, or two-way.
    ///
    /// # Errors
    /// When a path does not exist.
    pub fn set_direction(
        &mut self,
        paths: &PathSet,
        direction: Direction,
    ) -> Result<(), OperationError> {
        self.check_rows_exist(Table::Paths, paths)?;
        let directions: Arc<[_]> = paths.iter().map(|path| (path, direction)).collect();
        if directions.is_empty() {
            return Ok(());
        }
        let name = match direction {
            Direction::Forward => "make one-way",
            Direction::Both => "make two-way",
        };
        Ok(self.perform(name, vec![TableEdit::SetDirections(directions).into()])?)
    }

    /// Exchanges the values of two columns, for all vehicle types and per type.
    fn exchange(&self, rows: &[u32], a: &str, b: &str) -> Vec<Change> {
        let paths = &self.layout().paths;
        let entries = paths.vehicle_types();
        let mut changes = Vec::new();
        let mut exchange = |vehicle_type: Option<&str>, places: Vec<usize>, rows: Vec<u32>| {
            let columns = match vehicle_type {
                Some(_) => &entries.attributes,
                None => &paths.attributes,
            };
            for (from, to) in [(a, b), (b, a)] {
                let source = columns.get(from);
                let values: Values = match source {
                    Some(column) => column.values.select(&places),
                    None => places.iter().map(|_| None).collect(),
                };
                let has_values = values.iter().any(|value| value.is_some());
                if !has_values && columns.get(to).is_none() {
                    continue;
                }
                let edit = TableEdit::SetValues {
                    of: Table::Paths,
                    vehicle_type: vehicle_type.map(Arc::from),
                    column: to.into(),
                    quantity: source.and_then(|column| column.quantity),
                    rows: rows.as_slice().into(),
                    values: Arc::new(values),
                };
                changes.push(edit.into());
            }
        };
        exchange(
            None,
            rows.iter().map(|&row| row as usize).collect(),
            rows.to_vec(),
        );
        for name in entries.names() {
            let entry = |&row: &u32| Some((row, entries.entry_for(row as usize, name)?));
            let (rows, places): (Vec<u32>, Vec<usize>) = rows.iter().filter_map(entry).unzip();
            if !rows.is_empty() {
                exchange(Some(name), places, rows);
            }
        }
        changes
    }
}
