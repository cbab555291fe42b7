//! Maps the parameters of vertices and lanes to attribute columns.

use guideway_layout::{Code, Value};

use super::reader::SiteReader;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::YamlNode;

/// Parameters that become columns of all tables; bounds the number of columns of a hostile file.
const MAX_COLUMNS: usize = 64;

/// Stores every parameter with a value as an attribute of a row.
///
/// # Errors
/// When a text exceeds its limit.
pub(super) fn set_parameters<'y>(
    reader: &mut SiteReader<'_, 'y>,
    table: Table,
    row: usize,
    parameters: YamlNode<'y>,
    at: PlaceFn<'_>,
) -> Result<(), ReadError> {
    for (key, node) in parameters.entries() {
        let value = match parameter(node) {
            // The editor writes an empty text for a parameter without a value.
            Some(Value::Text("")) => continue,
            None if node.kind() == "nothing" => continue,
            None => {
                reader.report_type(at, &format!("a type and a value of `{key}`"), node);
                continue;
            }
            Some(value) => value,
        };
        let column = (matches!(table, Table::Paths), key);
        if !reader.columns.contains(&column) {
            if reader.columns.len() == MAX_COLUMNS {
                let message = || format!("more than {MAX_COLUMNS} different parameters");
                let remedy = "The others are left out";
                reader.builder.report(Code::Attribute, at, message, remedy);
                continue;
            }
            reader.builder.check_text(key)?;
            reader.columns.insert(column);
        }
        if let Value::Text(text) = value {
            reader.builder.check_text(text)?;
        }
        reader.builder.set(table, row, key, value)?;
    }
    Ok(())
}

/// The value of a parameter: `[type, value]` in a building, where type 1 is text, or the bare value
/// in a navigation graph.
pub(super) fn parameter(node: YamlNode<'_>) -> Option<Value<'_>> {
    let Some(kind) = node.item(0) else {
        return node.value();
    };
    let value = node.item(1)?;
    match kind.text() {
        Some("1") => value.text().map(Value::Text),
        _ => value.value(),
    }
}
