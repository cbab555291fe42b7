//! Performs changes as undoable steps, and undoes and redoes them.

use std::sync::Arc;

use guideway_scene::{Edit, EditError, PathState};

use crate::change::{Change, NodeMoves};
use crate::document::Document;
use crate::history::{SavedState, Step};
use crate::journal::JournalEntry;

impl Document {
    /// Performs all changes, or none, as one undoable step. `name` is the step's name for people.
    ///
    /// # Errors
    /// When the scene rejects a change or a node is unknown; the document is unchanged.
    pub fn perform(&mut self, name: &'static str, changes: Vec<Change>) -> Result<(), EditError> {
        if changes.is_empty() {
            return Ok(());
        }
        let selection = Arc::clone(&self.selection);
        let inverse = self.apply(&changes)?;
        self.journal_entries.push(JournalEntry::Do(changes));
        self.history.push(name, inverse, selection);
        Ok(())
    }

    /// Undoes the last step and returns its name; `None` without one.
    pub fn undo(&mut self) -> Option<&'static str> {
        let step = self.history.done.pop()?;
        self.journal_entries.push(JournalEntry::Undo);
        let (name, undone) = self.invert(step);
        self.history.undone.extend(undone);
        Some(name)
    }

    /// Redoes the last undone step and returns its name; `None` without one.
    pub fn redo(&mut self) -> Option<&'static str> {
        let step = self.history.undone.pop()?;
        self.journal_entries.push(JournalEntry::Redo);
        let (name, done) = self.invert(step);
        self.history.done.extend(done);
        Some(name)
    }

    /// Names of the steps that [`Self::undo`] and [`Self::redo`] would take next.
    pub fn undo_redo_names(&self) -> (Option<&'static str>, Option<&'static str>) {
        let name = |steps: &[Step]| steps.last().map(|step| step.name);
        (name(&self.history.done), name(&self.history.undone))
    }

    /// Memory of the undo history, in bytes.
    pub fn history_bytes(&self) -> u64 {
        self.history.bytes()
    }

    /// Returns `true` if the document differs from the saved state.
    pub fn is_changed(&self) -> bool {
        self.history.is_changed()
    }

    /// A number for the present state; undoing all later steps returns to the same number.
    pub fn state(&self) -> u64 {
        self.history.state()
    }

    /// Marks the present state as saved. Returns the previous mark.
    pub fn mark_saved(&mut self) -> SavedState {
        self.history.mark_saved()
    }

    /// Restores a mark that [`Self::mark_saved`] returned, after saving failed.
    pub fn restore_saved(&mut self, before: SavedState) {
        self.history.restore_saved(before);
    }

    /// Applies the changes of a step and returns its name and inverse.
    fn invert(&mut self, step: Step) -> (&'static str, Option<Step>) {
        let selection = std::mem::replace(&mut self.selection, step.selection);
        // The changes were recorded in exactly this state, so none is rejected.
        let inverse = self.apply(&step.changes).ok();
        let Step { name, number, .. } = step;
        let step = inverse.map(|changes| Step {
            name,
            number,
            changes,
            selection,
        });
        (name, step)
    }

    /// Applies all changes or none. Returns the inverse changes, in the order to apply them.
    fn apply(&mut self, changes: &[Change]) -> Result<Vec<Change>, EditError> {
        self.revision += 1;
        let mut inverse = Vec::new();
        for change in changes {
            match self.apply_one(change) {
                Ok(undo) => inverse.push(undo),
                Err(error) => {
                    for undo in inverse.iter().rev() {
                        self.apply_one(undo)?;
                    }
                    return Err(error);
                }
            }
        }
        inverse.reverse();
        self.deselect_hidden();
        Ok(inverse)
    }

    fn apply_one(&mut self, change: &Change) -> Result<Change, EditError> {
        match change {
            Change::Scene(edit) => self.edit_scene(edit).map(Change::Scene),
            Change::MoveNodes(to) => self.move_nodes(to).map(Change::MoveNodes),
        }
    }

    fn edit_scene(&mut self, edit: &Edit) -> Result<Edit, EditError> {
        let undo = self
            .scene
            .edit_with_undo(edit, |edit| self.observer.notify(edit))?;
        let changed: &[u32] = match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => paths,
            Edit::Restyle(_) | Edit::SetStates(_) | Edit::Insert(_) => &[],
        };
        self.index.update(changed, self.scene.layout());
        Ok(undo)
    }

    fn move_nodes(&mut self, to: &NodeMoves) -> Result<NodeMoves, EditError> {
        let rows = self.layout().nodes.len();
        if let Some(&(row, _)) = to.iter().find(|(node, _)| *node as usize >= rows) {
            return Err(EditError::UnknownReference { what: "node", row });
        }
        if to.iter().any(|(_, at)| !at.is_finite()) {
            return Err(EditError::OutOfBounds { path: None });
        }
        let from = to
            .iter()
            .map(|&(node, _)| (node, self.node_position_m(node)))
            .collect();
        self.index.move_nodes(to);
        self.moved_nodes.extend(to);
        Ok(from)
    }
}

/// A change that sets the state of paths.
pub(super) fn set_states(paths: impl Iterator<Item = u32>, state: PathState) -> Change {
    Change::Scene(Edit::SetStates(paths.map(|path| (path, state)).collect()))
}
