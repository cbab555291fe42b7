//! Columns of the tables of elements: built-in facts and attributes, by name.

use std::cmp::Ordering;

use guideway_layout::{Attribute, Direction, Layout, Value};
use guideway_scene::Table;
use guideway_spline::Point;

use super::natural::natural_order;

/// A column of the paths, nodes or stations of a layout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// Identifier.
    Id,
    /// Identifier of the first node of a path.
    Start,
    /// Identifier of the last node of a path.
    End,
    /// Travel direction of a path.
    Direction,
    /// Length of a path.
    Length,
    /// First coordinate of a node or station.
    X,
    /// Second coordinate of a node or station.
    Y,
    /// Identifiers of the nodes of a station.
    Nodes,
    /// Name of the level.
    Level,
    /// Vehicle types of a path or node.
    VehicleType,
    /// An attribute of the file, by name.
    Attribute(String),
}

/// Columns that every layout has. An attribute of the same name takes precedence.
const OF_PATHS: &[(&str, Column)] = &[
    ("id", Column::Id),
    ("level", Column::Level),
    ("direction", Column::Direction),
    ("vehicle_type", Column::VehicleType),
    ("length_m", Column::Length),
    ("start_node", Column::Start),
    ("end_node", Column::End),
];
const OF_NODES: &[(&str, Column)] = &[
    ("id", Column::Id),
    ("level", Column::Level),
    ("vehicle_type", Column::VehicleType),
    ("x", Column::X),
    ("y", Column::Y),
];
const OF_STATIONS: &[(&str, Column)] = &[
    ("id", Column::Id),
    ("level", Column::Level),
    ("nodes", Column::Nodes),
    ("x", Column::X),
    ("y", Column::Y),
];

fn built_in(of: Table) -> &'static [(&'static str, Column)] {
    match of {
        Table::Paths => OF_PATHS,
        Table::Nodes => OF_NODES,
        Table::Stations => OF_STATIONS,
    }
}

impl Column {
    /// All columns of a table: the built-in ones, then the attributes for all vehicle types and per
    /// type.
    pub fn all(layout: &Layout, of: Table) -> Vec<Self> {
        let built_in = built_in(of).iter().map(|(_, column)| column.clone());
        let attributes = attribute_names(layout, of).map(|name| Self::Attribute(name.to_owned()));
        built_in.chain(attributes).collect()
    }

    /// The name by which queries know the column.
    pub fn name(&self) -> &str {
        match self {
            Self::Attribute(name) => name,
            _ => {
                let mut all = OF_PATHS.iter().chain(OF_NODES).chain(OF_STATIONS);
                all.find(|(_, column)| column == self)
                    .map_or("", |(name, _)| name)
            }
        }
    }

    /// The unit of its numbers.
    pub fn unit(&self, layout: &Layout, of: Table) -> Option<&'static str> {
        match self {
            Self::Length | Self::X | Self::Y => Some("m"),
            Self::Attribute(name) => {
                let quantity = attribute(layout, of, name)?.quantity;
                quantity.map(|quantity| quantity.unit())
            }
            _ => None,
        }
    }

    /// The column of this name, if the table has it.
    pub(super) fn named(name: &str, layout: &Layout, of: Table) -> Option<Self> {
        if attribute(layout, of, name).is_some() {
            return Some(Self::Attribute(name.to_owned()));
        }
        let mut built_in = built_in(of).iter();
        built_in
            .find(|(known, _)| *known == name)
            .map(|(_, column)| column.clone())
    }

    /// Names of all columns of a table, for error texts.
    pub(super) fn names(layout: &Layout, of: Table) -> Vec<String> {
        let built_in = built_in(of).iter().map(|(name, _)| (*name).to_owned());
        let own = attribute_names(layout, of).map(str::to_owned);
        built_in.chain(own).collect()
    }

    /// Passes the value of an element to `read`; `None` if it has none. Of several values per
    /// vehicle type, it is the first one.
    pub fn with_value<R>(
        &self,
        layout: &Layout,
        of: Table,
        row: u32,
        read: impl FnOnce(Value<'_>) -> R,
    ) -> Option<R> {
        let path = || (of == Table::Paths).then(|| layout.paths.get(row as usize));
        let node = |node: Option<u32>| Some(Value::Text(layout.nodes.id(node?)));
        let value = match self {
            Self::Id => Value::Text(of.id(layout, row)),
            Self::Start => node(path()?.start_node())?,
            Self::End => node(path()?.end_node())?,
            Self::Direction => Value::Text(direction_name(path()?.direction())),
            Self::Length => Value::Float(path()?.length_m()),
            Self::X => Value::Float(position_m(layout, of, row)?.x),
            Self::Y => Value::Float(position_m(layout, of, row)?.y),
            Self::Nodes => {
                let nodes = layout.stations.nodes(row).iter();
                let names: Vec<&str> = nodes.map(|&node| layout.nodes.id(node)).collect();
                return (!names.is_empty()).then(|| read(Value::Text(&names.join(", "))));
            }
            Self::Level => {
                let level = layout.levels.get(of.level(layout, row)? as usize)?;
                Value::Text(level.name_or_id())
            }
            Self::VehicleType => {
                let types: Vec<_> = of.entries(layout)?.of(row as usize).collect();
                return (!types.is_empty()).then(|| read(Value::Text(&types.join(", "))));
            }
            Self::Attribute(name) => {
                let own = of.attributes(layout).value(row as usize, name);
                let of_type = || of.entries(layout)?.first_value(row as usize, name);
                own.or_else(of_type)?
            }
        };
        Some(read(value))
    }

    /// Sorts rows by this column: numbers by size, texts in natural order, and elements without a
    /// value last.
    pub fn sort(&self, layout: &Layout, of: Table, rows: &mut [u32], descending: bool) {
        enum Key {
            Number(f64),
            Text(String),
            None,
        }
        let key = |row: u32| {
            let key = self.with_value(layout, of, row, |value| match value {
                Value::Int(number) => Key::Number(number as f64),
                Value::Float(number) => Key::Number(number),
                other => Key::Text(other.to_string()),
            });
            (key.unwrap_or(Key::None), row)
        };
        let order = |a: &Key, b: &Key| {
            let order = match (a, b) {
                (Key::Number(a), Key::Number(b)) => a.total_cmp(b),
                (Key::Text(a), Key::Text(b)) => natural_order(a, b),
                (Key::Number(_), Key::Text(_)) => Ordering::Less,
                (Key::Text(_), Key::Number(_)) => Ordering::Greater,
                (Key::None, Key::None) => return Ordering::Equal,
                (Key::None, _) => return Ordering::Greater,
                (_, Key::None) => return Ordering::Less,
            };
            if descending { order.reverse() } else { order }
        };
        let mut keys: Vec<(Key, u32)> = rows.iter().map(|&row| key(row)).collect();
        keys.sort_by(|a, b| order(&a.0, &b.0));
        for (row, (_, sorted)) in rows.iter_mut().zip(keys) {
            *row = sorted;
        }
    }
}

/// The attribute of this name, for all vehicle types, else that of the entries.
fn attribute<'a>(layout: &'a Layout, of: Table, name: &str) -> Option<&'a Attribute> {
    let own = of.attributes(layout).get(name);
    own.or_else(|| of.entries(layout)?.attributes.get(name))
}

/// Names of the attributes: those for all vehicle types, then those per type.
fn attribute_names(layout: &Layout, of: Table) -> impl Iterator<Item = &str> {
    let own = of.attributes(layout);
    let per_type = of.entries(layout).into_iter();
    let per_type = per_type.flat_map(|entries| entries.attributes.iter());
    let per_type = per_type.filter(|column| own.get(&column.name).is_none());
    own.iter().chain(per_type).map(|column| &*column.name)
}

/// Position of a node, or of a station, which may be that of its first node.
fn position_m(layout: &Layout, of: Table, row: u32) -> Option<Point<f64>> {
    match of {
        Table::Paths => None,
        Table::Nodes => Some(layout.nodes.position_m(row)),
        Table::Stations => layout.station_position_m(row),
    }
}

/// A direction as text, the same as in legends.
fn direction_name(direction: Direction) -> &'static str {
    match direction {
        Direction::Forward => "one-way",
        Direction::Both => "two-way",
    }
}
