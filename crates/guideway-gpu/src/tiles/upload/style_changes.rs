//! Collects the changed styles of an edit, by all threads.
//!
//! ```text
//!   ranks    5  9  14  22 ...     changed paths
//!   picks    0  0  1   0  ...     the style of each, among those of the edit
//!   styles   | black, 0.2 m | red, 0.3 m |
//! ```

use std::collections::HashMap;

use guideway_scene::Scene;
use rayon::prelude::*;

use super::pack::path_style;
use super::path_strokes::{PathStrokes, cluster_of};
use super::scene_buffers::SceneBuffers;
use crate::tiles::layouts::PathStyle;

/// Paths of a task.
const TASK_PATHS: usize = 1 << 12;

/// Changed styles of rows, a list per task.
#[derive(Default)]
pub(super) struct StyleChanges {
    /// Changed draw ranks.
    pub(super) ranks: Vec<Vec<u32>>,
    /// Index of the style of each; empty if all have the first one.
    pub(super) picks: Vec<Vec<u32>>,
    pub(super) styles: Vec<PathStyle>,
    /// Clusters with a wider stroke than before.
    pub(super) wider: Vec<(usize, f32)>,
}

impl StyleChanges {
    /// The styles of the rows of items. A row may occur twice.
    pub(super) fn of<I: Sync>(
        scene: &Scene,
        buffers: &SceneBuffers,
        path_strokes: &PathStrokes,
        (items, row): (&[I], &(impl Fn(&I) -> u32 + Sync)),
    ) -> Self {
        let change = |items: &[I]| {
            let rows = items.iter().map(row);
            TaskChanges::of(scene, buffers, path_strokes, rows)
        };
        let tasks: Vec<TaskChanges> = match items.len() {
            0..=TASK_PATHS => vec![change(items)],
            _ => items.par_chunks(TASK_PATHS).map(change).collect(),
        };
        let mut changes = Self::default();
        let first = tasks.first().and_then(|task| task.styles.first()).copied();
        let is_of_first = |task: &TaskChanges| task.styles.iter().all(|&s| Some(s) == first);
        let are_alike = tasks.iter().all(is_of_first);
        for mut task in tasks {
            let known = changes.styles.len() as u32;
            if !are_alike {
                task.picks.iter_mut().for_each(|pick| *pick += known);
                changes.picks.push(task.picks);
                changes.styles.append(&mut task.styles);
            }
            changes.ranks.push(task.ranks);
            changes.wider.append(&mut task.wider);
        }
        if are_alike {
            changes.styles.extend(first);
        }
        changes
    }

    /// Bytes that the device needs.
    pub(super) fn bytes(&self) -> u64 {
        let lists = self.ranks.iter().chain(&self.picks);
        let entries: usize = lists.map(|list| size_of_val(list.as_slice())).sum();
        (entries + size_of_val(self.styles.as_slice())) as u64
    }
}

/// Changed styles of the rows of a task.
#[derive(Default)]
struct TaskChanges {
    ranks: Vec<u32>,
    picks: Vec<u32>,
    styles: Vec<PathStyle>,
    wider: Vec<(usize, f32)>,
}

impl TaskChanges {
    fn of(
        scene: &Scene,
        buffers: &SceneBuffers,
        strokes: &PathStrokes,
        rows: impl ExactSizeIterator<Item = u32>,
    ) -> Self {
        let mut changes = Self {
            ranks: Vec::with_capacity(rows.len()),
            picks: Vec::with_capacity(rows.len()),
            ..Self::default()
        };
        let mut known = HashMap::new();
        let mut last = None;
        for row in rows {
            let Some(rank) = buffers.ranks.rank(row) else {
                continue;
            };
            let style = path_style(scene, row);
            let pick = match last {
                Some((last, pick)) if last == style => pick,
                _ => {
                    let new = changes.styles.len() as u32;
                    let key = (style.color, style.width_m.to_bits());
                    let pick = *known.entry(key).or_insert(new);
                    if pick == new {
                        changes.styles.push(style);
                    }
                    pick
                }
            };
            last = Some((style, pick));
            changes.ranks.push(rank);
            changes.picks.push(pick);
            if style.width_m < 0.0 {
                continue;
            }
            for &stroke in strokes.strokes(row) {
                let cluster = cluster_of(buffers, stroke);
                if style.width_m > buffers.cluster_list[cluster].widest_m {
                    changes.wider.push((cluster, style.width_m));
                }
            }
        }
        changes
    }
}
