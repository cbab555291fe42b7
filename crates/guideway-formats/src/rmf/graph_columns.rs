//! Columns of navigation graphs: decides how values are written as parameters of lanes and
//! vertices.

use guideway_layout::{Layout, Value};

use super::yaml_text::value;
use crate::fields::{Vocabulary, field, field_of};

/// Returns name and text of the parameter of a lane for a value; `None` for a value that a lane
/// does not hold.
pub(super) fn path_column<'l>(column: &'l str, of_path: Value<'_>) -> Option<(&'l str, String)> {
    match (column, of_path) {
        // The names would stand for something else.
        ("id" | "bidirectional" | "is_bidirectional" | "graph_idx" | "mutex", _) => None,
        // The fleet adapter refuses any other constraint.
        ("orientation_constraint", Value::Text("forward" | "backward")) => {
            parameter(column, of_path)
        }
        ("orientation_constraint", _) => None,
        _ => match (field_of(Vocabulary::Rmf, column), of_path.number()) {
            // Zero would mean no limit.
            (Some(field), Some(number)) if number > 0.0 && number.is_finite() => {
                parameter(field.name, Value::Float(number / field.factor))
            }
            (Some(_), _) => None,
            // A reader would take it for the property of this name.
            (None, _) if field(Vocabulary::Rmf, column).is_some() => None,
            (None, _) => parameter(column, of_path),
        },
    }
}

/// Returns name and text of the parameter of a vertex for a value; `None` for a value that a vertex
/// does not hold.
pub(super) fn node_column<'l>(column: &'l str, of_node: Value<'_>) -> Option<(&'l str, String)> {
    match column {
        "name" | "mutex" => None,
        column => parameter(column, of_node),
    }
}

/// Returns name and text of a parameter. An empty text stands for no value.
pub(super) fn parameter<'l>(name: &'l str, of_row: Value<'_>) -> Option<(&'l str, String)> {
    let text = value(of_row).filter(|_| of_row != Value::Text(""))?;
    Some((name, text))
}

/// Number of the graph, if a path is for the vehicles of one graph.
pub(super) fn graph_of(layout: &Layout, path: usize) -> Option<&str> {
    let mut types = layout.paths.vehicle_types().of(path);
    let graph = types.next()?.strip_prefix("graph ")?;
    let is_number = graph
        .parse::<i64>()
        .is_ok_and(|number| number.to_string() == graph);
    (is_number && types.next().is_none()).then_some(graph)
}

/// Returns whether a column of a lift is written by its own key.
pub(super) fn is_of_lift(name: &str) -> bool {
    matches!(
        name,
        "kind" | "theta" | "width" | "depth" | "position" | "dims"
    )
}
