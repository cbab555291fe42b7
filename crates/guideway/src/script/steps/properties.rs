//! Steps that set properties, names, vehicle types and levels.

use guideway_document::{Document, PropertyRef};
use guideway_scene::Table;

use super::values::Given;
use crate::script::error::StepError;
use crate::script::members::Members;
use crate::script::selection::{NODES, PATHS, STATIONS, row_named};
use crate::script::step::{StepKind, Touched, optional, required};

pub(super) const SET: StepKind = StepKind {
    name: "set",
    meaning: "Sets a property, or removes it.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required("property", "text", "Name, such as `maxSpeed`."),
        required(
            "value",
            "any; m, m/s, degrees",
            "The value, in the unit of the property; `null` removes it.",
        ),
        optional(
            "vehicle_type",
            "text",
            "Sets it for this vehicle type only.",
        ),
    ],
    example: r#"{"do": "set", "paths": "all", "property": "maxSpeed", "value": 0.8}"#,
    perform: set,
};

fn set(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    let name = members.text("property")?;
    let vehicle_type = members.optional_text("vehicle_type")?;
    let json = members.get("value").unwrap_or(&serde_json::Value::Null);
    for of in [Table::Paths, Table::Nodes, Table::Stations] {
        let value = Given::of(json, of, name, document);
        let property = PropertyRef {
            of,
            name,
            vehicle_type,
        };
        document.set_property(property, elements.rows(of), value.value())?;
    }
    Ok(Touched::of(elements, document))
}

pub(super) const RENAME: StepKind = StepKind {
    name: "rename",
    meaning: "Renames an element; what refers to it follows.",
    members: &[
        optional("path", "text", "Name of the path."),
        optional("node", "text", "Name of the node."),
        optional("station", "text", "Name of the station."),
        required("to", "text", "New name, which no other such element has."),
    ],
    example: r#"{"do": "rename", "node": "cross-171", "to": "gate"}"#,
    perform: rename,
};

fn rename(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let tables = [
        ("path", Table::Paths),
        ("node", Table::Nodes),
        ("station", Table::Stations),
    ];
    let mut named = tables
        .into_iter()
        .filter(|(name, _)| members.get(name).is_some());
    let (Some((member, of)), None) = (named.next(), named.next()) else {
        return Err(StepError::of_member(
            "node",
            "the step names no element, or several",
            "Write one of `path`, `node` and `station`",
        ));
    };
    let row = row_named(member, of, members.text(member)?, document)?;
    document.rename(of, row, members.text("to")?)?;
    Ok(Touched::one(of, row, document))
}

pub(super) const SET_VEHICLE_TYPES: StepKind = StepKind {
    name: "set-vehicle-types",
    meaning: "Sets the vehicle types that may use paths, or that have properties at nodes.",
    members: &[
        PATHS,
        NODES,
        required(
            "types",
            "[text, ...]",
            "Names of the types; none opens a path to all.",
        ),
    ],
    example: r#"{"do": "set-vehicle-types", "paths": "all", "types": ["tugger-3000"]}"#,
    perform: set_vehicle_types,
};

fn set_vehicle_types(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    let types = members.texts("types")?;
    for of in [Table::Paths, Table::Nodes] {
        document.set_vehicle_types(of, elements.rows(of), &types)?;
    }
    Ok(Touched::of(elements, document))
}

pub(super) const SET_LEVEL: StepKind = StepKind {
    name: "set-level",
    meaning: "Moves elements to a level, with the nodes and stations that only they use.",
    members: &[
        PATHS,
        NODES,
        STATIONS,
        required(
            "level",
            "text or null",
            "Name of the level; `null` takes them off all levels.",
        ),
    ],
    example: r#"{"do": "set-level", "paths": "all", "level": "mezzanine"}"#,
    perform: set_level,
};

fn set_level(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let elements = members.elements(document)?;
    let level = match members.get("level") {
        Some(serde_json::Value::Null) => None,
        _ => members.level("level", document)?,
    };
    document.set_level(&elements, level)?;
    Ok(Touched::of(elements, document))
}
