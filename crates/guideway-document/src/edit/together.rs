//! Several edits as one undoable step.

use crate::document::Document;
use crate::history::Step;
use crate::journal::JournalEntry;

impl Document {
    /// Performs several edits as one undoable step, or none of them.
    pub(super) fn together<E>(
        &mut self,
        name: &'static str,
        edit: impl FnOnce(&mut Self) -> Result<(), E>,
    ) -> Result<(), E> {
        let (first, entries) = (self.history.done.len(), self.journal_entries.len());
        let undone = std::mem::take(&mut self.history.undone);
        let rows = self.row_counts();
        if let Err(error) = edit(self) {
            while self.history.done.len() > first {
                let step = self.history.done.pop();
                step.map(|step| self.invert(step));
            }
            if self.row_counts() != rows {
                self.drop_rows(rows);
            }
            self.journal_entries.truncate(entries);
            self.history.undone = undone;
            return Err(error);
        }
        let steps = self.history.done.drain(first..);
        let joined = steps.reduce(|before, after| Step {
            changes: after.changes.into_iter().chain(before.changes).collect(),
            number: after.number,
            ..before
        });
        match joined {
            Some(step) => self.history.done.push(Step { name, ..step }),
            None => self.history.undone = undone,
        }
        self.join_entries(entries);
        Ok(())
    }

    /// Joins the journal entries from `first` on, all of which do changes.
    fn join_entries(&mut self, first: usize) {
        let entries = self.journal_entries.drain(first..);
        let changes = entries.filter_map(|entry| match entry {
            JournalEntry::Do(changes) => Some(changes),
            _ => None,
        });
        let changes: Vec<_> = changes.flatten().collect();
        if !changes.is_empty() {
            self.journal_entries.push(JournalEntry::Do(changes));
        }
    }
}
