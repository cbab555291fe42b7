//! Applies an edit to the scene and its buffers: in place where strokes keep their size and place,
//! otherwise in clusters appended to the end.

use std::borrow::Cow;
use std::sync::Arc;

use guideway_layout::Layout;
use guideway_scene::{Edit, PathState, RenderError};

use super::bulk_edit::{self, EditedScene};
use super::cluster::ClusterOrigin;
use super::edit_patches::{EditPatches, Target};
use super::pack::Packed;
use super::path_parts::PathPart;
use super::path_strokes::{PathStrokes, cluster_of, stroke_capacity};
use super::scene_buffers::SceneBuffers;
use super::style_changes::StyleChanges;
use super::uploaded_scene::UploadedScene;
use crate::tiles::device_context::DeviceContext;
use crate::tiles::layouts::PointFormat;
use guideway_scene::cluster::DirtyClusters;

/// Unused points from which on the scene is packed again: this many, or a quarter of all points.
const MAX_UNUSED_POINTS: usize = 1 << 16;

/// Paths with new curves from which on the scene is packed again: this many, and this part of all
/// strokes.
const MIN_PACKED_PATHS: usize = 1 << 16;
const PACKED_PART: usize = 4;

/// Result of an edit.
pub(crate) enum SceneBufferEdit {
    /// The buffers are up to date.
    Applied(EditEffect),
    /// The scene must be uploaded again.
    NeedsUpload,
}

/// Consequences of an applied edit for cached frames.
#[derive(Default)]
pub(crate) struct EditEffect {
    /// Bytes sent to the device.
    pub(crate) moved_bytes: u64,
    /// Clusters with changed curves.
    pub(crate) dirty: DirtyClusters,
    /// The edit changed how all paths look.
    pub(crate) changes_appearance: bool,
    /// Line blocks of clusters are lost.
    pub(crate) loses_lines: bool,
    /// Bind groups refer to replaced buffers.
    pub(crate) replaces_buffers: bool,
}

/// Applies an edit. After an error `UploadedScene::is_incomplete` is set.
pub(crate) fn apply(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    edit: &Edit,
) -> Result<SceneBufferEdit, RenderError> {
    let first_new = uploaded.scene.row_count() as u32;
    let scene = Arc::make_mut(&mut uploaded.scene);
    scene.edit(edit).map_err(RenderError::Edit)?;
    if matches!(edit, Edit::Tables(_)) {
        return Ok(SceneBufferEdit::Applied(EditEffect::default()));
    }
    uploaded.is_incomplete = true;
    let new_rows = first_new..uploaded.scene.row_count() as u32;
    let rows: Vec<u32> = edit.paths().chain(new_rows).collect();
    let are_new = matches!(edit, Edit::Transform { .. } | Edit::Reshape { .. });
    let mut effect = EditEffect::default();
    if !are_new {
        let before = uploaded.facts.appearance();
        uploaded.facts.refresh_appearance(&uploaded.scene);
        effect.changes_appearance =
            matches!(edit, Edit::Restyle(_)) || uploaded.facts.appearance() != before;
    }
    let has_ranks =
        |buffers: &SceneBuffers| rows.iter().all(|&row| buffers.ranks.rank(row).is_some());
    if !uploaded.buffers.as_ref().is_some_and(has_ranks) {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    let has_styles = |buffers: &SceneBuffers| {
        let styles = buffers.style_count as usize;
        styles > 1 && !uploaded.facts.is_plain && styles == buffers.ranks.count(&uploaded.scene)
    };
    // A state does not change a style, but may change whether all paths share one.
    let keeps_styles = are_new
        || matches!(edit, Edit::SetStates(_)) && uploaded.buffers.as_ref().is_some_and(has_styles);
    if !keeps_styles {
        write_styles(uploaded, device, &rows, &mut effect)?;
    }
    let is_written = matches!(edit, Edit::Restyle(_))
        || write_curves(uploaded, device, (&rows, are_new), &mut effect)?;
    if !is_written {
        return Ok(SceneBufferEdit::NeedsUpload);
    }
    uploaded.is_incomplete = false;
    Ok(SceneBufferEdit::Applied(effect))
}

/// Writes colors and widths of rows.
fn write_styles(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    rows: &[u32],
    effect: &mut EditEffect,
) -> Result<(), RenderError> {
    let scene = &uploaded.scene;
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(());
    };
    let (count, of_all) = (buffers.style_count as usize, buffers.ranks.count(scene));
    // The styles of all paths stay when the paths look alike again: nothing reads them then.
    let uploads_all = count != of_all || of_all == 1;
    if uploads_all {
        effect.moved_bytes += buffers.upload_styles(&device.gpu, &mut device.memory, scene)?;
        uploaded.facts.styles = buffers.style_count;
        effect.replaces_buffers = true;
    }
    let path_strokes = uploaded
        .path_strokes
        .get_or_insert_with(|| PathStrokes::of(buffers, scene.row_count()));
    let changed = StyleChanges::of_all(scene, buffers, path_strokes, rows);
    let mut patches = EditPatches::default();
    for changed in changed {
        if !uploads_all {
            patches.add_finished(Target::Styles, changed.patch);
        }
        for (cluster, width_m) in changed.wider {
            let widest_m = &mut buffers.cluster_list[cluster].widest_m;
            *widest_m = widest_m.max(width_m);
            patches.clusters.add(cluster);
        }
    }
    send(uploaded, device, patches, Vec::new(), effect)
}

/// Writes curves of rows: new ones, or those that are shown or hidden. `false` if the scene had
/// better be packed anew.
fn write_curves(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    (rows, are_new): (&[u32], bool),
    effect: &mut EditEffect,
) -> Result<bool, RenderError> {
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(false);
    };
    let scene = &uploaded.scene;
    let path_strokes = uploaded
        .path_strokes
        .get_or_insert_with(|| PathStrokes::of(buffers, scene.row_count()));
    let mut patches = EditPatches::default();
    let most = MIN_PACKED_PATHS.max(buffers.stroke_list.len() / PACKED_PART);
    if are_new && rows.len() >= most {
        return Ok(false);
    }
    let mut rows = Cow::Borrowed(rows);
    if rows.len() >= bulk_edit::MIN_PATHS {
        let (several, hidden) = (&uploaded.multi_stroke_paths, &uploaded.hidden_edits);
        let edited = EditedScene {
            scene,
            path_strokes,
            is_special: &|row| several.contains(&row) || hidden.contains(&row),
            are_new,
        };
        rows = bulk_edit::rewrite(&edited, buffers, &rows, &mut patches).into();
    }
    let mut moved_parts = Vec::new();
    let mut parts = Vec::new();
    let mut scratch = Vec::new();
    for &row in rows.iter() {
        parts.clear();
        if scene.state(row) == PathState::Shown
            && let Some(rank) = buffers.ranks.rank(row)
        {
            PathPart::of_path(scene.layout(), row, rank, &mut parts);
        }
        if parts.len() > 1 {
            uploaded.multi_stroke_paths.insert(row);
            uploaded.packing.sort(scene.layout(), &mut parts);
        } else if !uploaded.multi_stroke_paths.is_empty() {
            uploaded.multi_stroke_paths.remove(&row);
        }
        let strokes = path_strokes.strokes(row);
        let layout = scene.layout();
        let hidden_edits = &mut uploaded.hidden_edits;
        if are_new && parts.is_empty() {
            hidden_edits.insert(row);
        }
        let has_points = !parts.is_empty() && !hidden_edits.remove(&row);
        if has_points && !are_new && parts.len() == strokes.len() {
            show_again(buffers, &parts, strokes, &mut patches);
            continue;
        }
        if fits_in_place(buffers, path_strokes, layout, &parts, strokes, &mut scratch) {
            write_in_place(buffers, &parts, strokes, &scratch, &mut patches);
            continue;
        }
        for &stroke in strokes {
            let hidden = &mut buffers.stroke_list[stroke as usize];
            hidden.extent = hidden.first_point();
            patches.strokes.push(stroke);
            patches.dirty.add(cluster_of(buffers, stroke));
        }
        if !parts.is_empty() {
            path_strokes.remove(buffers, row);
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
    let mut is_uploaded = false;
    let appends = !moved_parts.is_empty();
    if appends {
        let packed = Packed::of(&uploaded.scene, moved_parts, uploaded.packing.exact());
        let (strokes, clusters) = (buffers.stroke_list.len(), buffers.cluster_list.len());
        let index = buffers.append(&device.gpu, &mut device.memory, &packed)?;
        path_strokes.append(buffers, strokes, clusters, uploaded.scene.row_count());
        let first_point = buffers.cluster_list[clusters].first_point;
        let points = packed.exact_m.into_iter();
        patches.set_points(Target::Points(index), first_point, points);
        is_uploaded = buffers.grow(&device.gpu, &mut device.memory)?;
        let new_strokes = strokes as u32..buffers.stroke_list.len() as u32;
        patches.strokes.extend(new_strokes);
        for cluster in clusters..buffers.cluster_list.len() {
            patches.clusters.add(cluster);
            patches.dirty.add(cluster);
        }
    }
    buffers.count_whole_paths(patches.dirty.iter());
    for cluster in patches.clusters.iter() {
        let reach_m = f64::from(buffers.cluster_list[cluster].reach_m());
        uploaded.facts.reach_m = uploaded.facts.reach_m.max(reach_m);
    }
    uploaded.facts.clusters = buffers.cluster_list.len() as u32;
    if is_uploaded {
        effect.moved_bytes += buffers.strokes.bytes() + buffers.clusters.bytes();
    }
    effect.moved_bytes += patches.send(buffers, &mut uploaded.patcher, device, is_uploaded)?;
    effect.loses_lines |= is_uploaded;
    if appends {
        uploaded.write_dispatches(device)?;
        effect.replaces_buffers = true;
    }
    for cluster in patches.dirty.iter() {
        effect.dirty.add(cluster);
    }
    Ok(())
}

/// Returns `true` if new parts of a path fit in the place of its strokes. Fills `points_m` with
/// their points.
fn fits_in_place(
    buffers: &SceneBuffers,
    path_strokes: &PathStrokes,
    layout: &Layout,
    parts: &[PathPart],
    strokes: &[u32],
    points_m: &mut Vec<[f32; 2]>,
) -> bool {
    if parts.is_empty() || parts.len() != strokes.len() {
        return false;
    }
    points_m.clear();
    for (part, &stroke) in parts.iter().zip(strokes) {
        let cluster = cluster_of(buffers, stroke);
        let origin = ClusterOrigin::of(&buffers.cluster_list[cluster]);
        let first = points_m.len();
        points_m.extend(part.points(layout).map(|p| origin.local_m(p)));
        let points = &points_m[first..];
        let may_hold = points.iter().all(|&p| path_strokes.may_hold(cluster, p));
        if !may_hold || stroke_capacity(buffers, stroke) as usize != points.len() {
            return false;
        }
    }
    true
}

/// Shows the strokes of a path whose points are still there.
fn show_again(
    buffers: &mut SceneBuffers,
    parts: &[PathPart],
    strokes: &[u32],
    patches: &mut EditPatches,
) {
    for (part, &stroke) in parts.iter().zip(strokes) {
        let hidden = &mut buffers.stroke_list[stroke as usize];
        let shown = part.stroke(hidden.first_point());
        if *hidden != shown {
            *hidden = shown;
            patches.strokes.push(stroke);
            patches.dirty.add(cluster_of(buffers, stroke));
        }
    }
}

/// Writes new points in the place of the old ones.
fn write_in_place(
    buffers: &mut SceneBuffers,
    parts: &[PathPart],
    strokes: &[u32],
    points_m: &[[f32; 2]],
    patches: &mut EditPatches,
) {
    let mut rest = points_m;
    for (part, &stroke) in parts.iter().zip(strokes) {
        let cluster_index = cluster_of(buffers, stroke);
        let index = cluster_index as u32;
        let point_buffers = &buffers.point_buffers;
        let buffer_index = point_buffers.partition_point(|b| b.clusters.end <= index);
        let cluster = &mut buffers.cluster_list[cluster_index];
        let old = &mut buffers.stroke_list[stroke as usize];
        let new = part.stroke(old.first_point());
        if *old != new {
            *old = new;
            patches.strokes.push(stroke);
        }
        let (points, others) = rest.split_at(new.points() as usize);
        rest = others;
        points.iter().for_each(|p| cluster.include(*p));
        let first_point = cluster.first_point + new.first_point();
        let target = Target::Points(buffer_index);
        match cluster.format() {
            PointFormat::Rounded => {
                let rounded = points.iter().map(|p| cluster.quantize(*p));
                patches.set_points(target, first_point, rounded);
            }
            PointFormat::Exact => {
                patches.set_points(target, first_point, points.iter().copied());
            }
        }
        let exact = buffers.exact_points.as_ref();
        if let Some(first) = exact.and_then(|exact| exact.first_point(index)) {
            let first_point = first + new.first_point();
            patches.set_points(Target::ExactPoints, first_point, points.iter().copied());
        }
        patches.clusters.add(cluster_index);
        patches.dirty.add(cluster_index);
    }
}
