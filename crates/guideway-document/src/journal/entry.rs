//! Journal entries as data.

use crate::change::Change;

/// An action of the user that changes the document.
#[derive(Clone, Debug)]
pub enum JournalEntry {
    /// Performed changes, as one step.
    Do(Vec<Change>),
    /// Tried changes that were rejected after they had appended rows, which later entries count.
    Try(Vec<Change>),
    /// Undid the last step.
    Undo,
    /// Redid the last undone step.
    Redo,
}
