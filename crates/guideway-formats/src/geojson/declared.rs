//! Declared columns: type and unit that the member `guideway` of a collection states for columns.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::{Attribute, Attributes, Quantity};
use serde::Deserialize;

use super::model::Columns;
use super::properties::{ColumnValue, Properties, Property};
use crate::builder::Table;
use crate::json::Field;

/// The table of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Paths,
    PathTypes,
    Nodes,
    NodeTypes,
    Stations,
    Levels,
    VehicleTypes,
    Blocks,
    Zones,
    Layout,
}

impl Owner {
    /// All tables, with their keys in the member.
    pub(super) const ALL: [(Self, &str); 10] = [
        (Self::Paths, "paths"),
        (Self::PathTypes, "pathTypes"),
        (Self::Nodes, "nodes"),
        (Self::NodeTypes, "nodeTypes"),
        (Self::Stations, "stations"),
        (Self::Levels, "levels"),
        (Self::VehicleTypes, "vehicleTypes"),
        (Self::Blocks, "blocks"),
        (Self::Zones, "zones"),
        (Self::Layout, "layout"),
    ];
}

/// Tables of elements.
pub(super) const PATHS: (Owner, Table) = (Owner::Paths, Table::Paths);
pub(super) const PATH_TYPES: (Owner, Table) = (Owner::PathTypes, Table::PathTypes);
pub(super) const NODES: (Owner, Table) = (Owner::Nodes, Table::Nodes);
pub(super) const NODE_TYPES: (Owner, Table) = (Owner::NodeTypes, Table::NodeTypes);
pub(super) const STATIONS: (Owner, Table) = (Owner::Stations, Table::Stations);

/// Types as the member names them.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Boolean,
    Integer,
    Number,
    Text,
    Json,
}

#[derive(Deserialize)]
struct ColumnJson<'a> {
    #[serde(rename = "type")]
    kind: Kind,
    #[serde(borrow)]
    unit: Option<Cow<'a, str>>,
}

/// Type and unit of each declared column; empty without the member.
#[derive(Default)]
pub(super) struct Declared([HashMap<String, (Kind, Option<Quantity>)>; 10]);

impl Declared {
    pub(super) fn read(columns: &Columns<'_>) -> Self {
        let mut declared = Self::default();
        let tables = [
            &columns.paths,
            &columns.path_types,
            &columns.nodes,
            &columns.node_types,
            &columns.stations,
            &columns.levels,
            &columns.vehicle_types,
            &columns.blocks,
            &columns.zones,
            &columns.layout,
        ];
        for (found, table) in declared.0.iter_mut().zip(tables) {
            let properties = table.get().into_iter().flat_map(Properties::iter);
            found.extend(properties.filter_map(|(name, column)| {
                let column: ColumnJson<'_> = column.parse()?;
                let unit = column.unit.and_then(|unit| Quantity::of_unit(&unit));
                Some((name.to_owned(), (column.kind, unit)))
            }));
        }
        declared
    }

    /// Reads a value in the declared type of its column.
    pub(super) fn value<'p>(
        &self,
        owner: Owner,
        name: &str,
        property: Property<'p>,
    ) -> ColumnValue<'p> {
        let kind = self.0[owner as usize].get(name).map(|(kind, _)| *kind);
        match (kind, property.read()) {
            (Some(Kind::Json), _) => ColumnValue::Json(property.json()),
            // Other programs write 2.0 as 2.
            (Some(Kind::Number), ColumnValue::Int(whole)) => ColumnValue::Float(whole as f64),
            (Some(Kind::Number), ColumnValue::Text(text)) => match text.as_ref() {
                "NaN" => ColumnValue::Float(f64::NAN),
                "Infinity" => ColumnValue::Float(f64::INFINITY),
                "-Infinity" => ColumnValue::Float(f64::NEG_INFINITY),
                _ => ColumnValue::Text(text),
            },
            (_, value) => value,
        }
    }

    /// Sets the declared units of the columns of a table.
    pub(super) fn set_units(&self, owner: Owner, attributes: &mut Attributes) {
        for (name, (_, unit)) in &self.0[owner as usize] {
            let column = attributes.get(name).filter(|_| unit.is_some());
            if let Some(column) = column {
                let column = Attribute {
                    quantity: *unit,
                    ..column.clone()
                };
                attributes.insert(column);
            }
        }
    }
}

/// Returns the type of a column as the member states it.
pub(super) fn kind_name(column: &Attribute) -> &'static str {
    use guideway_layout::Values;
    match column.values {
        Values::Bool(_) => "boolean",
        Values::Int(_) => "integer",
        Values::Float(_) => "number",
        Values::Text(_) => "text",
        Values::Json(_) => "json",
    }
}

/// Iterates over the records of a list of the member.
pub(super) fn records<T>(list: &Field<Vec<Field<T>>>) -> impl Iterator<Item = &T> {
    list.get().into_iter().flatten().filter_map(Field::get)
}
