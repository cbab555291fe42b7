//! Previews: an edit that is shown while it is typed, and taken back before it counts.

use crate::document::Document;
use crate::history::Preview;

impl Document {
    /// Shows an edit in place of the one that was shown before. It is neither a step that can be
    /// undone nor part of the journal. Call [`Self::end_preview`] before any other edit.
    ///
    /// # Errors
    /// Those of the edit; the document is then as without a preview.
    pub fn preview_edit<E>(
        &mut self,
        edit: impl FnOnce(&mut Self) -> Result<(), E>,
    ) -> Result<(), E> {
        self.end_preview();
        let (history, entries) = (
            std::mem::take(&mut self.history),
            self.journal_entries.len(),
        );
        let rows = self.row_counts();
        let result = edit(self);
        let steps = std::mem::replace(&mut self.history, history).done;
        self.journal_entries.truncate(entries);
        self.preview = Some(Preview { steps, rows });
        if result.is_err() {
            self.end_preview();
        }
        result
    }

    /// Returns `true` if an edit is shown that does not count.
    pub fn is_preview(&self) -> bool {
        self.preview.is_some()
    }
}
