//! The parameters of vertices and lanes, which become columns.

use guideway_layout::{Code, Value};

use super::site::Site;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::yaml::Item;

/// Most parameters that become columns of a table; a file could else make columns without end.
const MOST_COLUMNS: usize = 64;

impl<'y> Site<'_, 'y> {
    /// Sets a column for each parameter that has a value.
    pub(super) fn set_parameters(
        &mut self,
        table: Table,
        row: usize,
        parameters: Item<'y>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        for (key, item) in parameters.entries() {
            let value = match parameter(item) {
                // What was never filled in.
                Some(Value::Text("")) => continue,
                None if item.kind() == "nothing" => continue,
                None => {
                    self.report_type(at, &format!("a type and a value of `{key}`"), item);
                    continue;
                }
                Some(value) => value,
            };
            let column = (matches!(table, Table::Paths), key);
            if !self.columns.contains(&column) {
                if self.columns.len() == MOST_COLUMNS {
                    let message = || format!("more than {MOST_COLUMNS} different parameters");
                    self.builder
                        .report(Code::Attribute, at, message, "The others are left out");
                    continue;
                }
                self.builder.check_text(key)?;
                self.columns.insert(column);
            }
            if let Value::Text(text) = value {
                self.builder.check_text(text)?;
            }
            self.builder.set(table, row, key, value)?;
        }
        Ok(())
    }
}

/// The value of a parameter: [type, value] in a building, with 1 for text; the value alone in a graph.
pub(super) fn parameter(item: Item<'_>) -> Option<Value<'_>> {
    let Some(kind) = item.item(0) else {
        return item.value();
    };
    let value = item.item(1)?;
    match kind.text() {
        Some("1") => value.text().map(Value::Text),
        _ => value.value(),
    }
}
