//! Nav2 values: decides how a value of a column is written in a route graph.

use guideway_layout::Value;
use serde_json::Value as Json;

use super::names;
use crate::fields::{Vocabulary, field_of};

/// An element of a route graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Node,
    Edge,
}

/// Place of a value in a feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Placement<'v> {
    /// A property that the route server knows, under the name of the column.
    Property(Value<'v>),
    /// A key of the metadata.
    Metadata(&'v str, Value<'v>),
}

/// Returns the place of a value; `None` for one that a route graph does not hold.
pub(super) fn placement<'v>(
    kind: Kind,
    column: &'v str,
    value: Value<'v>,
) -> Option<Placement<'v>> {
    let is_property = match (column, value) {
        // The names would stand for something else.
        ("id" | "metadata" | names::ORIGINAL_ID, _) => return None,
        ("startid" | "endid", _) if kind == Kind::Edge => return None,
        // The route server refuses a graph with a null in it.
        (_, Value::Float(number)) if !number.is_finite() => return None,
        ("frame", Value::Text(_)) => kind == Kind::Node,
        ("cost", Value::Int(_) | Value::Float(_)) => kind == Kind::Edge,
        ("overridable", Value::Bool(_)) => kind == Kind::Edge,
        ("operations", Value::Json(json)) => are_operations(json),
        _ => false,
    };
    if is_property {
        return Some(Placement::Property(value));
    }
    let field = field_of(Vocabulary::Nav2, column).filter(|_| kind == Kind::Edge);
    Some(match field.zip(value.number()) {
        // The route server reads a number without a fraction as another type.
        Some((field, number)) => {
            Placement::Metadata(field.name, Value::Float(number / field.factor))
        }
        None => Placement::Metadata(column, value),
    })
}

/// Returns whether the route server can load a JSON text as metadata: no null, and no lists of
/// anything but plain values.
pub(super) fn is_metadata(json: &str) -> bool {
    fn is_plain(json: &Json) -> bool {
        !matches!(json, Json::Null | Json::Array(_) | Json::Object(_))
    }
    fn is_loaded(json: &Json) -> bool {
        match json {
            Json::Array(items) => items.iter().all(is_plain),
            Json::Object(fields) => fields.values().all(is_loaded),
            plain => is_plain(plain),
        }
    }
    serde_json::from_str(json).is_ok_and(|json| is_loaded(&json))
}

/// Returns whether the route server can load a JSON text as operations: each has a type and a
/// trigger.
fn are_operations(json: &str) -> bool {
    let is_operation = |json: &Json| {
        let has_text = |key| json.get(key).is_some_and(Json::is_string);
        has_text("type") && has_text("trigger")
    };
    match serde_json::from_str(json) {
        Ok(Json::Array(items)) => items.iter().all(is_operation),
        Ok(Json::Object(fields)) => fields.values().all(is_operation),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metadata_are_plain_values_lists_of_them_and_objects() {
        for json in ["3", r#""a""#, "[1, true]", r#"{"a": {"b": [1.5]}}"#, "[]"] {
            assert!(is_metadata(json), "{json}");
        }
        for json in [
            "null",
            "[null]",
            "[[1]]",
            r#"[{"a": 1}]"#,
            r#"{"a": null}"#,
            "{",
        ] {
            assert!(!is_metadata(json), "{json}");
        }
    }

    #[test]
    fn known_properties_keep_their_place() {
        let operations = r#"{"stop": {"type": "stop", "trigger": "NODE"}}"#;
        for (kind, name, value) in [
            (Kind::Node, "frame", Value::Text("map")),
            (Kind::Edge, "cost", Value::Float(2.5)),
            (Kind::Edge, "overridable", Value::Bool(false)),
            (Kind::Node, "operations", Value::Json(operations)),
        ] {
            assert_eq!(
                placement(kind, name, value),
                Some(Placement::Property(value))
            );
        }
        let metadata = |name, value| Some(Placement::Metadata(name, value));
        let text = Value::Text("fast");
        assert_eq!(placement(Kind::Edge, "cost", text), metadata("cost", text));
        let bad = Value::Json("[1]");
        assert_eq!(
            placement(Kind::Edge, "operations", bad),
            metadata("operations", bad)
        );
        let speed = placement(Kind::Edge, "maxSpeed", Value::Int(1));
        assert_eq!(speed, metadata("abs_speed_limit", Value::Float(1.0)));
        let nan = Value::Float(f64::NAN);
        assert_eq!(placement(Kind::Edge, "cost", nan), None);
        assert_eq!(placement(Kind::Edge, "startid", Value::Int(1)), None);
    }
}
