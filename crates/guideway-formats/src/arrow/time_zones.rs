//! Time zones: replaces the names of zones in a schema by the offset 0, so that the library can
//! write times as text, in UTC.

use std::str::FromStr;
use std::sync::Arc;

use arrow_array::timezone::Tz;
use arrow_schema::{DataType, Field, FieldRef, Fields, Schema};
use guideway_layout::{Code, Diagnostics, Place};

use crate::text::printable;

const UTC: &str = "+00:00";
/// Names of zones whose times are UTC all year.
const SAME_AS_UTC: [&str; 8] = [
    "UTC",
    "Etc/UTC",
    "Etc/GMT",
    "GMT",
    "Z",
    "Zulu",
    "Etc/Zulu",
    "Universal",
];

/// Returns a schema whose times have offsets for zones, and reports columns of other zones.
///
/// The library knows offsets only. A stored time counts from the epoch in UTC, whatever its zone.
pub(super) fn with_offsets(schema: &Schema, diagnostics: &mut Diagnostics) -> Schema {
    let fields = schema.fields().iter().map(|field| {
        let mut zones = Vec::new();
        let field = field_with_offsets(field, &mut zones);
        zones.retain(|zone| !SAME_AS_UTC.contains(&zone.as_str()));
        if let Some(zone) = zones.first() {
            diagnostics.push(
                Code::Attribute,
                || Place::element(format!("column {}", field.name())),
                || format!("the time zone {} is lost", printable(zone)),
                "Its times are kept in UTC; write local times as text to keep them",
            );
        }
        field
    });
    let fields: Fields = fields.collect();
    Schema::new_with_metadata(fields, schema.metadata().clone())
}

fn field_with_offsets(field: &FieldRef, zones: &mut Vec<String>) -> FieldRef {
    let before = zones.len();
    let data_type = type_with_offsets(field.data_type(), zones);
    match zones.len() > before {
        true => Arc::new(Field::clone(field).with_data_type(data_type)),
        false => Arc::clone(field),
    }
}

fn type_with_offsets(data_type: &DataType, zones: &mut Vec<String>) -> DataType {
    let mut item = |field: &FieldRef| field_with_offsets(field, zones);
    match data_type {
        DataType::Timestamp(unit, Some(zone)) if Tz::from_str(zone).is_err() => {
            zones.push(zone.to_string());
            DataType::Timestamp(*unit, Some(UTC.into()))
        }
        DataType::List(items) => DataType::List(item(items)),
        DataType::LargeList(items) => DataType::LargeList(item(items)),
        DataType::ListView(items) => DataType::ListView(item(items)),
        DataType::LargeListView(items) => DataType::LargeListView(item(items)),
        DataType::FixedSizeList(items, count) => DataType::FixedSizeList(item(items), *count),
        DataType::Map(entries, sorted) => DataType::Map(item(entries), *sorted),
        DataType::Struct(fields) => DataType::Struct(fields.iter().map(item).collect()),
        DataType::Union(fields, mode) => {
            let fields = fields.iter().map(|(id, field)| (id, item(field)));
            DataType::Union(fields.collect(), *mode)
        }
        DataType::RunEndEncoded(ends, values) => {
            DataType::RunEndEncoded(Arc::clone(ends), item(values))
        }
        DataType::Dictionary(keys, values) => {
            let values = type_with_offsets(values, zones);
            DataType::Dictionary(keys.clone(), Box::new(values))
        }
        other => other.clone(),
    }
}
