//! States and numbers of paths: sets and counts states, adds and drops rows.

use std::sync::{Arc, OnceLock};

use guideway_layout::{for_each_row, rows_ascend};
use rayon::prelude::*;

use super::coloring::{Coloring, Colors};
use super::model::Scene;
use super::path_state::PathState;

/// Rows of a task.
const TASK_ROWS: usize = 1 << 14;

impl Scene {
    /// Returns `true` if the paths are drawn in the order of their rows.
    pub fn draws_by_rows(&self) -> bool {
        let may_differ = self.coloring.structure_below || self.layout.paths.rank().is_some();
        !may_differ || self.draw_order().is_sorted()
    }

    /// Returns `true` if the scene can take these colors: they are as many as its paths.
    pub fn accepts(&self, coloring: &Coloring) -> bool {
        coloring.suits(self.row_count())
    }

    /// Returns `true` if paths are drawn in another order with these colors.
    pub fn is_reordered_by(&self, coloring: &Coloring) -> bool {
        self.coloring.structure_below != coloring.structure_below
    }

    /// Takes other colors, at a cost proportional to the number of paths.
    ///
    /// # Panics
    /// When the colors are fewer or more than the paths: see [`Self::accepts`].
    pub fn recolor(&mut self, coloring: &Coloring) {
        assert!(self.accepts(coloring), "colors of another layout");
        if self.is_reordered_by(coloring) {
            self.order_changed();
        }
        self.coloring.clone_from(coloring);
        self.census = OnceLock::new();
    }

    /// Drops all rows of paths, nodes and stations but the first ones, and gives their memory back.
    /// Unlike an edit it has no inverse, and costs time proportional to what is left.
    ///
    /// # Panics
    /// When a table has fewer rows.
    pub fn truncate(&mut self, rows: [usize; 3]) {
        self.layout = Arc::new(self.layout.first_rows(rows));
        let [paths, places @ ..] = rows;
        if let Colors::Each(colors) = &mut self.coloring.colors {
            colors.truncate(paths);
            colors.shrink_to_fit();
        }
        self.states.truncate(paths);
        self.states.shrink_to_fit();
        for (removed, count) in self.removed_places.iter_mut().zip(places) {
            removed.truncate(count);
            removed.shrink_to_fit();
        }
        self.rows_changed();
    }

    /// Drops what depends on the rows, and counts states; call after rows change.
    fn rows_changed(&mut self) {
        let tasks = self.states.par_iter().with_min_len(TASK_ROWS);
        let count = |of: PathState| tasks.clone().filter(|state| **state == of).count();
        self.removed_count = count(PathState::Removed);
        self.shown_count = match self.states.is_empty() {
            true => self.row_count(),
            false => count(PathState::Shown),
        };
        self.census = OnceLock::new();
        self.order_changed();
    }

    /// Shows new rows, from `first` on.
    pub(crate) fn show_new_rows(&mut self, first: usize) {
        let rows = self.row_count();
        if !self.states.is_empty() {
            self.states.resize(rows, PathState::Shown);
        }
        self.shown_count += rows - first;
        let new: Vec<u32> = (first as u32..rows as u32).collect();
        self.count_new_styles(&new);
        self.order_changed();
    }

    /// Drops the draw order and the bounds; call after states change.
    fn order_changed(&mut self) {
        self.draw_order = OnceLock::new();
        self.invalidate_bounds();
    }

    /// Sets states. Cost: O(changed paths); if a path occurs twice, its last state counts.
    pub(crate) fn set_states(&mut self, states: &[(u32, PathState)]) {
        self.states.resize(self.row_count(), PathState::Shown);
        let row = |state: &(u32, PathState)| state.0;
        self.track_styles(states, &row, |scene| {
            let mut counts = StateCounts::default();
            if states.len() > TASK_ROWS && rows_ascend(states, &row) {
                let change = |&(row, new): &(u32, PathState)| {
                    StateCounts::of_change(scene.states[row as usize], new)
                };
                let tasks = states.par_chunks(TASK_ROWS);
                let changes = tasks.map(|states| states.iter().map(change).sum());
                counts = changes.sum();
                for_each_row(&mut scene.states, states, &row, &|to, (_, new)| *to = *new);
            } else {
                for &(row, new) in states {
                    let old = std::mem::replace(&mut scene.states[row as usize], new);
                    counts = [counts, StateCounts::of_change(old, new)].into_iter().sum();
                }
            }
            let after = |count: usize, change: isize| count.saturating_add_signed(change);
            scene.shown_count = after(scene.shown_count, counts.shown);
            scene.removed_count = after(scene.removed_count, counts.removed);
        });
        self.order_changed();
    }
}

/// Changes of the numbers of shown and removed paths.
#[derive(Clone, Copy, Default)]
struct StateCounts {
    shown: isize,
    removed: isize,
}

impl StateCounts {
    fn of_change(old: PathState, new: PathState) -> Self {
        let change = |of: PathState| isize::from(new == of) - isize::from(old == of);
        Self {
            shown: change(PathState::Shown),
            removed: change(PathState::Removed),
        }
    }
}

impl std::iter::Sum for StateCounts {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |a, b| Self {
            shown: a.shown + b.shown,
            removed: a.removed + b.removed,
        })
    }
}
