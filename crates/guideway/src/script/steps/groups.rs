//! Steps that create, change and delete levels and vehicle types.

use guideway_document::{Document, Elements, LevelContent, LevelFacts, TypeUse};
use guideway_layout::Attributes;
use serde_json::Value;

use super::values::Given;
use crate::script::error::StepError;
use crate::script::members::{Members, wrong};
use crate::script::step::{Member, StepKind, Touched, optional, required};

const LEVEL: Member = required("level", "text", "Identifier or name of the level.");
const TYPE: Member = required("vehicle_type", "text", "Name of the vehicle type.");
const NEW_ID: Member = optional("id", "text", "New name; what refers to it follows.");
const NAME: Member = optional(
    "name",
    "text or null",
    "Name for people; `null` removes it.",
);
const ELEVATION: Member = optional(
    "elevation",
    "number in m or null",
    "Height above the ground; `null` removes it.",
);
const PROPERTIES: Member = optional(
    "properties",
    "{NAME: value, ...}",
    "Properties with their values, in their units; `null` removes one.",
);

pub(super) const CREATE_LEVEL: StepKind = StepKind {
    name: "create-level",
    meaning: "Creates a level after the others.",
    members: &[
        optional("id", "text", "Identifier; without it, one is made."),
        NAME,
        ELEVATION,
        PROPERTIES,
    ],
    example: r#"{"do": "create-level", "id": "roof", "name": "Roof", "elevation": 9.5}"#,
    perform: create_level,
};

fn create_level(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let given = given(members, &Attributes::default())?;
    let level = document.create_level(&LevelFacts {
        id: members.optional_text("id")?,
        name: text_or_null(members, "name")?.flatten(),
        elevation_m: number_or_null(members, "elevation")?.flatten(),
        properties: &values(&given),
    })?;
    Ok(touched_level(document, level, Elements::default()))
}

pub(super) const CHANGE_LEVEL: StepKind = StepKind {
    name: "change-level",
    meaning: "Renames a level, and sets its height and its properties.",
    members: &[LEVEL, NEW_ID, NAME, ELEVATION, PROPERTIES],
    example: r#"{"do": "change-level", "level": "mezzanine", "id": "upper", "elevation": 4.5}"#,
    perform: change_level,
};

fn change_level(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let level = level(members, document)?;
    let before = document.layout().levels[level as usize].clone();
    let given = given(members, &before.attributes)?;
    let facts = LevelFacts {
        id: members.optional_text("id")?,
        name: text_or_null(members, "name")?.unwrap_or(before.name.as_deref()),
        elevation_m: number_or_null(members, "elevation")?.unwrap_or(before.elevation_m),
        properties: &values(&given),
    };
    document.change_level(level, &facts)?;
    let elements = document.elements_of_level(level);
    Ok(touched_level(document, level, elements))
}

pub(super) const DELETE_LEVEL: StepKind = StepKind {
    name: "delete-level",
    meaning: "Deletes a level. One with elements needs to know what becomes of them.",
    members: &[
        LEVEL,
        optional(
            "move_to",
            "text or null",
            "Level that its elements move to; `null` takes them off all levels.",
        ),
        optional(
            "with_elements",
            "true or false",
            "Deletes its elements too.",
        ),
    ],
    example: r#"{"do": "delete-level", "level": "mezzanine", "move_to": "hall"}"#,
    perform: delete_level,
};

fn delete_level(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let level = level(members, document)?;
    let content = match (members.get("move_to"), members.flag("with_elements")?) {
        (None, false) => LevelContent::Keep,
        (None, true) => LevelContent::Delete,
        (Some(Value::Null), false) => LevelContent::MoveTo(None),
        (Some(_), false) => LevelContent::MoveTo(members.level("move_to", document)?),
        (Some(_), true) => return Err(both("move_to", "with_elements")),
    };
    let elements = document.elements_of_level(level);
    let id = document.layout().levels[level as usize].id.clone();
    document.delete_level(level, content)?;
    Ok(Touched::group(&id, elements))
}

pub(super) const CREATE_TYPE: StepKind = StepKind {
    name: "create-vehicle-type",
    meaning: "Creates a vehicle type, which no path names yet.",
    members: &[
        required("id", "text", "Name, which no other vehicle type has."),
        PROPERTIES,
    ],
    example: r#"{"do": "create-vehicle-type", "id": "crane", "properties": {"maxSpeed": 0.5}}"#,
    perform: create_type,
};

fn create_type(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let name = members.text("id")?;
    let given = given(members, &Attributes::default())?;
    document.create_vehicle_type(name, &values(&given))?;
    Ok(Touched::group(name, Elements::default()))
}

pub(super) const CHANGE_TYPE: StepKind = StepKind {
    name: "change-vehicle-type",
    meaning: "Renames a vehicle type, and sets the properties that it has everywhere.",
    members: &[TYPE, NEW_ID, PROPERTIES],
    example: r#"{"do": "change-vehicle-type", "vehicle_type": "tugger-3000", "id": "tugger"}"#,
    perform: change_type,
};

fn change_type(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let old = members.text("vehicle_type")?;
    let new = members.optional_text("id")?.unwrap_or(old);
    let mut types = document.layout().vehicle_types.iter();
    let row = types.find(|t| t.id == old).cloned().unwrap_or_default();
    let given = given(members, &row.attributes)?;
    document.change_vehicle_type(old, new, &values(&given))?;
    Ok(Touched::group(new, Elements::default()))
}

pub(super) const DELETE_TYPE: StepKind = StepKind {
    name: "delete-vehicle-type",
    meaning: "Deletes a vehicle type. One in use needs to know what becomes of its paths.",
    members: &[
        TYPE,
        optional(
            "replace_by",
            "text",
            "Vehicle type that its paths and nodes get instead.",
        ),
        optional(
            "remove",
            "true or false",
            "Takes the type off its paths and nodes; each path needs another type.",
        ),
    ],
    example: r#"{"do": "delete-vehicle-type", "vehicle_type": "tugger-3000",
 "replace_by": "stacker-1200"}"#,
    perform: delete_type,
};

fn delete_type(members: &Members<'_>, document: &mut Document) -> Result<Touched, StepError> {
    let name = members.text("vehicle_type")?;
    let other = members.optional_text("replace_by")?;
    let uses = match (other, members.flag("remove")?) {
        (None, false) => TypeUse::Keep,
        (None, true) => TypeUse::Remove,
        (Some(other), false) => TypeUse::Replace(other),
        (Some(_), true) => return Err(both("replace_by", "remove")),
    };
    document.delete_vehicle_type(name, uses)?;
    Ok(Touched::group(name, Elements::default()))
}

fn touched_level(document: &Document, level: u32, elements: Elements) -> Touched {
    Touched::group(&document.layout().levels[level as usize].id, elements)
}

fn level(members: &Members<'_>, document: &Document) -> Result<u32, StepError> {
    members.text("level")?;
    let level = members.level("level", document)?;
    level.ok_or_else(|| StepError::of_member("level", "is missing", "Name a level"))
}

fn both(one: &'static str, other: &str) -> StepError {
    let what = format!("`{one}` and `{other}` exclude each other");
    StepError::of_member(one, what, "Write one of them")
}

/// A member that may be `null`; `None` if it is absent.
fn text_or_null<'a>(
    members: &Members<'a>,
    name: &'static str,
) -> Result<Option<Option<&'a str>>, StepError> {
    match members.get(name) {
        Some(Value::Null) => Ok(Some(None)),
        _ => Ok(members.optional_text(name)?.map(Some)),
    }
}

fn number_or_null(
    members: &Members<'_>,
    name: &'static str,
) -> Result<Option<Option<f64>>, StepError> {
    match members.get(name) {
        Some(Value::Null) => Ok(Some(None)),
        _ => Ok(members.optional_number(name)?.map(Some)),
    }
}

/// The values of the member `properties`, in the units of the columns that are there.
fn given<'a>(
    members: &Members<'a>,
    attributes: &Attributes,
) -> Result<Vec<(&'a str, Given)>, StepError> {
    let properties = match members.get("properties") {
        None => return Ok(Vec::new()),
        Some(Value::Object(properties)) => properties,
        Some(other) => return Err(wrong("properties", "an object of values", other)),
    };
    let given = |(name, json): (&'a String, &Value)| {
        let value = Given::of_row(json, name, attributes);
        (name.as_str(), value)
    };
    Ok(properties.iter().map(given).collect())
}

fn values<'a>(given: &'a [(&'a str, Given)]) -> Vec<(&'a str, Option<guideway_layout::Value<'a>>)> {
    given
        .iter()
        .map(|(name, value)| (*name, value.value()))
        .collect()
}
