//! Initial states of paths, and the draw order of the shown ones.

use guideway_layout::{Layout, PathRef};
use rayon::prelude::*;

use super::path_state::PathState;

/// Rows of a task.
const TASK_ROWS: usize = 1 << 14;

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

/// Rows of the shown paths, lowest draw rank first; `states` is empty if all are shown. With
/// `structure_below`, paths that no vehicle drives come before all others.
pub(super) fn draw_order(layout: &Layout, states: &[PathState], structure_below: bool) -> Vec<u32> {
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
    if structure_below {
        let is_driven = |path: &u32| layout.paths.is_driven(*path as usize);
        let (above, below): (Vec<u32>, _) = order.into_iter().partition(is_driven);
        order = [below, above].concat();
    }
    order
}
