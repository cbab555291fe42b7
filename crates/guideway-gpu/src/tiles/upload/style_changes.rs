//! Collects the changed styles of an edit, by all threads.

use guideway_scene::Scene;
use rayon::prelude::*;

use super::pack::path_style;
use super::path_strokes::{PathStrokes, cluster_of};
use super::scene_buffers::SceneBuffers;
use crate::device::Patch;
use crate::tiles::layouts::PathStyle;

const STYLE_WORDS: usize = size_of::<PathStyle>() / 4;
/// Paths of a task.
const TASK_PATHS: usize = 1 << 12;

/// Changed styles of some rows.
#[derive(Default)]
pub(crate) struct StyleChanges {
    pub(crate) patch: Patch,
    /// Clusters with a wider stroke than before.
    pub(crate) wider: Vec<(usize, f32)>,
}

impl StyleChanges {
    /// The styles of changed rows, by task.
    pub(crate) fn of_all(
        scene: &Scene,
        buffers: &SceneBuffers,
        path_strokes: &PathStrokes,
        rows: &[u32],
    ) -> Vec<Self> {
        let tasks = rows.par_chunks(TASK_PATHS);
        let changes = tasks.map(|rows| Self::of(scene, buffers, path_strokes, rows));
        changes.collect()
    }

    fn of(scene: &Scene, buffers: &SceneBuffers, strokes: &PathStrokes, rows: &[u32]) -> Self {
        let mut changes = Self::default();
        for &row in rows {
            let Some(rank) = buffers.ranks.rank(row) else {
                continue;
            };
            let style = path_style(scene, row);
            changes.patch.set(rank as usize * STYLE_WORDS, &style);
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
