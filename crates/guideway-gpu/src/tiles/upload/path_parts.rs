//! Cuts paths into parts of at most 32 segments, each of which becomes one stroke.

use bytemuck::Zeroable;
use guideway_layout::{Layout, RunPoints};
use guideway_scene::Scene;
use guideway_scene::density::open_ends;
use guideway_spline::Point;
use rayon::prelude::*;

use super::cluster::ClusterOrigin;
use super::concatenated::concatenated;
use super::draw_ranks::DrawRanks;
use crate::tiles::constants::{PATH_END, PATH_START, SEGMENTS_BIT, STROKE_SEGMENTS, WHOLE_PATH};
use crate::tiles::layouts::Stroke;

/// Paths that one task cuts into parts.
const TASK_PATHS: usize = 1 << 11;

/// A part of a run of a path.
#[derive(Clone, Copy, Zeroable)]
pub(crate) struct PathPart {
    pub(crate) path: u32,
    rank: u32,
    run: u32,
    first_point: u32,
    segments: u32,
    /// Flags of `Stroke::extent`.
    flags: u32,
}

impl PathPart {
    /// Appends the parts of a path.
    pub(crate) fn of_path(layout: &Layout, path: u32, rank: u32, parts: &mut Vec<Self>) {
        let first = parts.len();
        let path_ref = layout.paths.get(path as usize);
        for (run, index) in path_ref.runs().zip(0..) {
            let segments = run.len() - 3;
            for first in (0..segments).step_by(STROKE_SEGMENTS) {
                parts.push(Self {
                    path,
                    rank,
                    run: index,
                    first_point: first as u32,
                    segments: (segments - first).min(STROKE_SEGMENTS) as u32,
                    flags: 0,
                });
            }
        }
        let parts = &mut parts[first..];
        if let [whole] = parts {
            whole.flags |= WHOLE_PATH;
        }
        if let ([start, ..], Some(_)) = (&mut *parts, open_ends(path_ref)) {
            start.flags |= PATH_START;
            parts[parts.len() - 1].flags |= PATH_END;
        }
    }

    /// The part of a stroke that is a whole path.
    pub(crate) fn of_whole(path: u32, stroke: Stroke) -> Self {
        Self {
            path,
            rank: stroke.rank,
            run: 0,
            first_point: 0,
            segments: stroke.segments(),
            flags: stroke.extent & (WHOLE_PATH | PATH_START | PATH_END),
        }
    }

    /// Returns `true` if the part is a whole path.
    pub(crate) fn is_whole(&self) -> bool {
        self.flags & WHOLE_PATH != 0
    }

    /// The stroke of this part, with its first point within its cluster.
    pub(crate) fn stroke(&self, first_point: u32) -> Stroke {
        Stroke {
            extent: first_point | self.segments << SEGMENTS_BIT | self.flags,
            rank: self.rank,
        }
    }

    /// Appends the control points relative to the origin of a cluster.
    pub(crate) fn append_local(
        &self,
        layout: &Layout,
        origin: ClusterOrigin,
        points_m: &mut Vec<[f32; 2]>,
    ) {
        let mut runs = layout.paths.get(self.path as usize).runs();
        let first = self.first_point as usize;
        let points = first..first + self.segments as usize + 3;
        match runs.nth(self.run as usize) {
            Some(RunPoints::F64(run)) => {
                points_m.extend(run[points].iter().map(|p| origin.local_m(*p)));
            }
            Some(RunPoints::F32(run)) => {
                points_m.extend(run[points].iter().map(|p| origin.local_m(p.to_f64())));
            }
            None => {}
        }
    }

    /// Control points in world coordinates.
    pub(crate) fn points<'a>(
        &self,
        layout: &'a Layout,
    ) -> impl Iterator<Item = Point<f64>> + use<'a> {
        let mut runs = layout.paths.get(self.path as usize).runs();
        let run = runs.nth(self.run as usize);
        let first = self.first_point as usize;
        let points = first..first + self.segments as usize + 3;
        points.filter_map(move |index| Some(run.as_ref()?.get(index)))
    }
}

/// The parts of some paths, in their order. All threads share the work.
pub(crate) fn parts_of(scene: &Scene, ranks: &DrawRanks, paths: &[u32]) -> Vec<PathPart> {
    let tasks = paths.par_chunks(TASK_PATHS).map(|paths| {
        let mut parts = Vec::with_capacity(paths.len());
        for &path in paths {
            if let Some(rank) = ranks.rank(path) {
                PathPart::of_path(scene.layout(), path, rank, &mut parts);
            }
        }
        parts
    });
    let parts = tasks.collect::<Vec<_>>();
    concatenated(&parts.iter().map(Vec::as_slice).collect::<Vec<_>>(), 0)
}
