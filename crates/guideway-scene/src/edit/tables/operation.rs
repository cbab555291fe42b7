//! Edits of tables as data.

use std::sync::Arc;

use guideway_layout::{
    Attribute, Direction, Level, Member, Quantity, TypeEntries, Values, VehicleType,
};
use guideway_spline::Point;

use crate::table::Table;

/// A change of the tables of a layout. Rows are stable: a removed node or station keeps its row, an
/// inserted one gets the next row.
#[derive(Clone, Debug)]
pub enum TableEdit {
    /// Sets identifiers. Cost: O(all identifiers of the table).
    SetIds {
        /// The table.
        of: Table,
        /// Rows and their new identifiers.
        ids: Arc<[(u32, Box<str>)]>,
    },
    /// Sets or removes the values of some rows in one column, which is created if it is new.
    SetValues {
        /// The table.
        of: Table,
        /// Sets the values for one vehicle type. Each row needs an entry for it.
        vehicle_type: Option<Arc<str>>,
        /// Name of the column.
        column: Arc<str>,
        /// Quantity of the column; `None` keeps that of an existing column.
        quantity: Option<Quantity>,
        /// Rows of elements.
        rows: Arc<[u32]>,
        /// One value per row, or one for all; a missing one removes the value of its row.
        values: Arc<Values>,
    },
    /// Replaces or removes a whole column.
    SetColumn {
        /// The table.
        of: Table,
        /// The column of the entries per vehicle type, else that of the elements.
        per_type: bool,
        /// Name of the column.
        name: Arc<str>,
        /// The new column; `None` removes it.
        column: Option<Arc<Attribute>>,
    },
    /// Sets the vehicle types of paths or nodes, with their properties per type. Cost: O(all
    /// entries of the table).
    SetEntries {
        /// The paths or the nodes.
        of: Table,
        /// Rows of elements, each once.
        rows: Arc<[u32]>,
        /// One element per row. Its columns are columns of the table, of the same type.
        entries: Arc<TypeEntries>,
    },
    /// Sets the first and the last node of paths.
    SetEnds(Arc<[(u32, [Option<u32>; 2])]>),
    /// Sets the directions of paths.
    SetDirections(Arc<[(u32, Direction)]>),
    /// Sets levels.
    SetLevels {
        /// The table.
        of: Table,
        /// Rows and their levels.
        levels: Arc<[(u32, Option<u32>)]>,
    },
    /// Sets the nodes that serve stations.
    SetStationNodes(Arc<[(u32, Box<[u32]>)]>),
    /// Sets the members of blocks.
    SetMembers(Arc<[(u32, Box<[Member]>)]>),
    /// Moves nodes to positions in meters.
    MoveNodes(Arc<[(u32, Point<f64>)]>),
    /// Moves stations to positions in meters, or removes their positions.
    MoveStations(Arc<[(u32, Option<Point<f64>>)]>),
    /// Appends nodes after the last row.
    InsertNodes(Arc<[NewNode]>),
    /// Appends stations after the last row.
    InsertStations(Arc<[NewStation]>),
    /// Removes or restores nodes or stations.
    SetExists {
        /// The nodes or the stations.
        of: Table,
        /// Rows, each with `false` to remove it.
        rows: Arc<[(u32, bool)]>,
    },
    /// Sets the levels of zones.
    SetZoneLevels(Arc<[(u32, Option<u32>)]>),
    /// Inserts a level. The rows of the levels from `row` on grow by one, also where elements
    /// refer to them. Cost: O(all elements).
    InsertLevel {
        /// Its row.
        row: u32,
        /// The level.
        level: Arc<Level>,
        /// Rows of the paths, nodes and stations that come onto it.
        elements: Arc<[Vec<u32>; 3]>,
    },
    /// Removes a level on which no element exists; removed elements of it are on no level then. The
    /// rows of the levels after it shrink by one. Cost: O(all elements).
    RemoveLevel(u32),
    /// Replaces the names, the height and the properties of a level.
    SetLevel {
        /// Its row.
        row: u32,
        /// The level as it becomes.
        level: Arc<Level>,
    },
    /// Replaces the table of vehicle types with their properties.
    SetVehicleTypes(Arc<[VehicleType]>),
}

/// A node to insert.
#[derive(Clone, Debug, PartialEq)]
pub struct NewNode {
    /// Identifier.
    pub id: String,
    /// Position, in meters.
    pub position_m: Point<f64>,
    /// Index in [`guideway_layout::Layout::levels`].
    pub level: Option<u32>,
    /// Vehicle types with entries.
    pub vehicle_types: Vec<String>,
    /// Row of the node whose properties it copies, if any.
    pub attributes_of: Option<u32>,
}

/// A station to insert.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NewStation {
    /// Identifier.
    pub id: String,
    /// Position in meters, if it has one of its own.
    pub position_m: Option<Point<f64>>,
    /// Rows of the nodes that serve it.
    pub nodes: Vec<u32>,
    /// Index in [`guideway_layout::Layout::levels`].
    pub level: Option<u32>,
    /// Row of the station whose properties it copies, if any.
    pub attributes_of: Option<u32>,
}

impl TableEdit {
    /// Heap bytes held, shared with clones.
    pub fn heap_bytes(&self) -> usize {
        match self {
            Self::SetIds { ids, .. } => {
                size_of_val(&**ids) + ids.iter().map(|(_, id)| id.len()).sum::<usize>()
            }
            Self::SetValues { rows, values, .. } => size_of_val(&**rows) + values.heap_bytes(),
            Self::SetColumn { column, .. } => column
                .as_ref()
                .map_or(0, |column| column.values.heap_bytes()),
            Self::SetEntries { rows, entries, .. } => size_of_val(&**rows) + entries.heap_bytes(),
            Self::SetEnds(ends) => size_of_val(&**ends),
            Self::SetDirections(directions) => size_of_val(&**directions),
            Self::SetLevels { levels, .. } => size_of_val(&**levels),
            Self::SetStationNodes(nodes) => {
                let all = nodes.iter().map(|(_, nodes)| size_of_val(&**nodes));
                size_of_val(&**nodes) + all.sum::<usize>()
            }
            Self::SetMembers(members) => {
                let all = members.iter().map(|(_, members)| size_of_val(&**members));
                size_of_val(&**members) + all.sum::<usize>()
            }
            Self::MoveNodes(nodes) => size_of_val(&**nodes),
            Self::MoveStations(stations) => size_of_val(&**stations),
            Self::InsertNodes(nodes) => {
                let types =
                    |n: &NewNode| -> usize { n.vehicle_types.iter().map(String::capacity).sum() };
                let texts = nodes.iter().map(|n| n.id.capacity() + types(n));
                size_of_val(&**nodes) + texts.sum::<usize>()
            }
            Self::InsertStations(stations) => {
                let own = |s: &NewStation| s.id.capacity() + size_of_val(&*s.nodes);
                size_of_val(&**stations) + stations.iter().map(own).sum::<usize>()
            }
            Self::SetExists { rows, .. } => size_of_val(&**rows),
            Self::SetZoneLevels(levels) => size_of_val(&**levels),
            Self::InsertLevel {
                level, elements, ..
            } => {
                level_bytes(level)
                    + elements
                        .iter()
                        .map(|rows| size_of_val(&**rows))
                        .sum::<usize>()
            }
            Self::SetLevel { level, .. } => level_bytes(level),
            Self::RemoveLevel(_) => 0,
            Self::SetVehicleTypes(types) => {
                let own = |t: &VehicleType| t.id.capacity() + t.attributes.heap_bytes();
                size_of_val(&**types) + types.iter().map(own).sum::<usize>()
            }
        }
    }
}

fn level_bytes(level: &Level) -> usize {
    level.id.capacity() + level.attributes.heap_bytes()
}
