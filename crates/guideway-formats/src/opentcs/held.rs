//! Tells which values of columns the elements and XML attributes of a plant model hold.

use guideway_layout::{Layout, Value};
use serde_json::{Map, Value as Json};

use super::drawn_paths::DrawnPaths;
use super::elements::{BLOCK_TYPES, BOUNDING_BOX, Kind, PERIPHERAL_OPERATION, REPRESENTATIONS};
use super::envelope::{AREA_COLUMN, KEY_COLUMN};
use super::group_mapper::{LOCATION_TYPES, VEHICLES};
use super::path_mapper::{CONNECTION_TYPE, PERIPHERAL_OPERATIONS, REVERSED};
use super::plant_mapper::{
    BOX_COLUMN, DEFAULT_POINT_TYPE, DEFAULT_REPRESENTATION, LABEL_OFFSET, LINK_OPERATIONS,
    REPRESENTATION,
};
use super::values::{is_two_way, json, number, speed_mm_s};
use super::version::Version;
use super::visual_layout::DEFAULT_LAYER;

/// The form in which the elements and XML attributes of a file hold a value of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Held {
    Written,
    /// Readers take the value as implied, and have no value.
    Default,
    Not,
}

impl Held {
    /// [`Self::Written`] if a condition holds.
    pub(super) fn when(is_written: bool) -> Self {
        match is_written {
            true => Self::Written,
            false => Self::Not,
        }
    }
}

/// Uses of a point.
pub(super) const POINT_TYPES: &[&str] = &[DEFAULT_POINT_TYPE, "PARK_POSITION"];

fn is_number(value: Value<'_>) -> bool {
    number(Some(value)).is_some()
}

/// The one of several texts that a value is.
fn choice(value: Value<'_>, texts: &[&str], default: &str) -> Held {
    match value {
        Value::Text(text) if text == default => Held::Default,
        Value::Text(text) => Held::when(texts.contains(&text)),
        _ => Held::Not,
    }
}

fn flag(value: Value<'_>) -> Held {
    match value {
        Value::Bool(true) => Held::Written,
        Value::Bool(false) => Held::Default,
        _ => Held::Not,
    }
}

fn layer(value: Value<'_>) -> Held {
    match value {
        Value::Text(DEFAULT_LAYER) => Held::Default,
        value => Held::when(matches!(value, Value::Text(_))),
    }
}

/// Rings of a MultiPolygon without holes.
pub(super) type Areas = Vec<[Vec<[f64; 2]>; 1]>;

fn envelope(name: &str, value: Value<'_>) -> Held {
    Held::when(match name {
        KEY_COLUMN => json::<Vec<String>>(Some(value)).is_some(),
        _ => json::<Areas>(Some(value)).is_some_and(|areas| {
            let is_ring = |ring: &Vec<[f64; 2]>| ring.len() >= 4 && ring.first() == ring.last();
            areas.iter().all(|[ring]| is_ring(ring))
        }),
    })
}

/// Tells if the attributes of a path are written: `drawn` has its connection type.
pub(super) fn held_by_path(
    layout: &Layout,
    drawn: &DrawnPaths,
    row: usize,
    name: &str,
    value: Value<'_>,
) -> Held {
    let Some(path) = drawn.get(row) else {
        return Held::Not;
    };
    let speed = || speed_mm_s(layout.paths.value(row, "maxSpeed"));
    match name {
        "maxSpeed" => Held::when(speed_mm_s(Some(value)).is_some()),
        "maxReverseSpeed" => match speed_mm_s(Some(value)) {
            Some(reverse) if reverse > 0 && is_two_way(layout, row) => {
                match speed() == Some(reverse) {
                    true => Held::Default,
                    false => Held::Written,
                }
            }
            _ => Held::Not,
        },
        "length" => Held::when(number(Some(value)).is_some_and(|length| length >= 0.0)),
        "locked" => flag(value),
        REVERSED => match flag(value) {
            Held::Written => Held::when(path.is_reversed),
            other => other,
        },
        CONNECTION_TYPE => match value {
            Value::Text(text) if text == path.shape.connection.name() => match path.is_stated {
                true => Held::Written,
                false => Held::Default,
            },
            _ => Held::Not,
        },
        PERIPHERAL_OPERATIONS => {
            let operations = json::<Vec<Map<String, Json>>>(Some(value));
            let are_whole = |all: Vec<_>| all.iter().all(|o| PERIPHERAL_OPERATION.is_whole(o));
            Held::when(operations.is_some_and(are_whole))
        }
        "layer" => layer(value),
        KEY_COLUMN | AREA_COLUMN => envelope(name, value),
        _ => Held::Not,
    }
}

/// The offset of a label along an axis.
fn label_offset(axis: usize, value: Value<'_>) -> Held {
    match value {
        Value::Int(offset) if offset == LABEL_OFFSET[axis] => Held::Default,
        value => Held::when(matches!(value, Value::Int(_))),
    }
}

/// Tells if the attributes that points and locations have in common are written.
fn held_by_place(version: Version, name: &str, value: Value<'_>) -> Held {
    match name {
        "positionX" | "positionY" => Held::when(version == Version::V6 && is_number(value)),
        "positionZ" => match number(Some(value)) {
            Some(0.0) => Held::Default,
            z => Held::when(z.is_some()),
        },
        "labelOffsetX" => label_offset(0, value),
        "labelOffsetY" => label_offset(1, value),
        "layer" => layer(value),
        _ => Held::Not,
    }
}

/// Tells if the attributes of a node are written.
pub(super) fn held_by_node(version: Version, name: &str, value: Value<'_>) -> Held {
    match name {
        "type" => choice(value, POINT_TYPES, DEFAULT_POINT_TYPE),
        "theta" => Held::when(is_number(value)),
        BOX_COLUMN => {
            let extents = json::<Map<String, Json>>(Some(value));
            Held::when(extents.is_some_and(|extents| BOUNDING_BOX.is_whole(&extents)))
        }
        KEY_COLUMN | AREA_COLUMN => envelope(name, value),
        _ => held_by_place(version, name, value),
    }
}

/// Tells if the attributes of a station are written.
pub(super) fn held_by_station(version: Version, name: &str, value: Value<'_>) -> Held {
    match name {
        "kind" => Held::when(matches!(value, Value::Text(_))),
        "locked" => flag(value),
        LINK_OPERATIONS => Held::when(json::<Vec<Vec<String>>>(Some(value)).is_some()),
        REPRESENTATION => choice(value, REPRESENTATIONS, DEFAULT_REPRESENTATION),
        _ => held_by_place(version, name, value),
    }
}

/// Tells if the attributes of a block are written.
pub(super) fn held_by_block(_: usize, name: &str, value: Value<'_>) -> Held {
    let Value::Text(text) = value else {
        return Held::Not;
    };
    match name {
        "type" => Held::when(BLOCK_TYPES.contains(&text)),
        "color" => Held::when(Kind::Color.text(&text.into()).as_deref() == Some(text)),
        _ => Held::Not,
    }
}

/// Tells if the attributes of a layout are written.
pub(super) fn held_by_layout(_: usize, name: &str, value: Value<'_>) -> Held {
    match name {
        "name" => Held::when(matches!(value, Value::Text(_))),
        VEHICLES | LOCATION_TYPES | "layers" | "layerGroups" => {
            Held::when(json::<Vec<Map<String, Json>>>(Some(value)).is_some())
        }
        "visualLayout" => Held::when(json::<Map<String, Json>>(Some(value)).is_some()),
        _ => Held::Not,
    }
}
