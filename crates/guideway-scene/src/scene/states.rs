//! States of paths: sets and counts them, and computes the draw order of the shown ones.

use std::sync::OnceLock;

use guideway_layout::{Layout, PathRef, for_each_row, rows_ascend};
use rayon::prelude::*;

use super::model::{PathState, Scene};

/// Rows of a task.
const TASK_ROWS: usize = 1 << 14;

impl Scene {
    /// Returns `true` if the paths are drawn in the order of their rows.
    pub fn draws_by_rows(&self) -> bool {
        let is_unknown = self.draw_order.get().is_none();
        is_unknown && self.layout.paths.rank().is_none() || self.draw_order().is_sorted()
    }

    /// Returns `true` if all shown paths have one color, and none a width of its own.
    pub fn is_plain(&self) -> bool {
        self.common_color().is_some() && self.widest_m().is_none()
    }

    /// Drops what depends on the rows, and counts states; call after rows change.
    pub(crate) fn rows_changed(&mut self) {
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

/// Initial state per row: hides the paths of all levels but `level`.
pub(super) fn states(layout: &Layout, level: Option<u32>) -> Vec<PathState> {
    if level.is_none() {
        return Vec::new();
    }
    let state = |path: PathRef<'_>| match path.level() == level {
        true => PathState::Shown,
        false => PathState::Hidden,
    };
    layout.paths.iter().map(state).collect()
}

/// Rows of the shown paths, lowest draw rank first; `states` is empty if all are shown.
pub(super) fn draw_order(layout: &Layout, states: &[PathState]) -> Vec<u32> {
    let rows = 0..layout.paths.len() as u32;
    let mut order: Vec<u32> = match states.is_empty() {
        true => rows.into_par_iter().collect(),
        false => {
            let tasks = rows.into_par_iter().with_min_len(TASK_ROWS);
            let is_shown = |path: &u32| states[*path as usize] == PathState::Shown;
            tasks.filter(is_shown).collect()
        }
    };
    if let Some(rank) = layout.paths.rank() {
        order.sort_by_key(|&path| rank[path as usize]);
    }
    order
}
