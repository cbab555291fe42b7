//! Performs changes as undoable steps, and undoes and redoes them.

use std::collections::HashMap;
use std::sync::Arc;

use guideway_layout::WrittenCurves;
use guideway_scene::{Edit, EditError, PathState, Table, TableEdit};
use guideway_spline::{Point, Runs};

use super::curves::geometry_of;
use crate::PathSet;
use crate::change::{Change, NodeMoves};
use crate::document::Document;
use crate::edit_observer::SceneChange;
use crate::history::{CopiedRows, Preview, SavedState, Step, StepChange};
use crate::index::Index;
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
        let rows = self.row_counts();
        let steps = changes.iter().cloned().map(StepChange::Change);
        let inverse = match self.apply(steps.collect()) {
            Ok(inverse) => inverse,
            Err(error) => {
                if self.row_counts() != rows {
                    self.journal_entries.push(JournalEntry::Try(changes));
                }
                self.selection = selection;
                return Err(error);
            }
        };
        self.journal_entries.push(JournalEntry::Do(changes));
        self.history.push(name, inverse, selection);
        Ok(())
    }

    /// Takes the preview back, if there is one.
    pub fn end_preview(&mut self) {
        if let Some(Preview { steps, rows }) = self.preview.take() {
            for step in steps.into_iter().rev() {
                self.invert(step);
            }
            if self.row_counts() != rows {
                self.drop_rows(rows);
            }
        }
    }

    /// Undoes the last step and returns its name; `None` without one.
    pub fn undo(&mut self) -> Option<&'static str> {
        self.end_preview();
        let step = self.history.done.pop()?;
        self.journal_entries.push(JournalEntry::Undo);
        let (name, undone) = self.invert(step);
        self.history.undone.extend(undone);
        Some(name)
    }

    /// Redoes the last undone step and returns its name; `None` without one.
    pub fn redo(&mut self) -> Option<&'static str> {
        self.end_preview();
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
    pub(super) fn invert(&mut self, step: Step) -> (&'static str, Option<Step>) {
        // The selection of the step has rows of levels as they are after it.
        let selection = std::mem::take(&mut self.selection);
        let Step {
            name,
            number,
            changes,
            selection: restored,
        } = step;
        let level = self.level;
        // The changes were recorded in exactly this state, so none is rejected.
        let inverse = self.apply(changes).ok();
        self.selection = restored;
        self.deselect_hidden();
        if level.is_some() && self.level.is_none() {
            // The level that was shown alone is gone.
            self.show_level(None);
        }
        let step = inverse.map(|changes| Step {
            name,
            number,
            changes,
            selection,
        });
        (name, step)
    }

    /// Applies all changes or none. Returns the inverse changes, in the order to apply them.
    fn apply(&mut self, changes: Vec<StepChange>) -> Result<Vec<StepChange>, EditError> {
        self.revision += 1;
        let mut inverse = Vec::new();
        for change in changes {
            if let Err(error) = self.apply_one(change, &mut inverse) {
                for undo in inverse.into_iter().rev() {
                    self.apply_one(undo, &mut Vec::new())?;
                }
                return Err(error);
            }
        }
        self.deselect_hidden();
        inverse.reverse();
        Ok(inverse)
    }

    /// Applies a change and adds to `inverse` what takes it back, also of one rejected halfway.
    fn apply_one(
        &mut self,
        change: StepChange,
        inverse: &mut Vec<StepChange>,
    ) -> Result<(), EditError> {
        match change {
            StepChange::Change(change) => {
                if let Change::Copy(of) = &change {
                    self.check_copies(of)?;
                }
                let (first, before) = (self.row_counts(), inverse.len());
                self.apply_edits(self.edits_of(&change), inverse)?;
                if let Change::Copy(of) = change {
                    let end = self.row_counts();
                    let copied = CopiedRows { of, first, end };
                    if copied.are_many() {
                        inverse.truncate(before);
                        inverse.push(StepChange::RemoveCopies(copied));
                    }
                }
                Ok(())
            }
            StepChange::RemoveCopies(copied) if self.row_counts() == copied.end => {
                self.drop_rows(copied.first);
                inverse.push(StepChange::Change(Change::Copy(copied.of)));
                Ok(())
            }
            // Undone steps need the rows behind those of the copies.
            StepChange::RemoveCopies(copied) => {
                let rows = |at: usize| copied.first[at] as u32..copied.end[at] as u32;
                let places = [(1, Table::Nodes), (2, Table::Stations)].map(|(at, of)| {
                    let rows = rows(at).map(|row| (row, false)).collect();
                    Change::from(TableEdit::SetExists { of, rows })
                });
                let paths = set_states(rows(0), PathState::Removed);
                let all = [paths].into_iter().chain(places);
                let edits = all.flat_map(|change| self.edits_of(&change)).collect();
                self.apply_edits(edits, inverse)
            }
        }
    }

    fn apply_edits(
        &mut self,
        edits: Vec<Edit>,
        inverse: &mut Vec<StepChange>,
    ) -> Result<(), EditError> {
        edits.into_iter().try_for_each(|edit| {
            let undo = self.edit_scene(&edit)?;
            inverse.push(StepChange::Change(Change::Scene(undo)));
            Ok(())
        })
    }

    /// Drops the last rows of all tables, and gives their memory back.
    pub(super) fn drop_rows(&mut self, rows: [usize; 3]) {
        self.scene.truncate(rows);
        self.index = Arc::new(Index::of_scene(&self.scene));
        let replaced = SceneChange::Replaced(&self.scene);
        self.observer.notify_change(replaced);
    }

    pub(super) fn row_counts(&self) -> [usize; 3] {
        Table::ALL.map(|of| of.row_count(self.layout()))
    }

    /// The edits of the scene that a change means now.
    fn edits_of(&self, change: &Change) -> Vec<Edit> {
        match change {
            Change::Scene(edit) => vec![edit.clone()],
            Change::Copy(copies) => self.copies_of(copies).into_edits(),
            Change::MoveNodes(to) => {
                let stations = self.stations_after(to);
                let nodes = TableEdit::MoveNodes(Arc::clone(to));
                let stations =
                    (!stations.is_empty()).then(|| TableEdit::MoveStations(stations.into()));
                [nodes]
                    .into_iter()
                    .chain(stations)
                    .map(Edit::Tables)
                    .collect()
            }
        }
    }

    /// The stations that move along with nodes, and their new positions: each by the mean of the
    /// moves of its nodes.
    fn stations_after(&self, to: &NodeMoves) -> Vec<(u32, Option<Point<f64>>)> {
        let layout = self.layout();
        let rows = layout.nodes.len();
        let known = to.iter().filter(|(node, _)| (*node as usize) < rows);
        let by_m = |&(node, at_m): &(u32, Point<f64>)| (node, at_m - layout.nodes.position_m(node));
        let moves: HashMap<u32, Point<f64>> = known.map(by_m).collect();
        let at_nodes = moves.keys().flat_map(|&node| self.index.stations_at(node));
        let mut stations: Vec<u32> = at_nodes.collect();
        stations.sort_unstable();
        stations.dedup();
        let exists = |station: &u32| self.scene.exists(Table::Stations, *station);
        let after = stations.into_iter().filter(exists).filter_map(|station| {
            let placed_m = layout.stations.position_m(station)?;
            let nodes = layout.stations.nodes(station);
            let moves = nodes.iter().filter_map(|node| moves.get(node));
            let sum = moves.fold(Point::new(0.0, 0.0), |sum, by| sum + *by);
            Some((station, Some(placed_m + sum * (1.0 / nodes.len() as f64))))
        });
        after.collect()
    }

    /// Keeps the levels that are shown, selected and drawn on, whose rows an edit may change.
    fn renumber_levels(&mut self, edit: &TableEdit) {
        self.level = self.level.and_then(|level| edit.level_after(level));
        if matches!(
            edit,
            TableEdit::InsertLevel { .. } | TableEdit::RemoveLevel(_)
        ) {
            let after = |levels: &PathSet| -> PathSet {
                let levels = levels.iter();
                levels.filter_map(|level| edit.level_after(level)).collect()
            };
            self.hidden_levels = after(&self.hidden_levels);
            if !self.selection.levels.is_empty() {
                let selection = Arc::make_mut(&mut self.selection);
                selection.levels = after(&selection.levels);
            }
        }
    }

    fn edit_scene(&mut self, edit: &Edit) -> Result<Edit, EditError> {
        let undo = self
            .scene
            .edit_with_undo(edit, |edit| self.observer.notify(edit))?;
        let changed: &[u32] = match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => paths,
            Edit::Restyle(_) | Edit::SetStates(_) | Edit::Insert(_) | Edit::Tables(_) => &[],
        };
        Arc::make_mut(&mut self.index).update(changed, self.scene.layout());
        if let (Edit::Tables(edit), Edit::Tables(undo)) = (edit, &undo) {
            let is_of_values = matches!(
                edit,
                TableEdit::SetValues { .. }
                    | TableEdit::SetColumn { .. }
                    | TableEdit::SetEntries { .. }
            );
            self.values_revision += u64::from(is_of_values);
            self.renumber_levels(edit);
            Arc::make_mut(&mut self.index).update_tables(edit, undo, &self.scene);
        }
        Ok(undo)
    }
}

/// A change that sets the state of paths.
pub(super) fn set_states(paths: impl Iterator<Item = u32>, state: PathState) -> Change {
    Change::Scene(Edit::SetStates(paths.map(|path| (path, state)).collect()))
}

/// A change that replaces the curves of paths.
pub(super) fn reshape(paths: Vec<u32>, curves: &[Runs]) -> Change {
    reshape_as_written(paths, curves, WrittenCurves::default())
}

/// A change that replaces the curves of paths. `written` has those that are kept as written.
pub(super) fn reshape_as_written<'r>(
    paths: Vec<u32>,
    curves: impl IntoIterator<Item = &'r Runs>,
    written: WrittenCurves,
) -> Change {
    Change::Scene(Edit::Reshape {
        paths: paths.into(),
        curves: Arc::new(geometry_of(curves)),
        written: written.into(),
    })
}
