//! Applies checked edits of tables.

use std::sync::Arc;

use guideway_layout::{Attribute, Layout, Nodes, Stations};

use super::inverse::places;
use super::operation::{NewNode, NewStation, TableEdit};
use crate::scene::Scene;
use crate::table::Table;

impl Scene {
    /// Applies a checked edit of tables.
    pub(in crate::edit) fn apply_to_tables(&mut self, edit: &TableEdit) {
        if let TableEdit::SetExists { of, rows } = edit {
            self.set_exists(*of, rows);
            return;
        }
        self.level = self.level.and_then(|level| edit.level_after(level));
        edit.apply(Arc::make_mut(&mut self.layout));
    }
}

impl TableEdit {
    /// The row of a level after the edit; `None` if the edit removes it.
    pub fn level_after(&self, level: u32) -> Option<u32> {
        match *self {
            Self::InsertLevel { row, .. } => Some(level + u32::from(level >= row)),
            Self::RemoveLevel(row) => (level != row).then(|| level - u32::from(level > row)),
            _ => Some(level),
        }
    }

    fn apply(&self, layout: &mut Layout) {
        match self {
            Self::SetIds { of, ids } => set_ids(*of, layout, ids),
            Self::SetValues {
                of,
                vehicle_type,
                column,
                quantity,
                rows,
                values,
            } => {
                let places = places(*of, layout, vehicle_type.as_deref(), rows);
                if let Some(columns) = of.columns_mut(layout, vehicle_type.is_some()) {
                    columns.set_rows(column, *quantity, places, values);
                }
            }
            Self::SetColumn {
                of,
                per_type,
                name,
                column,
            } => match (of.columns_mut(layout, *per_type), column) {
                (Some(columns), Some(column)) => columns.insert(Attribute {
                    name: name.as_ref().to_owned(),
                    ..(**column).clone()
                }),
                (Some(columns), None) => drop(columns.remove(name)),
                (None, _) => {}
            },
            Self::SetEntries { of, rows, entries } => {
                let elements: Vec<usize> = rows.iter().map(|&row| row as usize).collect();
                if let Some(table) = of.entries_mut(layout) {
                    table.replace(&elements, entries);
                }
            }
            Self::SetEnds(ends) => {
                for &(path, [start, end]) in ends.iter() {
                    layout.paths.set_nodes(path as usize, start, end);
                }
            }
            Self::SetDirections(directions) => {
                for &(path, direction) in directions.iter() {
                    layout.paths.set_direction(path as usize, direction);
                }
            }
            Self::SetLevels { of, levels } => {
                let levels = levels.iter();
                levels.for_each(|&(row, level)| of.set_level(layout, row, level));
            }
            Self::SetStationNodes(stations) => {
                for (station, nodes) in stations.iter() {
                    layout.stations.set_nodes(*station, nodes.to_vec());
                }
            }
            Self::SetMembers(blocks) => {
                for (block, members) in blocks.iter() {
                    layout.blocks[*block as usize].members = members.to_vec();
                }
            }
            Self::MoveNodes(to) => {
                for &(node, at_m) in to.iter() {
                    layout.nodes.set_position_m(node, at_m);
                }
            }
            Self::MoveStations(to) => {
                for &(station, at_m) in to.iter() {
                    layout.stations.set_position_m(station, at_m);
                }
            }
            Self::InsertNodes(new) => new.iter().for_each(|node| node.push(&mut layout.nodes)),
            Self::InsertStations(new) => {
                new.iter()
                    .for_each(|station| station.push(&mut layout.stations));
            }
            Self::SetExists { .. } => {}
            Self::SetZoneLevels(levels) => {
                for &(zone, level) in levels.iter() {
                    layout.zones[zone as usize].level = level;
                }
            }
            Self::InsertLevel {
                row,
                level,
                elements,
            } => {
                layout.insert_level(*row, (**level).clone());
                for (of, rows) in Table::ALL.into_iter().zip(&**elements) {
                    rows.iter()
                        .for_each(|&of_table| of.set_level(layout, of_table, Some(*row)));
                }
            }
            Self::RemoveLevel(row) => drop(layout.remove_level(*row)),
            Self::SetLevel { row, level } => {
                layout.levels[*row as usize].clone_from(level);
            }
            Self::SetVehicleTypes(types) => layout.vehicle_types = types.to_vec(),
        }
    }
}

fn set_ids(of: Table, layout: &mut Layout, ids: &[(u32, Box<str>)]) {
    let mut sorted: Vec<(u32, &str)> = ids.iter().map(|(row, id)| (*row, &**id)).collect();
    sorted.sort_by_key(|(row, _)| *row);
    sorted.dedup_by_key(|(row, _)| *row);
    match of {
        Table::Paths => {
            let rows: Vec<_> = sorted.iter().map(|&(row, id)| (row as usize, id)).collect();
            layout.paths.set_ids(&rows);
        }
        Table::Nodes => layout.nodes.set_ids(&sorted),
        Table::Stations => layout.stations.set_ids(&sorted),
    }
}

impl NewNode {
    fn push(&self, nodes: &mut Nodes) {
        let types: Vec<&str> = self.vehicle_types.iter().map(String::as_str).collect();
        let row = nodes.push_for_types(&self.id, self.position_m, self.level, &types);
        if let Some(from) = self.attributes_of {
            nodes.attributes.copy_row(from as usize, row as usize);
            let entries = nodes.vehicle_types_mut();
            entries.copy_values(from as usize, row as usize);
        }
    }
}

impl NewStation {
    fn push(&self, stations: &mut Stations) {
        let nodes = self.nodes.clone();
        let row = stations.push(&self.id, self.position_m, nodes, self.level);
        if let Some(from) = self.attributes_of {
            stations.attributes.copy_row(from as usize, row as usize);
        }
    }
}
