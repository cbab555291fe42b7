//! Renames elements. References are rows, so they follow.

use guideway_scene::{Table, TableEdit};

use super::error::OperationError;
use crate::PathSet;
use crate::document::Document;

impl Document {
    /// Renames an element. Paths, stations and blocks that refer to it follow.
    ///
    /// # Errors
    /// When the row does not exist, the name is empty, or another element of the table has it.
    pub fn rename(&mut self, of: Table, row: u32, id: &str) -> Result<(), OperationError> {
        self.rename_all(of, &[(row, id)])
    }

    /// Renames several elements in one step; two may swap their names.
    ///
    /// # Errors
    /// As [`Self::rename`].
    pub fn rename_all(&mut self, of: Table, ids: &[(u32, &str)]) -> Result<(), OperationError> {
        let ids = self.new_ids(of, ids)?;
        if ids.is_empty() {
            return Ok(());
        }
        let edit = TableEdit::SetIds {
            of,
            ids: ids.into(),
        };
        Ok(self.perform("rename", vec![edit.into()])?)
    }

    /// The identifiers that differ from the present ones.
    pub(super) fn new_ids(
        &self,
        of: Table,
        ids: &[(u32, &str)],
    ) -> Result<Vec<(u32, Box<str>)>, OperationError> {
        let rows: PathSet = ids.iter().map(|(row, _)| *row).collect();
        self.check_rows_exist(of, &rows)?;
        let layout = self.layout();
        let mut names = self.names(of);
        for row in &rows {
            names.release(of.id(layout, row));
        }
        for (_, id) in ids {
            names.exact(id)?;
        }
        let is_new = |(row, id): &&(u32, &str)| of.id(layout, *row) != *id;
        let ids = ids.iter().filter(is_new);
        Ok(ids.map(|&(row, id)| (row, id.into())).collect())
    }
}
