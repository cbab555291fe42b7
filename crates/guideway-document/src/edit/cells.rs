//! Sets many cells of a table in one step, as a spreadsheet does.

use guideway_layout::Value;
use guideway_scene::{Table, TableEdit};

use super::error::OperationError;
use super::properties::PropertyRef;
use crate::PathSet;
use crate::document::Document;

/// New values of some cells of a table.
#[derive(Clone, Copy, Debug)]
pub struct NewCells<'a> {
    /// The table.
    pub of: Table,
    /// New identifiers, by row.
    pub ids: &'a [(u32, &'a str)],
    /// Property, row and value for all vehicle types; `None` removes a value.
    pub values: &'a [(&'a str, u32, Option<Value<'a>>)],
}

impl Document {
    /// Sets cells of a table in one step.
    ///
    /// # Errors
    /// As [`Self::rename_all`] and [`Self::set_property`]; the document is unchanged.
    pub fn set_cells(&mut self, cells: &NewCells<'_>) -> Result<(), OperationError> {
        let mut changes = Vec::new();
        for group in cells.values.chunk_by(|a, b| (a.0, a.2) == (b.0, b.2)) {
            let Some(&(name, _, value)) = group.first() else {
                continue;
            };
            let rows: PathSet = group.iter().map(|(_, row, _)| *row).collect();
            let property = PropertyRef {
                of: cells.of,
                name,
                vehicle_type: None,
            };
            changes.extend(self.property_changes(property, &rows, value)?);
        }
        let ids = self.new_ids(cells.of, cells.ids)?;
        if !ids.is_empty() {
            let (of, ids) = (cells.of, ids.into());
            changes.push(TableEdit::SetIds { of, ids }.into());
        }
        Ok(self.perform("set cells", changes)?)
    }
}
