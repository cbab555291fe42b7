//! Edits many paths by all threads: each task rewrites the changed strokes of some clusters.
//!
//! ```text
//!   changed rows         3    8    17
//!   row of each stroke   - 8 - - 3 - | - - 17 - - -      one table, filled by row
//!   clusters             |    0      |     1      |      a task each: strokes, points and boxes
//! ```
//!
//! Paths of several strokes, and those that leave the place of their stroke, are for the caller.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use guideway_scene::{PathState, Scene};
use rayon::prelude::*;

use super::cluster::ClusterOrigin;
use super::draw_ranks::DrawRanks;
use super::edit_patches::{EditPatches, STROKE_WORDS, Target};
use super::exact_points::ExactPoints;
use super::path_parts::PathPart;
use super::path_strokes::PathStrokes;
use super::point_buffer::PointBuffer;
use super::scene_buffers::SceneBuffers;
use crate::device::Patch;
use crate::tiles::layouts::{Cluster, PointFormat, Stroke};

/// Changed paths from which on all threads share the work.
pub(crate) const MIN_PATHS: usize = 1 << 12;
/// Paths, and clusters, of a task: some 50 microseconds of work.
const TASK_PATHS: usize = 1 << 14;
const TASK_CLUSTERS: usize = 16;
/// A stroke whose path has not changed.
const UNCHANGED: u32 = u32::MAX;

/// The scene that tasks read.
pub(crate) struct EditedScene<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) path_strokes: &'a PathStrokes,
    /// Returns `true` if the strokes of a row say too little of it.
    pub(crate) is_special: &'a (dyn Fn(u32) -> bool + Sync),
    /// True if the curves of the rows are new, otherwise their states.
    pub(crate) are_new: bool,
}

/// Rewrites the strokes of changed rows. Returns the rows that are still to be written.
pub(crate) fn rewrite(
    edited: &EditedScene<'_>,
    buffers: &mut SceneBuffers,
    rows: &[u32],
    patches: &mut EditPatches,
) -> Vec<u32> {
    let unchanged = (0..buffers.stroke_list.len()).map(|_| AtomicU32::new(UNCHANGED));
    let row_of_stroke: Vec<AtomicU32> = unchanged.collect();
    let mark = |rows: &[u32]| {
        let mut others = Vec::new();
        for &row in rows {
            match edited.stroke_to_rewrite(row) {
                Some(stroke) => row_of_stroke[stroke as usize].store(row, Relaxed),
                None => others.push(row),
            }
        }
        others
    };
    let others = rows.par_chunks(TASK_PATHS).map(mark);
    let mut others = others.collect::<Vec<_>>().concat();
    let SceneBuffers {
        stroke_list,
        cluster_list,
        point_buffers,
        exact_points,
        ranks,
        ..
    } = buffers;
    let places = Places {
        edited,
        ranks,
        point_buffers,
        exact_points: exact_points.as_ref(),
    };
    let tasks: Vec<_> = tasks(stroke_list, cluster_list, &row_of_stroke).collect();
    let written = tasks.into_par_iter().map(|task| task.run(&places));
    for task in written.collect::<Vec<_>>() {
        patches.add_finished(Target::Strokes, task.strokes);
        for (target, patch) in task.points {
            patches.add_finished(target, patch);
        }
        for cluster in task.dirty {
            patches.dirty.add(cluster);
            if edited.are_new {
                patches.clusters.add(cluster);
            }
        }
        others.extend(task.others);
    }
    others
}

impl EditedScene<'_> {
    /// The only stroke of a row, if that can be rewritten in its place.
    fn stroke_to_rewrite(&self, row: u32) -> Option<u32> {
        let is_hidden = self.are_new && self.scene.state(row) != PathState::Shown;
        match is_hidden || (self.is_special)(row) {
            true => None,
            false => self.path_strokes.only_stroke(row),
        }
    }
}

/// Ranks and points of the strokes.
struct Places<'a> {
    edited: &'a EditedScene<'a>,
    ranks: &'a DrawRanks,
    point_buffers: &'a [PointBuffer],
    exact_points: Option<&'a ExactPoints>,
}

/// Some clusters and their strokes.
struct Task<'a> {
    first_cluster: usize,
    clusters: &'a mut [Cluster],
    strokes: &'a mut [Stroke],
    /// Row of each stroke, or `UNCHANGED`.
    rows: &'a [AtomicU32],
}

/// Splits clusters and strokes into tasks.
fn tasks<'a>(
    mut strokes: &'a mut [Stroke],
    clusters: &'a mut [Cluster],
    mut rows: &'a [AtomicU32],
) -> impl Iterator<Item = Task<'a>> {
    let chunks = clusters.chunks_mut(TASK_CLUSTERS);
    (0..)
        .step_by(TASK_CLUSTERS)
        .zip(chunks)
        .map(move |(first_cluster, clusters)| {
            let count: usize = clusters
                .iter()
                .map(|cluster| cluster.strokes as usize)
                .sum();
            let (own, others) = std::mem::take(&mut strokes).split_at_mut(count);
            let (own_rows, other_rows) = rows.split_at(count);
            (strokes, rows) = (others, other_rows);
            Task {
                first_cluster,
                clusters,
                strokes: own,
                rows: own_rows,
            }
        })
}

/// Changes that a task has made.
#[derive(Default)]
struct Written {
    strokes: Patch,
    points: BTreeMap<Target, Patch>,
    /// Clusters with changed curves.
    dirty: Vec<usize>,
    /// Rows that do not fit in their place.
    others: Vec<u32>,
}

impl Task<'_> {
    fn run(self, places: &Places<'_>) -> Written {
        let mut written = Written::default();
        let (mut parts, mut points_m) = (Vec::new(), Vec::new());
        let (mut strokes, mut rows) = (self.strokes, self.rows);
        for (index, cluster) in (self.first_cluster..).zip(self.clusters) {
            let count = cluster.strokes as usize;
            let (own, others) = std::mem::take(&mut strokes).split_at_mut(count);
            let (own_rows, other_rows) = rows.split_at(count);
            (strokes, rows) = (others, other_rows);
            let mut is_dirty = false;
            for (number, row) in own_rows.iter().enumerate() {
                let row = row.load(Relaxed);
                if row == UNCHANGED {
                    continue;
                }
                let old = own[number];
                let new = match places.new_part(row, &mut parts) {
                    NewPart::Hidden => Stroke {
                        extent: old.first_point(),
                        ..old
                    },
                    NewPart::Shown(part) => part.stroke(old.first_point()),
                    NewPart::Several => {
                        written.others.push(row);
                        continue;
                    }
                };
                if places.edited.are_new {
                    let next = own.get(number + 1).map(|next| next.first_point());
                    let end = next.unwrap_or(cluster.points);
                    let capacity = end - old.first_point();
                    let Some(part) = parts.first().filter(|_| new.points() == capacity) else {
                        written.others.push(row);
                        continue;
                    };
                    if !places.fits(part, index, cluster, &mut points_m) {
                        written.others.push(row);
                        continue;
                    }
                    let first_point = old.first_point();
                    let place = (index, &mut *cluster);
                    places.write(&points_m, first_point, place, &mut written.points);
                    is_dirty = true;
                }
                if new != old {
                    own[number] = new;
                    let stroke = cluster.first_stroke as usize + number;
                    written.strokes.set(stroke * STROKE_WORDS, &new);
                    is_dirty = true;
                }
            }
            if is_dirty {
                written.dirty.push(index);
            }
        }
        written
    }
}

/// A path after the edit.
enum NewPart {
    Hidden,
    /// A single part.
    Shown(PathPart),
    Several,
}

impl Places<'_> {
    /// Fills `parts` with the parts of a path.
    fn new_part(&self, row: u32, parts: &mut Vec<PathPart>) -> NewPart {
        parts.clear();
        let scene = self.edited.scene;
        if scene.state(row) != PathState::Shown {
            return NewPart::Hidden;
        }
        let Some(rank) = self.ranks.rank(row) else {
            return NewPart::Several;
        };
        PathPart::of_path(scene.layout(), row, rank, parts);
        match parts.as_slice() {
            [part] => NewPart::Shown(*part),
            _ => NewPart::Several,
        }
    }

    /// Returns `true` if a part fits in its cluster. Fills `points_m` with its points.
    fn fits(
        &self,
        part: &PathPart,
        index: usize,
        cluster: &Cluster,
        points_m: &mut Vec<[f32; 2]>,
    ) -> bool {
        let origin = ClusterOrigin::of(cluster);
        points_m.clear();
        let points = part.points(self.edited.scene.layout());
        points_m.extend(points.map(|p| origin.local_m(p)));
        let path_strokes = self.edited.path_strokes;
        points_m.iter().all(|&p| path_strokes.may_hold(index, p))
    }

    /// Writes the points of a stroke in the place of its old ones.
    fn write(
        &self,
        points_m: &[[f32; 2]],
        first_point: u32,
        (index, cluster): (usize, &mut Cluster),
        patches: &mut BTreeMap<Target, Patch>,
    ) {
        points_m.iter().for_each(|&p| cluster.include(p));
        let index = index as u32;
        let buffers = self.point_buffers;
        let buffer = buffers.partition_point(|b| b.clusters.end <= index);
        let format = cluster.format();
        let patch = patches.entry(Target::Points(buffer)).or_default();
        let word = (cluster.first_point + first_point) as usize * format.words();
        match format {
            PointFormat::Rounded => {
                let quantized = points_m.iter().map(|&p| cluster.quantize(p));
                patch.set_each(word, quantized);
            }
            PointFormat::Exact => patch.set_all(word, points_m),
        }
        let exact = self.exact_points.and_then(|exact| exact.first_point(index));
        if let Some(first) = exact {
            let patch = patches.entry(Target::ExactPoints).or_default();
            let word = (first + first_point) as usize * PointFormat::Exact.words();
            patch.set_all(word, points_m);
        }
    }
}
