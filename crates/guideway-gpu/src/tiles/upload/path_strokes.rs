//! Finds the strokes of a path on the device, for edits in place.

use std::collections::HashMap;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

use super::pack::max_move_m;
use super::scene_buffers::SceneBuffers;
use crate::tiles::constants::CLUSTER_STROKES;
use crate::tiles::layouts::Stroke;

const NO_STROKE: u32 = u32::MAX;
/// Strokes of a task.
const TASK_STROKES: usize = 1 << 14;

/// Strokes of each path, and the original boxes of the clusters.
pub(crate) struct PathStrokes {
    /// The stroke of each row with exactly one.
    single: Vec<u32>,
    /// Strokes of rows with several, in the order of the sorted parts.
    several: HashMap<u32, Vec<u32>>,
    /// Box of each cluster when it was packed.
    original_boxes: Vec<[[f32; 2]; 2]>,
    /// Points of the device that no stroke uses any more.
    pub(crate) unused_points: usize,
}

impl PathStrokes {
    pub(crate) fn of(buffers: &SceneBuffers, rows: usize) -> Self {
        let mut strokes = Self {
            single: Vec::new(),
            several: HashMap::new(),
            original_boxes: Vec::new(),
            unused_points: 0,
        };
        // Whole paths have one stroke each: tasks write different rows.
        let single: Vec<AtomicU32> = (0..rows).map(|_| AtomicU32::new(NO_STROKE)).collect();
        let all = buffers.stroke_list.par_iter().with_min_len(TASK_STROKES);
        all.enumerate().for_each(|(index, stroke)| {
            if stroke.is_whole_path() {
                let row = buffers.ranks.row(stroke.rank);
                single[row as usize].store(index as u32, Relaxed);
            }
        });
        strokes.single = single.into_iter().map(AtomicU32::into_inner).collect();
        let parts = (0..).zip(&buffers.stroke_list);
        strokes.add(buffers, parts.filter(|(_, stroke)| !stroke.is_whole_path()));
        let place = |stroke: &u32| buffers.place(cluster_of(buffers, *stroke));
        let several = strokes.several.values_mut();
        several.for_each(|strokes| strokes.sort_by_key(place));
        strokes.add_boxes(buffers, 0);
        strokes
    }

    /// Adds the strokes and clusters from these indices on.
    pub(crate) fn append(
        &mut self,
        buffers: &SceneBuffers,
        first_stroke: usize,
        first_cluster: usize,
        rows: usize,
    ) {
        self.single.resize(rows, NO_STROKE);
        let new = (0..).zip(&buffers.stroke_list).skip(first_stroke);
        self.add(buffers, new);
        self.add_boxes(buffers, first_cluster);
    }

    fn add<'a>(
        &mut self,
        buffers: &SceneBuffers,
        strokes: impl Iterator<Item = (u32, &'a Stroke)>,
    ) {
        for (index, stroke) in strokes {
            let row = buffers.ranks.row(stroke.rank);
            let single = &mut self.single[row as usize];
            if *single == NO_STROKE {
                *single = index;
            } else {
                let several = self.several.entry(row).or_insert_with(|| vec![*single]);
                several.push(index);
            }
        }
    }

    fn add_boxes(&mut self, buffers: &SceneBuffers, first_cluster: usize) {
        let clusters = buffers.cluster_list[first_cluster..].iter();
        let boxes = clusters.map(|c| [c.low_m, c.high_m]);
        self.original_boxes.extend(boxes);
    }

    /// Strokes of a row, in the order of its sorted parts.
    pub(crate) fn strokes(&self, row: u32) -> &[u32] {
        match self.several.get(&row) {
            Some(strokes) => strokes,
            None => match self.single.get(row as usize) {
                Some(single) if *single != NO_STROKE => std::slice::from_ref(single),
                _ => &[],
            },
        }
    }

    /// Removes the strokes of a row. Their points become unused.
    pub(crate) fn remove(&mut self, buffers: &SceneBuffers, row: u32) {
        let capacities = self
            .strokes(row)
            .iter()
            .map(|&stroke| stroke_capacity(buffers, stroke) as usize);
        self.unused_points += capacities.sum::<usize>();
        self.several.remove(&row);
        if let Some(single) = self.single.get_mut(row as usize) {
            *single = NO_STROKE;
        }
    }

    /// Returns `true` if a point may move there within its cluster.
    pub(crate) fn may_hold(&self, cluster: usize, [x, y]: [f32; 2]) -> bool {
        let [low, high] = self.original_boxes[cluster];
        let is_near = |v: f32, axis: usize| {
            let margin = max_move_m(f64::from(high[axis] - low[axis])) as f32;
            v >= low[axis] - margin && v <= high[axis] + margin
        };
        is_near(x, 0) && is_near(y, 1)
    }
}

/// The cluster of a stroke.
pub(crate) fn cluster_of(buffers: &SceneBuffers, stroke: u32) -> usize {
    let clusters = &buffers.cluster_list;
    // Nearly all clusters before it are full, and none holds more.
    let mut first = (stroke / CLUSTER_STROKES) as usize;
    let (mut end, mut step) = (first + 1, 1);
    while clusters.get(end).is_some_and(|c| c.first_stroke <= stroke) {
        (first, end, step) = (end, end + step, 2 * step);
    }
    let near = &clusters[first..end.min(clusters.len())];
    first + near.partition_point(|c| c.first_stroke <= stroke) - 1
}

/// Number of points that fit in the place of a stroke.
pub(crate) fn stroke_capacity(buffers: &SceneBuffers, stroke: u32) -> u32 {
    let cluster = &buffers.cluster_list[cluster_of(buffers, stroke)];
    let first = buffers.stroke_list[stroke as usize].first_point();
    let next = stroke + 1;
    let end = if next < cluster.first_stroke + cluster.strokes {
        buffers.stroke_list[next as usize].first_point()
    } else {
        cluster.points
    };
    end - first
}
