//! Shows and hides paths: sends the index of each changed stroke, never its points.

use guideway_scene::cluster::DirtyClusters;
use guideway_scene::{PathState, RenderError, Scene};
use rayon::prelude::*;

use super::edit_effect::EditEffect;
use super::edit_patches::STROKE_WORDS;
use super::path_strokes::{PathStrokes, cluster_of};
use super::scene_buffers::SceneBuffers;
use super::uploaded_scene::UploadedScene;
use crate::device::SET_BIT;
use crate::tiles::constants::HIDDEN_STROKE;
use crate::tiles::device_context::DeviceContext;

/// Paths of a task: some 50 microseconds of work.
const TASK_PATHS: usize = 1 << 12;

/// Changes of some paths.
#[derive(Default)]
struct StateChanges {
    /// Changed strokes, as the device takes them.
    entries: Vec<u32>,
    dirty: DirtyClusters,
    /// Shown paths without strokes.
    missing: Vec<u32>,
}

impl StateChanges {
    fn of(
        scene: &Scene,
        buffers: &SceneBuffers,
        strokes: &PathStrokes,
        states: &[(u32, PathState)],
    ) -> Self {
        let mut changes = Self {
            entries: Vec::with_capacity(states.len()),
            ..Self::default()
        };
        // The scene knows the last state of a row that occurs twice.
        for &(row, _) in states {
            let is_hidden = scene.state(row) != PathState::Shown;
            let strokes = strokes.strokes(row);
            if strokes.is_empty() && !is_hidden {
                changes.missing.push(row);
            }
            for &stroke in strokes {
                if buffers.hidden.set(stroke, is_hidden) {
                    let cluster = cluster_of(buffers, stroke);
                    buffers.count_shown(cluster, stroke, is_hidden);
                    changes.dirty.add(cluster);
                    changes
                        .entries
                        .push(stroke | if is_hidden { SET_BIT } else { 0 });
                }
            }
        }
        changes
    }
}

/// Shows and hides the strokes of rows after the scene has taken their states. Returns the shown
/// rows that have none.
pub(super) fn write_states(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    states: &[(u32, PathState)],
    effect: &mut EditEffect,
) -> Result<Vec<u32>, RenderError> {
    let scene = &uploaded.scene;
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(Vec::new());
    };
    buffers.hidden.grow(buffers.stroke_list.len());
    let path_strokes = uploaded
        .path_strokes
        .get_or_insert_with(|| PathStrokes::of(buffers, scene.row_count()));
    let change = |states: &[_]| StateChanges::of(scene, buffers, path_strokes, states);
    let changes: Vec<StateChanges> = match states.len() {
        0..=TASK_PATHS => vec![change(states)],
        _ => states.par_chunks(TASK_PATHS).map(change).collect(),
    };
    let (mut entries, mut missing) = (Vec::new(), Vec::new());
    for changes in changes {
        effect.moved_bytes += size_of_val(changes.entries.as_slice()) as u64;
        effect.dirty.join(&changes.dirty);
        entries.push(changes.entries);
        missing.extend(changes.missing);
    }
    let (patcher, target) = device.patch(&mut uploaded.patcher, &buffers.strokes)?;
    patcher.set_bits(target, STROKE_WORDS, HIDDEN_STROKE, &entries)?;
    Ok(missing)
}
