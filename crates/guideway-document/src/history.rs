//! Undo history: steps stored as the changes that undo or redo them.

use std::collections::HashSet;
use std::sync::Arc;

use crate::change::{Change, CopiesOf};
use crate::elements::Elements;

/// Steps that can be undone and redone.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    /// Steps to undo, as their inverses, oldest first.
    pub(crate) done: Vec<Step>,
    /// Steps to redo, the next one last.
    pub(crate) undone: Vec<Step>,
    /// Number of the newest step.
    newest: u64,
    /// Number of the last step that the saved file contains.
    saved: u64,
}

/// A state that was marked as saved. See [`Document::mark_saved`](crate::Document::mark_saved).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SavedState(u64);

/// The changes from one state to a neighboring one, and the selection there.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) name: &'static str,
    pub(crate) number: u64,
    pub(crate) changes: Vec<StepChange>,
    pub(crate) selection: Arc<Elements>,
}

/// The steps of an edit that is shown, but does not count.
#[derive(Debug)]
pub(crate) struct Preview {
    pub(crate) steps: Vec<Step>,
    /// Numbers of rows before it.
    pub(crate) rows: [usize; 3],
}

/// A part of a step.
#[derive(Clone, Debug)]
pub(crate) enum StepChange {
    Change(Change),
    /// Removes copies for good: redoing copies again.
    RemoveCopies(CopiedRows),
}

/// Copies, and the rows of each table before and after them.
#[derive(Clone, Debug)]
pub(crate) struct CopiedRows {
    pub(crate) of: CopiesOf,
    pub(crate) first: [usize; 3],
    pub(crate) end: [usize; 3],
}

impl CopiedRows {
    /// Returns `true` if an eighth of all rows are copies, so that dropping them costs no more than
    /// copying did.
    pub(crate) fn are_many(&self) -> bool {
        let [first, end]: [usize; 2] = [self.first, self.end].map(|rows| rows.iter().sum());
        8 * (end - first) >= end
    }
}

impl StepChange {
    fn heap_bytes(&self) -> usize {
        match self {
            Self::Change(change) => change.heap_bytes(),
            Self::RemoveCopies(copied) => size_of::<Self>() + copied.of.elements.heap_bytes(),
        }
    }
}

impl History {
    /// Records a new step by its inverse changes and the selection before it. Drops the redo steps.
    pub(crate) fn push(
        &mut self,
        name: &'static str,
        inverse: Vec<StepChange>,
        selection: Arc<Elements>,
    ) {
        self.newest += 1;
        self.undone.clear();
        self.done.push(Step {
            name,
            number: self.newest,
            changes: inverse,
            selection,
        });
    }

    /// Number of the present state: that of the last step done, 0 before the first.
    pub(crate) fn state(&self) -> u64 {
        self.done.last().map_or(0, |step| step.number)
    }

    /// Returns `true` if the present state differs from the saved one.
    pub(crate) fn is_changed(&self) -> bool {
        self.state() != self.saved
    }

    /// Marks the present state as saved; returns the mark before.
    pub(crate) fn mark_saved(&mut self) -> SavedState {
        let now = self.state();
        SavedState(std::mem::replace(&mut self.saved, now))
    }

    pub(crate) fn restore_saved(&mut self, before: SavedState) {
        self.saved = before.0;
    }

    /// Memory of all steps, in bytes.
    pub(crate) fn bytes(&self) -> u64 {
        let mut counted = HashSet::new();
        let steps = self.done.iter().chain(&self.undone);
        steps
            .map(|step| {
                let changes: usize = step.changes.iter().map(StepChange::heap_bytes).sum();
                // Consecutive steps usually share one selection.
                let is_new = counted.insert(Arc::as_ptr(&step.selection));
                let selection = if is_new {
                    step.selection.heap_bytes()
                } else {
                    0
                };
                (size_of::<Step>() + changes + selection) as u64
            })
            .sum()
    }
}
