//! Writes new curves in the place of old ones: each task converts the points of some paths.
//!
//! ```text
//!   changed rows      3    8    17 ...        a task each for some
//!   their strokes     12   90   7  ...        in clusters anywhere
//!   patch             | run: place on the device | points of 3 | run | points of 8 | ...
//! ```
//!
//! Tasks only read; the caller grows the boxes of clusters. Paths that leave the place of their
//! strokes are for the caller, too.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use guideway_scene::cluster::DirtyClusters;
use guideway_scene::{RenderError, Scene};
use rayon::prelude::*;

use super::cluster::{ClusterOrigin, LocalBox};
use super::edit_patches::{Target, send_patches};
use super::pack::Packing;
use super::path_parts::PathPart;
use super::path_strokes::{PathStrokes, cluster_of, stroke_capacity};
use super::scene_buffers::SceneBuffers;
use crate::device::{Patch, Patcher};
use crate::tiles::device_context::DeviceContext;
use crate::tiles::layouts::{PointFormat, Stroke};

/// Paths of a task: some 200 microseconds of work.
const TASK_PATHS: usize = 1 << 11;

/// The scene that tasks read.
pub(super) struct Rewriter<'a> {
    pub(super) scene: &'a Scene,
    pub(super) buffers: &'a SceneBuffers,
    pub(super) path_strokes: &'a PathStrokes,
    pub(super) packing: Packing,
    /// Empty patches with memory of earlier ones.
    pub(super) spare: &'a SparePatches,
}

/// Empty patches, for tasks to use again: fresh memory costs more than what is written to it.
pub(crate) type SparePatches = Mutex<Vec<Patch>>;
/// Most spare patches: those of one batch.
const MAX_SPARE: usize = 64;
/// Most bytes of a spare patch. Derived: a task of usual paths fills half of it.
const MAX_SPARE_BYTES: usize = 1 << 20;

/// Sends the points of tasks, and makes their patches spare. Returns the bytes sent.
pub(super) fn send_points(
    tasks: &mut [Rewritten],
    buffers: &SceneBuffers,
    patcher: &mut Option<Patcher>,
    device: &mut DeviceContext,
    spare: &SparePatches,
) -> Result<u64, RenderError> {
    let points = tasks.iter().flat_map(|task| &task.points);
    let points = points.map(|(target, patch)| (*target, patch));
    let bytes = send_patches(points, buffers, patcher, device)?;
    let mut spare = spare.lock().unwrap_or_else(PoisonError::into_inner);
    for task in tasks {
        let used = std::mem::take(&mut task.points).into_values();
        let small = used.filter(|patch| patch.capacity_bytes() <= MAX_SPARE_BYTES);
        for mut patch in small.take(MAX_SPARE.saturating_sub(spare.len())) {
            patch.clear();
            spare.push(patch);
        }
    }
    Ok(bytes)
}

/// Changes of some paths.
#[derive(Default)]
pub(super) struct Rewritten {
    pub(super) points: BTreeMap<Target, Patch>,
    /// Strokes with other flags.
    pub(super) strokes: Vec<(u32, Stroke)>,
    /// Clusters that do not hold the points of a stroke any more, and the box of these.
    pub(super) grown: Vec<(u32, LocalBox)>,
    /// Clusters with changed curves.
    pub(super) dirty: DirtyClusters,
    /// Rows that do not fit in the place of their strokes.
    pub(super) others: Vec<u32>,
}

/// Buffers that a task uses again for each path.
#[derive(Default)]
struct Scratch {
    parts: Vec<PathPart>,
    points_m: Vec<[f32; 2]>,
    /// A place per part.
    places: Vec<Place>,
}

/// The place of a part on the device.
struct Place {
    cluster: u32,
    stroke: u32,
    /// Points in `Scratch::points_m`.
    first: usize,
    end: usize,
    box_m: LocalBox,
}

impl Rewriter<'_> {
    /// Writes the curves of rows, by all threads if there are many.
    pub(super) fn run(&self, rows: &[u32]) -> Vec<Rewritten> {
        match rows.len() {
            0..=TASK_PATHS => vec![self.run_task(rows)],
            _ => rows
                .par_chunks(TASK_PATHS)
                .map(|rows| self.run_task(rows))
                .collect(),
        }
    }

    fn run_task(&self, rows: &[u32]) -> Rewritten {
        let mut written = Rewritten::default();
        let mut scratch = Scratch::default();
        for &row in rows {
            if !self.fits(row, &mut scratch) {
                written.others.push(row);
                continue;
            }
            let placed = scratch.parts.iter().zip(&scratch.places);
            for (part, place) in placed {
                let points_m = &scratch.points_m[place.first..place.end];
                self.write(part, place, points_m, (rows.len(), &mut written));
            }
        }
        written
    }

    /// Returns `true` if a path fits in the place of its strokes. Fills the buffers with its parts
    /// and their points.
    fn fits(&self, row: u32, scratch: &mut Scratch) -> bool {
        let strokes = self.path_strokes.strokes(row);
        let Some(rank) = self.buffers.ranks.rank(row) else {
            return false;
        };
        let layout = self.scene.layout();
        scratch.parts.clear();
        scratch.points_m.clear();
        scratch.places.clear();
        if !strokes.is_empty() {
            PathPart::of_path(layout, row, rank, &mut scratch.parts);
        }
        if scratch.parts.is_empty() || scratch.parts.len() != strokes.len() {
            return false;
        }
        if scratch.parts.len() > 1 {
            self.packing.sort(layout, &mut scratch.parts);
        }
        for (part, &stroke) in scratch.parts.iter().zip(strokes) {
            let cluster = cluster_of(self.buffers, stroke);
            let origin = ClusterOrigin::of(&self.buffers.cluster_list[cluster]);
            let first = scratch.points_m.len();
            part.append_local(layout, origin, &mut scratch.points_m);
            let points_m = &scratch.points_m[first..];
            let box_m = LocalBox::of(points_m);
            let may_hold = |corner| self.path_strokes.may_hold(cluster, corner);
            let capacity = stroke_capacity(self.buffers, stroke) as usize;
            if capacity != points_m.len() || !may_hold(box_m.low_m) || !may_hold(box_m.high_m) {
                return false;
            }
            scratch.places.push(Place {
                cluster: cluster as u32,
                stroke,
                first,
                end: scratch.points_m.len(),
                box_m,
            });
        }
        true
    }

    /// Writes the points of a part to its place.
    fn write(
        &self,
        part: &PathPart,
        place: &Place,
        points_m: &[[f32; 2]],
        (rows, written): (usize, &mut Rewritten),
    ) {
        let Self { buffers, .. } = self;
        let cluster = &buffers.cluster_list[place.cluster as usize];
        let old = buffers.stroke_list[place.stroke as usize];
        let new = part.stroke(old.first_point());
        if new != old {
            written.strokes.push((place.stroke, new));
        }
        let buffer = (buffers.point_buffers).partition_point(|b| b.clusters.end <= place.cluster);
        let format = cluster.format();
        let new_patch = || {
            let spare = self
                .spare
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .pop();
            let words = rows * points_m.len() * format.words();
            spare.unwrap_or_else(|| Patch::with_capacity(rows, words))
        };
        let patch = written
            .points
            .entry(Target::Points(buffer))
            .or_insert_with(new_patch);
        let word = (cluster.first_point + new.first_point()) as usize * format.words();
        match format {
            PointFormat::Rounded => {
                patch.set_each(word, points_m.iter().map(|&p| cluster.quantize(p)));
            }
            PointFormat::Exact => patch.set_all(word, points_m),
        }
        let exact = buffers.exact_points.as_ref();
        if let Some(first) = exact.and_then(|exact| exact.first_point(place.cluster)) {
            let patch = written.points.entry(Target::ExactPoints).or_default();
            let word = (first + new.first_point()) as usize * PointFormat::Exact.words();
            patch.set_all(word, points_m);
        }
        if !cluster.includes(place.box_m) {
            written.grown.push((place.cluster, place.box_m));
        }
        written.dirty.add(place.cluster as usize);
    }
}
