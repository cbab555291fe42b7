//! Values of properties in a script: degrees become radians, lists become JSON texts.

use guideway_document::Document;
use guideway_layout::{Attributes, Property, Quantity, Value};
use guideway_scene::Table;
use serde_json::Value as Json;

/// A value that owns its text.
pub(super) enum Given {
    Removed,
    Flag(bool),
    Whole(i64),
    Number(f64),
    Text(String),
    Json(String),
}

impl Given {
    /// The value of a member, in the unit of the property.
    pub(super) fn of(json: &Json, of: Table, property: &str, document: &Document) -> Self {
        let columns = of.attributes(document.layout());
        let entries = of
            .entries(document.layout())
            .map(|entries| &entries.attributes);
        let column = columns.get(property).or_else(|| entries?.get(property));
        let own = column.and_then(|column| column.quantity);
        let quantity = own.or_else(|| Property::named(property)?.quantity());
        Self::in_unit(json, quantity)
    }

    /// The value of a property in a table of one row, such as that of a level.
    pub(super) fn of_row(json: &Json, property: &str, attributes: &Attributes) -> Self {
        let own = attributes.get(property).and_then(|column| column.quantity);
        let quantity = own.or_else(|| Property::named(property)?.quantity());
        Self::in_unit(json, quantity)
    }

    fn in_unit(json: &Json, quantity: Option<Quantity>) -> Self {
        let is_angle = matches!(quantity, Some(Quantity::Angle | Quantity::RotationSpeed));
        match json {
            Json::Null => Self::Removed,
            Json::Bool(flag) => Self::Flag(*flag),
            Json::Number(number) => match (number.as_i64(), number.as_f64()) {
                (_, Some(degrees)) if is_angle => Self::Number(degrees.to_radians()),
                (Some(whole), _) => Self::Whole(whole),
                (None, number) => Self::Number(number.unwrap_or(f64::NAN)),
            },
            Json::String(text) => Self::Text(text.clone()),
            Json::Array(_) | Json::Object(_) => Self::Json(json.to_string()),
        }
    }

    /// The value; `None` removes the old one.
    pub(super) fn value(&self) -> Option<Value<'_>> {
        match self {
            Self::Removed => None,
            Self::Flag(flag) => Some(Value::Bool(*flag)),
            Self::Whole(whole) => Some(Value::Int(*whole)),
            Self::Number(number) => Some(Value::Float(*number)),
            Self::Text(text) => Some(Value::Text(text)),
            Self::Json(text) => Some(Value::Json(text)),
        }
    }
}
