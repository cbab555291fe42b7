//! Checks an edit of tables before it is applied, so that a rejected edit changes nothing.

use guideway_layout::{Attributes, Layout, Level, Member, TypeEntries, Value, Values};
use guideway_spline::Point;

use super::operation::{NewNode, NewStation, TableEdit};
use crate::edit::check::MAX_COORDINATE_M;
use crate::edit::error::EditError;
use crate::scene::Scene;
use crate::table::Table;

impl TableEdit {
    /// Accepts the edit or returns the reason for rejecting it.
    pub(in crate::edit) fn check(&self, scene: &Scene) -> Result<(), EditError> {
        let layout = scene.layout();
        match self {
            Self::SetIds { of, ids } => check_rows(*of, layout, ids.iter().map(|(row, _)| *row)),
            Self::SetValues {
                of,
                vehicle_type,
                column,
                rows,
                values,
                ..
            } => {
                check_rows(*of, layout, rows.iter().copied())?;
                check_values(column, rows.len(), values)?;
                match vehicle_type {
                    Some(name) => check_entries(*of, layout, rows, name),
                    None => Ok(()),
                }
            }
            Self::SetColumn {
                of,
                per_type,
                name,
                column,
            } => {
                let rows = column_len(*of, layout, *per_type)?;
                match column {
                    Some(column) if column.values.len() > rows => {
                        Err(EditError::ValueCountMismatch)
                    }
                    Some(column) => check_finite(name, &column.values),
                    None => Ok(()),
                }
            }
            Self::SetEntries { of, rows, entries } => {
                check_rows(*of, layout, rows.iter().copied())?;
                check_new_entries(*of, layout, rows.len(), entries)
            }
            Self::SetEnds(ends) => {
                check_rows(Table::Paths, layout, ends.iter().map(|(path, _)| *path))?;
                let nodes = ends.iter().flat_map(|(_, ends)| ends).flatten();
                check_rows(Table::Nodes, layout, nodes.copied())
            }
            Self::SetDirections(directions) => {
                let rows = directions.iter().map(|(path, _)| *path);
                check_rows(Table::Paths, layout, rows)
            }
            Self::SetLevels { of, levels } => {
                check_rows(*of, layout, levels.iter().map(|(row, _)| *row))?;
                check_levels(layout, levels.iter().filter_map(|(_, level)| *level))
            }
            Self::SetStationNodes(stations) => {
                let rows = stations.iter().map(|(station, _)| *station);
                check_rows(Table::Stations, layout, rows)?;
                let nodes = stations.iter().flat_map(|(_, nodes)| nodes.iter());
                check_rows(Table::Nodes, layout, nodes.copied())
            }
            Self::SetMembers(blocks) => {
                let rows = blocks.iter().map(|(block, _)| *block);
                check_below("block", layout.blocks.len(), rows)?;
                let mut members = blocks.iter().flat_map(|(_, members)| members.iter());
                members.try_for_each(|member| {
                    let (of, row) = match *member {
                        Member::Path(row) => (Table::Paths, row),
                        Member::Node(row) => (Table::Nodes, row),
                        Member::Station(row) => (Table::Stations, row),
                    };
                    check_rows(of, layout, [row])
                })
            }
            Self::MoveNodes(to) => {
                check_rows(Table::Nodes, layout, to.iter().map(|(node, _)| *node))?;
                check_positions(Table::Nodes, to.iter().map(|(_, at_m)| *at_m))
            }
            Self::MoveStations(to) => {
                let rows = to.iter().map(|(station, _)| *station);
                check_rows(Table::Stations, layout, rows)?;
                check_positions(Table::Stations, to.iter().filter_map(|(_, at_m)| *at_m))
            }
            Self::InsertNodes(nodes) => nodes.iter().try_for_each(|node| node.check(layout)),
            Self::InsertStations(stations) => {
                let mut stations = stations.iter();
                stations.try_for_each(|station| station.check(layout))
            }
            // The states of paths are those of `Edit::SetStates`.
            Self::SetExists {
                of: Table::Paths, ..
            } => Err(EditError::PathState),
            Self::SetExists { of, rows } => {
                check_rows(*of, layout, rows.iter().map(|(row, _)| *row))
            }
            Self::SetZoneLevels(levels) => {
                let rows = levels.iter().map(|(row, _)| *row);
                check_below("zone", layout.zones.len(), rows)?;
                check_levels(layout, levels.iter().filter_map(|(_, level)| *level))
            }
            Self::InsertLevel {
                row,
                level,
                elements,
            } => {
                check_below("level", layout.levels.len() + 1, [*row])?;
                for (of, rows) in Table::ALL.into_iter().zip(&**elements) {
                    check_rows(of, layout, rows.iter().copied())?;
                }
                check_level(level)
            }
            Self::RemoveLevel(row) => {
                check_levels(layout, [*row])?;
                let is_used = |of: Table| of.on_level(layout, *row).any(|e| scene.exists(of, e));
                let mut zones = layout.zones.iter();
                let has_zone = zones.any(|zone| zone.level == Some(*row));
                match has_zone || Table::ALL.into_iter().any(is_used) {
                    true => Err(EditError::LevelInUse { row: *row }),
                    false => Ok(()),
                }
            }
            Self::SetLevel { row, level } => {
                check_levels(layout, [*row])?;
                check_level(level)
            }
            Self::SetVehicleTypes(types) => types
                .iter()
                .try_for_each(|of_type| check_row(&of_type.attributes)),
        }
    }
}

impl NewNode {
    fn check(&self, layout: &Layout) -> Result<(), EditError> {
        check_positions(Table::Nodes, [self.position_m])?;
        check_levels(layout, self.level)?;
        check_rows(Table::Nodes, layout, self.attributes_of)
    }
}

impl NewStation {
    fn check(&self, layout: &Layout) -> Result<(), EditError> {
        check_positions(Table::Stations, self.position_m)?;
        check_levels(layout, self.level)?;
        check_rows(Table::Nodes, layout, self.nodes.iter().copied())?;
        check_rows(Table::Stations, layout, self.attributes_of)
    }
}

fn check_rows(
    of: Table,
    layout: &Layout,
    rows: impl IntoIterator<Item = u32>,
) -> Result<(), EditError> {
    check_below(of.element(), of.row_count(layout), rows)
}

fn check_levels(layout: &Layout, levels: impl IntoIterator<Item = u32>) -> Result<(), EditError> {
    check_below("level", layout.levels.len(), levels)
}

fn check_level(level: &Level) -> Result<(), EditError> {
    let height_m = level.elevation_m.map(Value::Float);
    check_finite("elevation", &Values::from_iter([height_m]))?;
    check_row(&level.attributes)
}

fn check_row(attributes: &Attributes) -> Result<(), EditError> {
    let mut columns = attributes.iter();
    columns.try_for_each(|column| check_finite(&column.name, &column.values))
}

fn check_below(
    what: &'static str,
    count: usize,
    rows: impl IntoIterator<Item = u32>,
) -> Result<(), EditError> {
    let unknown = rows.into_iter().find(|&row| row as usize >= count);
    unknown.map_or(Ok(()), |row| Err(EditError::UnknownReference { what, row }))
}

fn check_positions(
    of: Table,
    positions_m: impl IntoIterator<Item = Point<f64>>,
) -> Result<(), EditError> {
    let is_near = |p: Point<f64>| p.x.abs() <= MAX_COORDINATE_M && p.y.abs() <= MAX_COORDINATE_M;
    match positions_m.into_iter().all(is_near) {
        true => Ok(()),
        false => Err(EditError::FarPosition { what: of.element() }),
    }
}

fn check_values(column: &str, rows: usize, values: &Values) -> Result<(), EditError> {
    if values.len() != rows && values.len() != 1 {
        return Err(EditError::ValueCountMismatch);
    }
    check_finite(column, values)
}

fn check_finite(column: &str, values: &Values) -> Result<(), EditError> {
    let is_finite = |value| !matches!(value, Value::Float(v) if !f64::is_finite(v));
    match values.iter().flatten().all(is_finite) {
        true => Ok(()),
        false => Err(EditError::NotFinite {
            column: column.to_owned(),
        }),
    }
}

/// Number of rows of the columns of a table, or of its entries per vehicle type.
fn column_len(of: Table, layout: &Layout, per_type: bool) -> Result<usize, EditError> {
    if !per_type {
        return Ok(of.row_count(layout));
    }
    let entries = of.entries(layout).ok_or(EditError::NoVehicleTypes)?;
    let last = entries.len().checked_sub(1);
    Ok(last.map_or(0, |last| entries.entries(last).end))
}

/// Checks that each row has an entry for a vehicle type.
fn check_entries(of: Table, layout: &Layout, rows: &[u32], name: &str) -> Result<(), EditError> {
    let entries = of.entries(layout).ok_or(EditError::NoVehicleTypes)?;
    let lacks = |row: &&u32| entries.entry_for(**row as usize, name).is_none();
    match rows.iter().find(lacks) {
        None => Ok(()),
        Some(&row) => Err(EditError::NoEntry {
            what: of.element(),
            row,
            vehicle_type: name.to_owned(),
        }),
    }
}

/// Checks that new entries have a row per element and no column that would change the table's.
fn check_new_entries(
    of: Table,
    layout: &Layout,
    rows: usize,
    new: &TypeEntries,
) -> Result<(), EditError> {
    let entries = of.entries(layout).ok_or(EditError::NoVehicleTypes)?;
    if new.len() != rows {
        return Err(EditError::ValueCountMismatch);
    }
    let has_values =
        |column: &&guideway_layout::Attribute| column.values.iter().any(|v| v.is_some());
    let mut columns = new.attributes.iter().filter(has_values);
    columns.try_for_each(|column| {
        let (name, quantity) = (&column.name, column.quantity);
        if !entries.attributes.fits(name, quantity, &column.values) {
            return Err(EditError::ColumnType {
                column: name.clone(),
            });
        }
        check_finite(name, &column.values)
    })
}
