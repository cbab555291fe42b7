//! Inverses of edits of tables.

use std::sync::Arc;

use guideway_layout::Layout;

use super::operation::TableEdit;
use crate::scene::Scene;
use crate::table::Table;

impl TableEdit {
    /// The inverse of a checked edit that is not applied yet.
    pub(in crate::edit) fn inverse(&self, scene: &Scene) -> Self {
        let layout = scene.layout();
        match self {
            Self::SetIds { of, ids } => {
                let old = ids.iter().map(|&(row, _)| (row, of.id(layout, row).into()));
                Self::SetIds {
                    of: *of,
                    ids: old.collect(),
                }
            }
            Self::SetValues { .. } => self.inverse_of_values(layout),
            Self::SetColumn {
                of, per_type, name, ..
            } => Self::SetColumn {
                of: *of,
                per_type: *per_type,
                name: Arc::clone(name),
                column: whole_column(*of, layout, *per_type, name),
            },
            Self::SetEntries { of, rows, .. } => {
                let elements: Vec<usize> = rows.iter().map(|&row| row as usize).collect();
                let old = of.entries(layout).map(|entries| entries.select(&elements));
                Self::SetEntries {
                    of: *of,
                    rows: Arc::clone(rows),
                    entries: Arc::new(old.unwrap_or_default()),
                }
            }
            Self::SetEnds(ends) => {
                let old = ends.iter().map(|&(row, _)| {
                    let path = layout.paths.get(row as usize);
                    (row, [path.start_node(), path.end_node()])
                });
                Self::SetEnds(old.collect())
            }
            Self::SetDirections(directions) => {
                let old = |row: u32| layout.paths.get(row as usize).direction();
                let old = directions.iter().map(|&(row, _)| (row, old(row)));
                Self::SetDirections(old.collect())
            }
            Self::SetLevels { of, levels } => {
                let old = levels.iter().map(|&(row, _)| (row, of.level(layout, row)));
                Self::SetLevels {
                    of: *of,
                    levels: old.collect(),
                }
            }
            Self::SetStationNodes(stations) => {
                let old = |row: u32| layout.stations.nodes(row).into();
                Self::SetStationNodes(stations.iter().map(|&(row, _)| (row, old(row))).collect())
            }
            Self::SetMembers(blocks) => {
                let old = |row: u32| layout.blocks[row as usize].members.as_slice().into();
                Self::SetMembers(blocks.iter().map(|&(row, _)| (row, old(row))).collect())
            }
            Self::MoveNodes(to) => {
                let old = to
                    .iter()
                    .map(|&(row, _)| (row, layout.nodes.position_m(row)));
                Self::MoveNodes(old.collect())
            }
            Self::MoveStations(to) => {
                let old = |row: u32| layout.stations.position_m(row);
                Self::MoveStations(to.iter().map(|&(row, _)| (row, old(row))).collect())
            }
            Self::InsertNodes(new) => removal(Table::Nodes, layout, new.len()),
            Self::InsertStations(new) => removal(Table::Stations, layout, new.len()),
            Self::SetExists { of, rows } => {
                let old = rows.iter().map(|&(row, _)| (row, scene.exists(*of, row)));
                Self::SetExists {
                    of: *of,
                    rows: old.collect(),
                }
            }
            Self::SetZoneLevels(levels) => {
                let old = |row: u32| layout.zones[row as usize].level;
                Self::SetZoneLevels(levels.iter().map(|&(row, _)| (row, old(row))).collect())
            }
            Self::InsertLevel { row, .. } => Self::RemoveLevel(*row),
            Self::RemoveLevel(row) => Self::InsertLevel {
                row: *row,
                level: Arc::new(layout.levels[*row as usize].clone()),
                elements: Arc::new(Table::ALL.map(|of| of.on_level(layout, *row).collect())),
            },
            Self::SetLevel { row, .. } => Self::SetLevel {
                row: *row,
                level: Arc::new(layout.levels[*row as usize].clone()),
            },
            Self::SetVehicleTypes(_) => {
                Self::SetVehicleTypes(layout.vehicle_types.as_slice().into())
            }
        }
    }

    /// Restores the values of the rows, or the whole column if the edit changes its type, its
    /// quantity or its existence.
    fn inverse_of_values(&self, layout: &Layout) -> Self {
        let Self::SetValues {
            of,
            vehicle_type,
            column: name,
            quantity,
            rows,
            values,
        } = self
        else {
            return self.clone();
        };
        let per_type = vehicle_type.is_some();
        let columns = of.columns(layout, per_type);
        let column = columns.and_then(|columns| columns.get(name));
        let fits = columns.is_some_and(|columns| columns.fits(name, *quantity, values));
        match column.filter(|_| fits) {
            Some(column) => {
                let places = places(*of, layout, vehicle_type.as_deref(), rows);
                Self::SetValues {
                    of: *of,
                    vehicle_type: vehicle_type.clone(),
                    column: Arc::clone(name),
                    quantity: *quantity,
                    rows: Arc::clone(rows),
                    values: Arc::new(column.values.select(&places)),
                }
            }
            None => Self::SetColumn {
                of: *of,
                per_type,
                name: Arc::clone(name),
                column: whole_column(*of, layout, per_type, name),
            },
        }
    }
}

/// Rows of a column: those of the elements, or those of their entries for a vehicle type.
pub(super) fn places(
    of: Table,
    layout: &Layout,
    vehicle_type: Option<&str>,
    rows: &[u32],
) -> Vec<usize> {
    let elements = rows.iter().map(|&row| row as usize);
    match (vehicle_type, of.entries(layout)) {
        (Some(name), Some(entries)) => elements
            .filter_map(|row| entries.entry_for(row, name))
            .collect(),
        _ => elements.collect(),
    }
}

fn whole_column(
    of: Table,
    layout: &Layout,
    per_type: bool,
    name: &str,
) -> Option<Arc<guideway_layout::Attribute>> {
    let column = of.columns(layout, per_type)?.get(name)?;
    Some(Arc::new(column.clone()))
}

/// Removes the rows that an insertion of `count` elements appends.
fn removal(of: Table, layout: &Layout, count: usize) -> TableEdit {
    let first = of.row_count(layout) as u32;
    let rows = first..first + count as u32;
    TableEdit::SetExists {
        of,
        rows: rows.map(|row| (row, false)).collect(),
    }
}
