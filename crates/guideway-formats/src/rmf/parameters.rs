//! Maps the parameters of vertices, lanes and lifts to attribute columns.

use guideway_layout::{Code, Value};

use super::reader::SiteReader;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::fields::{Vocabulary, field};
use crate::yaml::YamlNode;

/// Parameters of a table that become columns; bounds the number of columns of a hostile file.
const MAX_COLUMNS: usize = 64;

/// Column of one object with all parameters beyond the limit.
const OTHER: &str = "other";

/// Stores parameters with a value as attributes of a row, except those that the layout holds
/// elsewhere.
///
/// # Errors
/// When a text exceeds its limit.
pub(super) fn set_parameters<'y>(
    reader: &mut SiteReader<'_, 'y>,
    (table, row): (Table, usize),
    parameters: YamlNode<'y>,
    is_elsewhere: impl Fn(&str) -> bool,
    at: PlaceFn<'_>,
) -> Result<(), ReadError> {
    let names = match table {
        Table::Paths => 0,
        Table::Nodes => 1,
        _ => 2,
    };
    let mut other = Vec::new();
    let mut is_over_limit = false;
    for (key, node) in parameters.entries().filter(|(key, _)| !is_elsewhere(key)) {
        let value = parameter(node, reader.is_graph);
        let is_empty = value.is_none() && node.kind() == "nothing";
        // The editor writes an empty text for a parameter without a value.
        if is_empty || value == Some(Value::Text("")) {
            continue;
        }
        if !reader.columns[names].contains(key) {
            // An object of others, as this reader makes it.
            if key == OTHER && node.is_object() {
                other.extend(node.entries());
                continue;
            }
            if reader.columns[names].len() == MAX_COLUMNS || key == OTHER {
                is_over_limit = true;
                other.push((key, node));
                continue;
            }
            reader.builder.check_text(key)?;
            reader.columns[names].insert(key);
        }
        match value {
            Some(value) => set_parameter(reader, (table, row), key, value, at)?,
            None => {
                if !reader.is_graph {
                    let message = || format!("`{key}` is {}, not a type and a value", node.kind());
                    let remedy = "It is kept as it is; correct it";
                    reader.builder.report(Code::WrongType, at, message, remedy);
                }
                set_json(reader, (table, row), key, node, at)?;
            }
        }
    }
    set_other(reader, (table, row), &other, is_over_limit, at)
}

/// Sets the column of a parameter, in SI units where it is a known property.
fn set_parameter(
    reader: &mut SiteReader<'_, '_>,
    (table, row): (Table, usize),
    key: &str,
    value: Value<'_>,
    at: PlaceFn<'_>,
) -> Result<(), ReadError> {
    if let Value::Text(text) = value {
        reader.builder.check_text(text)?;
    }
    let known = field(Vocabulary::Rmf, key).filter(|_| matches!(table, Table::Paths));
    let Some(field) = known else {
        return reader.builder.set(table, row, key, value);
    };
    if value.number().is_some_and(|number| number > 0.0) {
        return reader.builder.set_field(table, row, field, value);
    }
    // Zero is the editor's word for no limit.
    if value.number() == Some(0.0) {
        return Ok(());
    }
    let message = || format!("`{key}` is {value}, which is no limit");
    let remedy = "It is kept as it is, and no limit applies; correct it";
    reader
        .builder
        .report(Code::Implausible, at, message, remedy);
    reader.builder.set(table, row, key, value)
}

/// Sets a column to a list or an object.
pub(super) fn set_json(
    reader: &mut SiteReader<'_, '_>,
    (table, row): (Table, usize),
    key: &str,
    node: YamlNode<'_>,
    at: PlaceFn<'_>,
) -> Result<(), ReadError> {
    match json(reader, key, node, at) {
        Some(json) => reader.builder.set(table, row, key, Value::Json(&json)),
        None => Ok(()),
    }
}

/// Returns a value as JSON; reports one that is too long for a text.
pub(super) fn json(
    reader: &mut SiteReader<'_, '_>,
    key: &str,
    node: YamlNode<'_>,
    at: PlaceFn<'_>,
) -> Option<String> {
    let max_bytes = reader.builder.source.options.limits.text_bytes;
    let json = node.to_json(max_bytes);
    if json.is_none() {
        let message = || format!("`{key}` takes more than {max_bytes} bytes, or is nested deeply");
        let remedy = "It is left out; shorten it";
        reader.builder.report(Code::Attribute, at, message, remedy);
    }
    json
}

/// Sets the column of the parameters beyond the limit.
fn set_other(
    reader: &mut SiteReader<'_, '_>,
    (table, row): (Table, usize),
    other: &[(&str, YamlNode<'_>)],
    is_over_limit: bool,
    at: PlaceFn<'_>,
) -> Result<(), ReadError> {
    if other.is_empty() {
        return Ok(());
    }
    let max_bytes = reader.builder.source.options.limits.text_bytes;
    let mut object = String::from("{");
    for (key, node) in other {
        let Some(value) = node
            .to_json(max_bytes)
            .filter(|_| object.len() <= max_bytes)
        else {
            break;
        };
        let separator = if object.len() > 1 { "," } else { "" };
        object += &format!("{separator}{}:{value}", serde_json::Value::from(*key));
    }
    object.push('}');
    let message = || format!("more than {MAX_COLUMNS} different parameters");
    if object.len() > max_bytes {
        let remedy = "The others are left out, because they are too long for a text";
        reader.builder.report(Code::Attribute, at, message, remedy);
        return Ok(());
    }
    if is_over_limit {
        let remedy = "The others are in the column `other`";
        reader.builder.report(Code::Attribute, at, message, remedy);
    }
    reader.builder.set(table, row, OTHER, Value::Json(&object))
}

/// The value of a parameter: `[type, value]` in a building, where type 1 is text and type 3 a
/// number, or the bare value in a navigation graph. `None` for nothing, a list or an object.
pub(super) fn parameter(node: YamlNode<'_>, is_graph: bool) -> Option<Value<'_>> {
    let kind = node.item(0).filter(|_| !is_graph);
    let Some(kind) = kind else {
        return node.value();
    };
    let value = node.item(1)?;
    match (kind.text(), value.value()) {
        (Some("1"), _) => value.text().map(Value::Text),
        (Some("3"), Some(Value::Int(whole))) => Some(Value::Float(whole as f64)),
        (_, value) => value,
    }
}
