//! Moves elements to a level.

use std::sync::Arc;

use guideway_scene::{Table, TableEdit};

use super::error::OperationError;
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

impl Document {
    /// Moves elements to a level; `None` takes them off all levels. The nodes whose paths all move
    /// go along, and the stations whose nodes all move.
    ///
    /// # Errors
    /// When an element or the level does not exist.
    pub fn set_level(
        &mut self,
        elements: &Elements,
        level: Option<u32>,
    ) -> Result<(), OperationError> {
        self.check_exist(elements)?;
        let nodes = &self.nodes_of_only(&elements.paths) | &elements.nodes;
        let stations = &self.stations_of_only(&nodes) | &elements.stations;
        let tables = [
            (Table::Paths, &elements.paths),
            (Table::Nodes, &nodes),
            (Table::Stations, &stations),
        ];
        let mut changes: Vec<Change> = Vec::new();
        for (of, rows) in tables {
            let levels: Arc<[_]> = rows.iter().map(|row| (row, level)).collect();
            if !levels.is_empty() {
                changes.push(TableEdit::SetLevels { of, levels }.into());
            }
        }
        Ok(self.perform("set level", changes)?)
    }
}
