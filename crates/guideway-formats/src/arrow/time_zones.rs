//! Time zones: reports the zones whose times are kept in UTC.

use std::str::FromStr;

use arrow_array::timezone::Tz;
use arrow_schema::{DataType, Schema};
use guideway_layout::{Code, Diagnostics, Place};

use crate::text::printable;

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

/// Reports the columns of times with the name of a zone. The Arrow library knows offsets only, and
/// a stored time counts from the epoch in UTC, whatever its zone.
pub(super) fn report_lost_zones(schema: &Schema, diagnostics: &mut Diagnostics) {
    for field in schema.fields() {
        if let Some(zone) = lost_zone(field.data_type()) {
            diagnostics.push(
                Code::Attribute,
                || Place::element(format!("column {}", field.name())),
                || format!("the time zone {} is lost", printable(zone)),
                "Its times are kept in UTC; write local times as text to keep them",
            );
        }
    }
}

/// Returns the first zone within a type that is neither an offset nor UTC.
fn lost_zone(data_type: &DataType) -> Option<&str> {
    match data_type {
        DataType::Timestamp(_, Some(zone)) => {
            let is_kept = Tz::from_str(zone).is_ok() || SAME_AS_UTC.contains(&zone.as_ref());
            (!is_kept).then_some(zone)
        }
        DataType::List(item)
        | DataType::LargeList(item)
        | DataType::ListView(item)
        | DataType::LargeListView(item)
        | DataType::FixedSizeList(item, _)
        | DataType::Map(item, _)
        | DataType::RunEndEncoded(_, item) => lost_zone(item.data_type()),
        DataType::Struct(fields) => fields.iter().find_map(|f| lost_zone(f.data_type())),
        DataType::Union(fields, _) => fields.iter().find_map(|(_, f)| lost_zone(f.data_type())),
        DataType::Dictionary(_, values) => lost_zone(values),
        _ => None,
    }
}
