//! Shows the paths of a gesture where its map leaves them: whole clusters are mapped, and their
//! points stay. Paths that share a cluster with others get clusters of their own until the end.
//!
//! ```text
//!   before      clusters | A: all selected | B: some selected | C: none |
//!   meanwhile   clusters | A: mapped       | B: these hidden  | C       | D: those of B, mapped |
//! ```

use std::collections::HashSet;
use std::ops::Range;

use guideway_scene::cluster::DirtyClusters;
use guideway_scene::{Gesture, GesturePaths, RenderError, Scene};
use guideway_spline::Affine;
use rayon::prelude::*;

use super::edit_effect::EditEffect;
use super::edit_patches::STROKE_WORDS;
use super::pack::Packed;
use super::path_parts::{PathPart, parts_of};
use super::path_strokes::{PathStrokes, cluster_of};
use super::point_buffer::ViewDistance;
use super::scene_buffers::SceneBuffers;
use super::shown_gesture::ShownGesture;
use super::uploaded_scene::UploadedScene;
use crate::device::{Patcher, SET_BIT};
use crate::tiles::cache::picture_cache::DirtyArea;
use crate::tiles::constants::HIDDEN_STROKE;
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::layouts::{Cluster, PointFormat};

/// Paths of a gesture by the clusters that hold them.
#[derive(Default)]
struct Selection {
    /// Clusters that draw no other path.
    whole: Vec<usize>,
    /// Paths of one stroke in another cluster, and the strokes: neighbors side by side.
    split: Vec<PathPart>,
    split_strokes: Vec<u32>,
    /// Other paths with a stroke there; some occur several times.
    split_several: Vec<u32>,
}

impl Selection {
    fn of(buffers: &SceneBuffers, is_selected: &[bool]) -> Self {
        let all = buffers.cluster_list.len();
        let tasks = (0..all).into_par_iter().step_by(TASK_CLUSTERS);
        let of_task = |first| {
            let mut selection = Self::default();
            for index in first..all.min(first + TASK_CLUSTERS) {
                selection.add(buffers, is_selected, index);
            }
            selection
        };
        let tasks: Vec<Self> = tasks.map(of_task).collect();
        let split = tasks.iter().map(|task| task.split.len()).sum();
        let mut selection = Self {
            split: Vec::with_capacity(split),
            split_strokes: Vec::with_capacity(split),
            ..Self::default()
        };
        for mut of_task in tasks {
            selection.whole.append(&mut of_task.whole);
            selection.split.append(&mut of_task.split);
            selection.split_strokes.append(&mut of_task.split_strokes);
            selection.split_several.append(&mut of_task.split_several);
        }
        selection
    }

    /// Adds the selected paths of a cluster.
    fn add(&mut self, buffers: &SceneBuffers, is_selected: &[bool], index: usize) {
        let cluster = &buffers.cluster_list[index];
        let [first, first_several] = [self.split.len(), self.split_several.len()];
        let mut drawn = 0;
        for number in cluster.first_stroke..cluster.first_stroke + cluster.strokes {
            if !buffers.is_drawn(number) {
                continue;
            }
            drawn += 1;
            let stroke = buffers.stroke_list[number as usize];
            let row = buffers.ranks.row(stroke.rank);
            if !is_selected[row as usize] {
                continue;
            }
            if stroke.is_whole_path() {
                self.split.push(PathPart::of_whole(row, stroke));
                self.split_strokes.push(number);
            } else {
                self.split_several.push(row);
            }
        }
        let selected = self.split.len() - first + self.split_several.len() - first_several;
        if drawn > 0 && selected == drawn {
            self.whole.push(index);
            self.split.truncate(first);
            self.split_strokes.truncate(first);
            self.split_several.truncate(first_several);
        }
    }

    /// Adds the parts and strokes of the paths of several strokes to the others.
    fn join_several(&mut self, scene: &Scene, buffers: &SceneBuffers, strokes: &PathStrokes) {
        let mut known = HashSet::new();
        self.split_several.retain(|path| known.insert(*path));
        let parts = parts_of(scene, &buffers.ranks, &self.split_several);
        self.split.extend(parts);
        let strokes = self
            .split_several
            .iter()
            .flat_map(|&path| strokes.strokes(path));
        let drawn = strokes.copied().filter(|stroke| buffers.is_drawn(*stroke));
        self.split_strokes.extend(drawn);
    }
}

/// Clusters and strokes that a task looks at: some 20 microseconds of work.
const TASK_CLUSTERS: usize = 64;
const TASK_STROKES: usize = 1 << 12;

/// Begins a gesture: its clusters are ready to be mapped. After an error
/// `UploadedScene::is_incomplete` is set if buffers have changed.
pub(crate) fn begin(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
    gesture: &Gesture,
) -> Result<EditEffect, RenderError> {
    let mut effect = EditEffect::default();
    let scene = &uploaded.scene;
    let paths = GesturePaths::begin(scene, gesture).map_err(RenderError::Edit)?;
    paths.check(gesture.by).map_err(RenderError::Edit)?;
    let Some(buffers) = &mut uploaded.buffers else {
        return Ok(effect);
    };
    let mut is_selected = vec![false; scene.row_count()];
    for &path in gesture.paths.iter() {
        if let Some(is_selected) = is_selected.get_mut(path as usize) {
            *is_selected = true;
        }
    }
    let mut selection = Selection::of(buffers, &is_selected);
    if !uploaded.multi_stroke_paths.is_empty() {
        // Later it would find the strokes of the gesture, too.
        let rows = scene.row_count();
        let path_strokes = &mut uploaded.path_strokes;
        let strokes = path_strokes.get_or_insert_with(|| PathStrokes::of(buffers, rows));
        selection.join_several(scene, buffers, strokes);
    }
    let packed = Packed::of_sorted(scene, &selection.split, uploaded.packing.exact());
    let [clusters, strokes] = [buffers.cluster_list.len(), buffers.stroke_list.len()];
    let point_buffers = buffers.point_buffers.len();
    effect.moved_bytes += PointFormat::Exact.bytes(packed.exact_m.len() as u32);
    buffers.append_apart(&device.gpu, &mut device.memory, packed)?;
    uploaded.is_incomplete = true;
    buffers.hidden.grow(strokes);
    let hidden = selection.split_strokes;
    effect.dirty = set_hidden(buffers, &hidden, true);
    let own = clusters..buffers.cluster_list.len();
    buffers.count_whole_paths(effect.dirty.iter().chain(own.clone()));
    let mapped = selection.whole.into_iter().chain(own.clone());
    let at_rest = mapped.map(|index| (index, buffers.cluster_list[index]));
    let at_rest: Vec<_> = at_rest.collect();
    let mut shown_area = DirtyArea::default();
    at_rest
        .iter()
        .for_each(|(_, cluster)| shown_area.add(cluster));
    let shown = ShownGesture {
        paths,
        by: Affine::IDENTITY,
        is_selected,
        at_rest,
        shown_area,
        hidden,
        clusters,
        strokes,
        point_buffers,
        facts: uploaded.facts,
    };
    if !own.is_empty() {
        effect.moved_bytes += buffers.send_new(device, [strokes, clusters])?;
        effect.replaces_buffers = true;
    }
    uploaded.facts.clusters = buffers.cluster_list.len() as u32;
    let entries: Vec<u32> = shown.hidden.iter().map(|stroke| stroke | SET_BIT).collect();
    effect.moved_bytes += flag_strokes(buffers, &mut uploaded.patcher, device, entries)?;
    if effect.replaces_buffers {
        uploaded.write_dispatches(device)?;
    }
    uploaded.gesture = Some(shown);
    uploaded.is_incomplete = false;
    Ok(effect)
}

/// Clusters that one thread maps at a time: some 20 microseconds of work.
const MAPPED_CHUNK: usize = 1024;

/// Some clusters of a gesture after its map, and what is known of them.
struct MappedChunk {
    clusters: Vec<Cluster>,
    area: DirtyArea,
    reach_m: f64,
    greatest_step_m: f32,
}

impl MappedChunk {
    fn of(at_rest: &[(usize, Cluster)], by: Affine) -> Self {
        let clusters = at_rest.iter().map(|(_, cluster)| cluster.mapped(by));
        let mut chunk = Self {
            clusters: clusters.collect(),
            area: DirtyArea::default(),
            reach_m: 0.0,
            greatest_step_m: 0.0,
        };
        for cluster in &chunk.clusters {
            chunk.area.add(cluster);
            chunk.reach_m = chunk.reach_m.max(f64::from(cluster.reach_m()));
            chunk.greatest_step_m = chunk.greatest_step_m.max(cluster.step_m);
        }
        chunk
    }
}

/// Shows the paths of the gesture where a map leaves them. The caller marks the mapped clusters as
/// dirty before, where they were, and after, where they are.
pub(crate) fn map(
    uploaded: &mut UploadedScene,
    device: &DeviceContext,
    by: Affine,
) -> Result<EditEffect, RenderError> {
    let mut effect = EditEffect::default();
    let (Some(gesture), Some(buffers)) = (&mut uploaded.gesture, &mut uploaded.buffers) else {
        return Ok(effect);
    };
    gesture.paths.check(by).map_err(RenderError::Edit)?;
    let turned = gesture.turns();
    gesture.by = by;
    let facts = &mut uploaded.facts;
    let step_before_m = facts.greatest_step_m;
    (facts.reach_m, facts.greatest_step_m) = (gesture.facts.reach_m, gesture.facts.greatest_step_m);
    facts.map = [by.x, by.y].map(|v| [v.x as f32, v.y as f32]);
    let chunks = gesture.at_rest.par_chunks(MAPPED_CHUNK);
    let mapped: Vec<MappedChunk> = chunks.map(|chunk| MappedChunk::of(chunk, by)).collect();
    gesture.shown_area = DirtyArea::default();
    let mut at_rest = gesture.at_rest.iter();
    for chunk in mapped {
        gesture.shown_area.join(chunk.area);
        facts.reach_m = facts.reach_m.max(chunk.reach_m);
        facts.greatest_step_m = facts.greatest_step_m.max(chunk.greatest_step_m);
        for (cluster, (index, _)) in chunk.clusters.into_iter().zip(at_rest.by_ref()) {
            buffers.cluster_list[*index] = cluster;
        }
    }
    // Plans hold the distance of each buffer, and the kernels.
    effect.replaces_buffers = turned != gesture.turns() || step_before_m != facts.greatest_step_m;
    if let Some(exact) = &mut buffers.exact_points {
        let max_step_m = facts.greatest_step_m;
        exact.buffer.distance = ViewDistance::Near { max_step_m };
    }
    let range = gesture.mapped_range();
    effect.moved_bytes = write_clusters(uploaded, device, range)?;
    Ok(effect)
}

/// Ends the gesture, if there is one: the buffers are as before. The caller marks the mapped
/// clusters as dirty before.
pub(crate) fn end(
    uploaded: &mut UploadedScene,
    device: &mut DeviceContext,
) -> Result<EditEffect, RenderError> {
    let mut effect = EditEffect::default();
    let (Some(gesture), Some(buffers)) = (uploaded.gesture.take(), &mut uploaded.buffers) else {
        return Ok(effect);
    };
    uploaded.is_incomplete = true;
    uploaded.facts = gesture.facts;
    let has_own = buffers.cluster_list.len() > gesture.clusters;
    effect.replaces_buffers = has_own || gesture.turns();
    effect.loses_lines = has_own;
    for (index, cluster) in &gesture.at_rest {
        buffers.cluster_list[*index] = *cluster;
        if *index < gesture.clusters {
            effect.dirty.add(*index);
        }
    }
    buffers.cluster_list.truncate(gesture.clusters);
    buffers.stroke_list.truncate(gesture.strokes);
    buffers.point_buffers.truncate(gesture.point_buffers);
    effect
        .dirty
        .join(&set_hidden(buffers, &gesture.hidden, false));
    if has_own {
        // They have the points of other clusters, too.
        buffers.exact_points = None;
    }
    buffers.count_whole_paths(effect.dirty.iter());
    let patcher = &mut uploaded.patcher;
    effect.moved_bytes += flag_strokes(buffers, patcher, device, gesture.hidden.clone())?;
    let range = gesture.mapped_range();
    let range = range.start..range.end.min(gesture.clusters);
    effect.moved_bytes += write_clusters(uploaded, device, range)?;
    uploaded.is_incomplete = false;
    Ok(effect)
}

/// Notes that strokes are hidden or shown, by all threads. Returns their clusters.
fn set_hidden(buffers: &SceneBuffers, strokes: &[u32], is_hidden: bool) -> DirtyClusters {
    let of_task = |strokes: &[u32]| {
        let mut dirty = DirtyClusters::default();
        for &stroke in strokes {
            buffers.hidden.set(stroke, is_hidden);
            dirty.add(cluster_of(buffers, stroke));
        }
        dirty
    };
    let mut all = DirtyClusters::default();
    let tasks = strokes.par_chunks(TASK_STROKES).map(of_task);
    for dirty in tasks.collect::<Vec<_>>() {
        all.join(&dirty);
    }
    all
}

/// Hides or shows strokes on the device. Returns the bytes sent.
fn flag_strokes(
    buffers: &SceneBuffers,
    patcher: &mut Option<Patcher>,
    device: &mut DeviceContext,
    entries: Vec<u32>,
) -> Result<u64, RenderError> {
    let bytes = size_of_val(entries.as_slice()) as u64;
    let (patcher, target) = device.patch(patcher, &buffers.strokes)?;
    patcher.set_bits(target, STROKE_WORDS, HIDDEN_STROKE, &[entries])?;
    Ok(bytes)
}

/// Writes a range of clusters. Returns its bytes.
fn write_clusters(
    uploaded: &mut UploadedScene,
    device: &DeviceContext,
    range: Range<usize>,
) -> Result<u64, RenderError> {
    let Some(buffers) = uploaded.buffers.as_ref().filter(|_| !range.is_empty()) else {
        return Ok(0);
    };
    uploaded.is_incomplete = true;
    let first = range.start as u32;
    let list = &buffers.cluster_list[range];
    let runner = &device.runner;
    let written = runner.write_at("the clusters", &buffers.clusters, first, list);
    written.map_err(device_error)?;
    let bytes = size_of_val(list) as u64;
    uploaded.is_incomplete = false;
    Ok(bytes)
}
