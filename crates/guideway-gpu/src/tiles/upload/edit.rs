//! Applies an edit to the scene and its buffers: in place where strokes keep their size and place,
//! otherwise in clusters appended to the end.

use std::borrow::Cow;
use std::sync::Arc;

use guideway_layout::{OwnStyle, rows_ascend};
use guideway_scene::{Edit, PathState, RenderError, Scene};
use rayon::prelude::*;

use super::edit_effect::EditEffect;
use super::edit_patches::{EditPatches, Target};
use super::pack::Packed;
use super::path_parts::PathPart;
use super::path_strokes::{PathStrokes, cluster_of};
use super::rewrite::{Rewriter, send_points};
use super::scene_buffers::SceneBuffers;
use super::states::write_states;
use super::style_changes::StyleChanges;
use super::uploaded_scene::UploadedScene;
use crate::device::Patch;
use crate::tiles::device_context::DeviceContext;
use crate::tiles::layouts::{PathStyle, PointFormat};

/// Unused points from which on the scene is packed again: this many, or a quarter of all points.
const MAX_UNUSED_POINTS: usize = 1 << 16;

/// Least number of paths that leave the place of their strokes at which the scene is packed again:
/// the greater of this number and this part of all strokes.
const MIN_PACKED_PATHS: usize = 1 << 16;
const PACKED_PART: usize = 4;

/// Paths per upload of points: some megabytes of usual paths.
const BATCH_PATHS: usize = 1 << 17;

/// Result of an edit.
pub(crate) enum SceneBufferEdit {
    /// The buffers are up to date.
    Applied(EditEffect),
    /// The scene must be uploaded again.
    NeedsUpload,
}

/// Applies an edit. After an error `UploadedScene::is_incomplete` is set.
pub(crate) fn apply(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    edit: &Edit,
) -> Result<SceneBufferEdit, RenderError> {
    let first_new = uploaded.scene.row_count() as u32;
    let scene = Arc::make_mut(&mut uploaded.scene);
    let draws_all = scene.shown_count() == scene.row_count();
    scene.edit(edit).map_err(RenderError::Edit)?;
    if matches!(edit, Edit::Tables(_)) {
        return Ok(SceneBufferEdit::Applied(EditEffect::default()));
    }
    let rows = rewritten_rows(edit, first_new, &uploaded.scene);
    // Buffers of which an earlier edit wrote a part cannot be patched.
    if std::mem::replace(&mut uploaded.is_incomplete, true) {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    let mut effect = EditEffect::default();
    let plain_before = uploaded.facts.is_plain.then_some(uploaded.facts.color);
    let moves = matches!(edit, Edit::Transform { .. } | Edit::Reshape { .. });
    if !moves {
        let before = uploaded.facts.appearance();
        uploaded.facts.refresh_appearance(&uploaded.scene);
        effect.changes_appearance =
            matches!(edit, Edit::Restyle(_)) || uploaded.facts.appearance() != before;
    }
    let has_ranks = |buffers: &SceneBuffers| match edit {
        Edit::Restyle(styles) => buffers.ranks.have_all(styles, |(row, _)| *row),
        Edit::SetStates(states) => buffers.ranks.have_all(states, |(row, _)| *row),
        _ => buffers.ranks.have_all(&rows, |row| *row),
    };
    if !uploaded.buffers.as_ref().is_some_and(has_ranks) {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    if !moves {
        complete_styles(
            uploaded,
            device,
            edit,
            (plain_before, draws_all),
            &mut effect,
        )?;
    }
    let is_written = match edit {
        Edit::Restyle(styles) => {
            let items = (&styles[..], &|(row, _): &(u32, OwnStyle)| *row);
            write_styles(uploaded, device, items, &mut effect)?;
            true
        }
        Edit::SetStates(states) => {
            let missing = write_states(uploaded, device, states, &mut effect)?;
            let missing = each_once(missing.into());
            missing.is_empty() || write_curves(uploaded, device, &missing, &mut effect)?
        }
        Edit::Insert(_) => {
            write_styles(uploaded, device, (&rows, &|row| *row), &mut effect)?;
            write_curves(uploaded, device, &rows, &mut effect)?
        }
        _ => write_curves(uploaded, device, &rows, &mut effect)?,
    };
    if !is_written {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    uploaded.is_incomplete = false;
    Ok(SceneBufferEdit::Applied(effect))
}

/// The rows whose curves an edit changes, new ones included. States and styles need no list.
fn rewritten_rows<'a>(edit: &'a Edit, first_new: u32, scene: &Scene) -> Cow<'a, [u32]> {
    match edit {
        Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => {
            each_once(Cow::Borrowed(&**paths))
        }
        Edit::Insert(_) => (first_new..scene.row_count() as u32).collect(),
        Edit::Restyle(_) | Edit::SetStates(_) | Edit::Tables(_) => Cow::default(),
    }
}

/// Rows in ascending order, each once: an edit may name a row twice.
fn each_once(rows: Cow<'_, [u32]>) -> Cow<'_, [u32]> {
    if rows_ascend(&rows, &|row| *row) {
        return rows;
    }
    let mut rows = rows.into_owned();
    rows.par_sort_unstable();
    rows.dedup();
    rows.into()
}

/// Makes the styles on the device serve all paths: a single style while paths look alike,
/// otherwise one per path. `plain_before` is the color that all shown paths had; `draws_all` tells
/// that no path was hidden.
fn complete_styles(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    edit: &Edit,
    (plain_before, draws_all): (Option<u32>, bool),
    effect: &mut EditEffect,
) -> Result<(), RenderError> {
    let (scene, facts) = (&uploaded.scene, uploaded.facts);
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(());
    };
    let is_complete = buffers.style_count as usize == buffers.ranks.count(scene);
    // Translucent paths read the single style, too, so it must have their color.
    let is_current = facts.is_plain
        && buffers.style_count == 1
        && plain_before == Some(facts.color)
        && !matches!(edit, Edit::Insert(_));
    if is_complete || is_current {
        return Ok(());
    }
    let fills = draws_all && !facts.is_plain && matches!(edit, Edit::Restyle(_));
    effect.moved_bytes += match plain_before.filter(|_| fills) {
        Some(color) => {
            let style = PathStyle {
                color,
                width_m: -1.0,
            };
            buffers.fill_styles(device, &mut uploaded.patcher, scene, style)?
        }
        None => buffers.send_styles(device, scene)?,
    };
    uploaded.facts.styles = buffers.style_count;
    effect.replaces_buffers = true;
    Ok(())
}

/// Writes colors and widths of the rows of items.
fn write_styles<I: Sync>(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    items: (&[I], &(impl Fn(&I) -> u32 + Sync)),
    effect: &mut EditEffect,
) -> Result<(), RenderError> {
    let scene = &uploaded.scene;
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(());
    };
    let path_strokes = uploaded
        .path_strokes
        .get_or_insert_with(|| PathStrokes::of(buffers, scene.row_count()));
    let changes = StyleChanges::of(scene, buffers, path_strokes, items);
    let is_complete = buffers.style_count as usize == buffers.ranks.count(scene);
    if is_complete && !changes.styles.is_empty() {
        effect.moved_bytes += changes.bytes();
        let StyleChanges {
            ranks,
            picks,
            styles,
            ..
        } = &changes;
        let (patcher, target) = device.patch(&mut uploaded.patcher, &buffers.styles)?;
        patcher.set_values(target, ranks, picks, styles)?;
    }
    let mut patches = EditPatches::default();
    for (cluster, width_m) in changes.wider {
        let widest_m = &mut buffers.cluster_list[cluster].widest_m;
        *widest_m = widest_m.max(width_m);
        patches.clusters.add(cluster);
    }
    send(uploaded, device, patches, Vec::new(), effect)
}

/// Writes new curves of rows, hidden or not. Returns `false` if packing the scene again costs less.
fn write_curves(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    rows: &[u32],
    effect: &mut EditEffect,
) -> Result<bool, RenderError> {
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(false);
    };
    let scene = &uploaded.scene;
    let path_strokes = uploaded
        .path_strokes
        .get_or_insert_with(|| PathStrokes::of(buffers, scene.row_count()));
    let (mut written, mut others) = (Vec::new(), 0);
    for rows in rows.chunks(BATCH_PATHS) {
        let rewriter = Rewriter {
            scene,
            buffers,
            path_strokes,
            packing: uploaded.packing,
            spare: &uploaded.spare_patches,
        };
        let mut tasks = rewriter.run(rows);
        others += tasks.iter().map(|task| task.others.len()).sum::<usize>();
        if others >= MIN_PACKED_PATHS.max(buffers.stroke_list.len() / PACKED_PART) {
            return Ok(false);
        }
        // The device takes the points while the next ones are converted.
        let patcher = &mut uploaded.patcher;
        let spare = &uploaded.spare_patches;
        effect.moved_bytes += send_points(&mut tasks, buffers, patcher, device, spare)?;
        written.append(&mut tasks);
    }
    let mut patches = EditPatches::default();
    let mut moved_parts = Vec::new();
    let mut parts = Vec::new();
    for task in written {
        for (stroke, new) in task.strokes {
            buffers.stroke_list[stroke as usize] = new;
            patches.strokes.push(stroke);
        }
        for (cluster, box_m) in task.grown {
            buffers.cluster_list[cluster as usize].include(box_m);
            patches.clusters.add(cluster as usize);
        }
        patches.dirty.join(&task.dirty);
        for row in task.others {
            for &stroke in path_strokes.strokes(row) {
                let unused = &mut buffers.stroke_list[stroke as usize];
                unused.extent = unused.first_point();
                patches.strokes.push(stroke);
                let cluster = cluster_of(buffers, stroke);
                patches.dirty.add(cluster);
                patches.recounted.add(cluster);
            }
            path_strokes.remove(buffers, row);
            parts.clear();
            // A hidden path gets strokes when it is shown.
            if scene.state(row) == PathState::Shown
                && let Some(rank) = buffers.ranks.rank(row)
            {
                PathPart::of_path(scene.layout(), row, rank, &mut parts);
            }
            if parts.len() > 1 {
                uploaded.multi_stroke_paths.insert(row);
            } else if !uploaded.multi_stroke_paths.is_empty() {
                uploaded.multi_stroke_paths.remove(&row);
            }
            moved_parts.extend_from_slice(&parts);
        }
    }
    let points = buffers.point_buffers.iter().map(|b| b.used_points as usize);
    let points: usize = points.sum();
    if path_strokes.unused_points > MAX_UNUSED_POINTS.max(points / 4) {
        return Ok(false);
    }
    send(uploaded, device, patches, moved_parts, effect)?;
    Ok(true)
}

/// Appends moved parts in new clusters, and sends all patches.
fn send(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    mut patches: EditPatches,
    moved_parts: Vec<PathPart>,
    effect: &mut EditEffect,
) -> Result<(), RenderError> {
    let (Some(buffers), Some(path_strokes)) = (&mut uploaded.buffers, &mut uploaded.path_strokes)
    else {
        return Ok(());
    };
    let first_new = buffers.cluster_list.len();
    let appends = !moved_parts.is_empty();
    if appends {
        let packed = Packed::of(&uploaded.scene, moved_parts, uploaded.packing.exact());
        let strokes = buffers.stroke_list.len();
        let index = buffers.append(&device.gpu, &mut device.memory, &packed)?;
        path_strokes.append(buffers, strokes, first_new, uploaded.scene.row_count());
        let first_point = buffers.cluster_list[first_new].first_point;
        let mut points = Patch::default();
        let mut word = first_point as usize * PointFormat::Exact.words();
        for piece in packed.exact_m.iter() {
            points.set_all(word, piece);
            word += piece.len() * PointFormat::Exact.words();
        }
        patches.add_finished(Target::Points(index), points);
        effect.moved_bytes += buffers.send_new(device, [strokes, first_new])?;
    }
    let new = first_new..buffers.cluster_list.len();
    for cluster in new.clone() {
        patches.dirty.add(cluster);
        patches.recounted.add(cluster);
    }
    buffers.count_whole_paths(patches.recounted.iter());
    for cluster in patches.clusters.iter().chain(new) {
        let reach_m = f64::from(buffers.cluster_list[cluster].reach_m());
        uploaded.facts.reach_m = uploaded.facts.reach_m.max(reach_m);
    }
    uploaded.facts.clusters = buffers.cluster_list.len() as u32;
    effect.moved_bytes += patches.send(buffers, &mut uploaded.patcher, device)?;
    if appends {
        uploaded.write_dispatches(device)?;
        effect.replaces_buffers = true;
    }
    effect.dirty.join(&patches.dirty);
    Ok(())
}
