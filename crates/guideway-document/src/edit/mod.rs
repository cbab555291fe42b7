//! Changes of a document, and how they are undone.

mod operations;
mod shape;

use std::collections::HashSet;
use std::sync::Arc;

use guideway_scene::{Edit, EditError, PathState};
use guideway_spline::Point;

use crate::{Document, JournalEntry, PathSet};

pub use operations::{PointRef, drawn_path};

/// One change; several make a step.
#[derive(Clone, Debug)]
pub enum Change {
    /// Of the scene.
    Scene(Edit),
    /// Nodes to other places, in meters.
    MoveNodes(NodeMoves),
}

/// PathSet of nodes, and where they go.
pub type NodeMoves = Arc<[(u32, Point<f64>)]>;

/// What was done, as what undoes it; and what was undone, as what does it again.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// Number of the newest step.
    newest: u64,
    /// Number of the last step done when the layout was saved, or read.
    saved: u64,
}

/// A state that was saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SavedState(u64);

/// The changes that lead from one state to the next, and the selection there.
#[derive(Clone, Debug)]
struct Step {
    name: &'static str,
    number: u64,
    changes: Vec<Change>,
    selection: Arc<PathSet>,
}

impl Document {
    /// Does changes, all or none, as one step that can be undone. `name` says what it is, for people.
    ///
    /// # Errors
    /// When one of them cannot be done; nothing is changed then.
    pub fn perform(&mut self, name: &'static str, changes: Vec<Change>) -> Result<(), EditError> {
        if changes.is_empty() {
            return Ok(());
        }
        let selection = Arc::clone(&self.selection);
        let inverse = self.apply(&changes)?;
        self.acts.push(JournalEntry::Do(changes));
        self.history.newest += 1;
        self.history.undone.clear();
        self.history.done.push(Step {
            name,
            number: self.history.newest,
            changes: inverse,
            selection,
        });
        Ok(())
    }

    /// Undoes the last step; returns its name, or none if there is none.
    pub fn undo(&mut self) -> Option<&'static str> {
        let step = self.history.done.pop()?;
        self.acts.push(JournalEntry::Undo);
        let (name, undone) = self.turn(step);
        self.history.undone.extend(undone);
        Some(name)
    }

    /// Does again what was undone last; returns its name, or none if there is none.
    pub fn redo(&mut self) -> Option<&'static str> {
        let step = self.history.undone.pop()?;
        self.acts.push(JournalEntry::Redo);
        let (name, done) = self.turn(step);
        self.history.done.extend(done);
        Some(name)
    }

    /// What [`Self::undo`] and [`Self::redo`] would undo and do again.
    pub fn undo_redo_names(&self) -> (Option<&'static str>, Option<&'static str>) {
        let name = |steps: &[Step]| steps.last().map(|step| step.name);
        (name(&self.history.done), name(&self.history.undone))
    }

    /// Bytes held so that what was done can be undone, and done again.
    pub fn history_bytes(&self) -> u64 {
        self.history.bytes()
    }

    /// Whether it differs from what was last saved.
    pub fn is_changed(&self) -> bool {
        self.history.now() != self.history.saved
    }

    /// A number for the state that it is in; the same again where all that was done since is undone.
    pub fn state(&self) -> u64 {
        self.history.now()
    }

    /// Takes the present state as saved. Returns what was taken so before.
    pub fn mark_saved(&mut self) -> SavedState {
        let now = self.history.now();
        SavedState(std::mem::replace(&mut self.history.saved, now))
    }

    /// Takes a state as saved that was before: saving another one failed.
    pub fn restore_saved(&mut self, before: SavedState) {
        self.history.saved = before.0;
    }

    /// Does the changes of a step, and returns the step that takes them back.
    fn turn(&mut self, step: Step) -> (&'static str, Option<Step>) {
        let selection = std::mem::replace(&mut self.selection, step.selection);
        // They were found when the document was just so, hence they can be done.
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

    /// Does changes and returns those that undo them, in the order in which they must be done.
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
        self.drop_hidden_from_selection();
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

    /// Changes the states of paths.
    fn states_of(paths: impl Iterator<Item = u32>, state: PathState) -> Change {
        Change::Scene(Edit::SetStates(paths.map(|path| (path, state)).collect()))
    }
}

impl History {
    fn now(&self) -> u64 {
        self.done.last().map_or(0, |step| step.number)
    }

    fn bytes(&self) -> u64 {
        let mut seen = HashSet::new();
        let steps = self.done.iter().chain(&self.undone);
        steps
            .map(|step| {
                let changes: usize = step.changes.iter().map(Change::heap_bytes).sum();
                // Steps in a row mostly share one selection.
                let is_new = seen.insert(Arc::as_ptr(&step.selection));
                let selection = if is_new {
                    step.selection.serialized_size()
                } else {
                    0
                };
                (size_of::<Step>() + changes + selection) as u64
            })
            .sum()
    }
}

impl Change {
    fn heap_bytes(&self) -> usize {
        size_of::<Self>()
            + match self {
                Self::Scene(edit) => edit.heap_bytes(),
                Self::MoveNodes(nodes) => size_of_val(&**nodes),
            }
    }
}
