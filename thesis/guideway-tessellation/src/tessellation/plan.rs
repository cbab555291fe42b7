//! Plans the buffers of a scene before any allocation on the device.
//!
//! Input: the scene and the limits of the device. Output: chunks of paths, extents and widths.

use std::ops::Range;

use guideway_layout::PathRef;
use guideway_scene::{LineRule, Scene};
use guideway_spline::{Bounds, Point};

use super::shared::{Counters, DrawElements, PATCH_VERTICES, PathRecord, WORKGROUP};
use crate::options::Commands;
use crate::sys::Limits;

/// The measures of a scene, and its chunks within the limits of the device.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Origin of the coordinates on the device: the center of the scene.
    pub(super) origin_m: Point<f64>,
    /// Largest absolute coordinate relative to the origin.
    pub(super) reach_m: f64,
    /// Longest side of the bounds of one segment's control points.
    pub(super) longest_m: f64,
    pub(super) widths: Widths,
    /// Longer side of the control points' bounds of the smallest path; infinite without paths.
    pub(super) smallest_m: f64,
    pub(super) chunks: Vec<ChunkPlan>,
}

/// Consecutive paths of the draw order that share buffers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct ChunkPlan {
    /// Indices in the draw order.
    pub(super) order: Range<usize>,
    /// Paths with segments.
    pub(super) paths: u32,
    pub(super) segments: u32,
    pub(super) points: u32,
}

/// Bytes per buffer of a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ChunkBytes {
    pub(super) points: u64,
    pub(super) paths: u64,
    /// The output of the culling pass: draw commands or patches.
    pub(super) output: u64,
    /// Indices of control points: all four per segment, or only the first.
    pub(super) segments: u64,
}

impl ChunkBytes {
    pub(super) fn total(self) -> u64 {
        self.points + self.paths + self.output + self.segments + size_of::<Counters>() as u64
    }

    fn largest(self) -> u64 {
        self.points
            .max(self.paths)
            .max(self.output)
            .max(self.segments)
    }
}

impl ChunkPlan {
    pub(super) fn bytes(&self, commands: Commands) -> ChunkBytes {
        let bytes = |count: u32, size: usize| u64::from(count) * size as u64;
        let indices = bytes(self.segments, size_of::<u32>());
        let (output, segments) = match commands {
            Commands::PerPath => (
                bytes(self.paths, size_of::<DrawElements>()),
                indices * u64::from(PATCH_VERTICES),
            ),
            Commands::Compact => (indices, indices),
        };
        ChunkBytes {
            points: bytes(self.points, size_of::<[f32; 2]>()),
            paths: bytes(self.paths, size_of::<PathRecord>()),
            output,
            segments,
        }
    }

    fn fits(&self, commands: Commands, limits: &Limits) -> bool {
        let max_paths = u64::from(limits.workgroups) * u64::from(WORKGROUP);
        self.bytes(commands).largest() <= limits.buffer_bytes && u64::from(self.paths) <= max_paths
    }

    /// An empty chunk that begins at this index of the draw order.
    fn empty_at(start: usize) -> Self {
        Self {
            order: start..start,
            ..Self::default()
        }
    }

    /// The chunk with one more path, or `None` when a count overflows.
    fn with(&self, path: PathSize) -> Option<Self> {
        Some(Self {
            order: self.order.start..self.order.end + 1,
            paths: self.paths + u32::from(path.segments > 0),
            segments: self.segments.checked_add(path.segments)?,
            points: self.points.checked_add(path.points)?,
        })
    }
}

/// Counts of one path.
#[derive(Clone, Copy)]
struct PathSize {
    segments: u32,
    points: u32,
}

fn path_size(path: PathRef<'_>) -> PathSize {
    let runs = || path.runs().filter(|run| run.segments().len() > 0);
    PathSize {
        segments: runs().map(|run| run.segments().len() as u32).sum(),
        points: runs().map(|run| run.len() as u32).sum(),
    }
}

impl Plan {
    /// Measures a scene and splits it into chunks.
    ///
    /// # Errors
    /// When a single path exceeds the limits of the device.
    pub(super) fn new(
        scene: &Scene,
        commands: Commands,
        limits: &Limits,
    ) -> Result<Self, PathTooLong> {
        let center = scene.bounds().map(Bounds::center);
        let mut plan = Self {
            origin_m: center.unwrap_or(Point::new(0.0, 0.0)),
            reach_m: 0.0,
            longest_m: 0.0,
            widths: Widths::default(),
            smallest_m: f64::INFINITY,
            chunks: Vec::new(),
        };
        let mut chunk = ChunkPlan::default();
        for &row in scene.draw_order() {
            let path = scene.layout().paths.get(row as usize);
            plan.widths.add(scene.width_m(row));
            plan.measure(path);
            let with_path = |chunk: &ChunkPlan| {
                let with = chunk.with(path_size(path));
                with.filter(|with| with.fits(commands, limits))
            };
            chunk = match with_path(&chunk) {
                Some(larger) => larger,
                None => {
                    let next = ChunkPlan::empty_at(chunk.order.end);
                    plan.chunks.push(chunk);
                    with_path(&next).ok_or(PathTooLong { row })?
                }
            };
        }
        plan.chunks.push(chunk);
        plan.chunks.retain(|chunk| chunk.paths > 0);
        Ok(plan)
    }

    /// Bytes of all buffers.
    pub(super) fn bytes(&self, commands: Commands) -> u64 {
        let chunks = self.chunks.iter();
        chunks.map(|chunk| chunk.bytes(commands).total()).sum()
    }

    fn measure(&mut self, path: PathRef<'_>) {
        if let Some(hull) = path.hull_bounds() {
            self.smallest_m = self.smallest_m.min(hull.size().x.max(hull.size().y));
        }
        for run in path.runs() {
            for point in run.iter() {
                let offset_m = point - self.origin_m;
                self.reach_m = self.reach_m.max(offset_m.x.abs()).max(offset_m.y.abs());
            }
            for hull in run.segments().filter_map(Bounds::of_points) {
                self.longest_m = self.longest_m.max(hull.size().x).max(hull.size().y);
            }
        }
    }
}

/// A path whose control points exceed one buffer of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PathTooLong {
    pub(super) row: u32,
}

/// The range of the widths of a scene's paths. A line rule grows with the width, so that its values
/// at both ends bound all others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Widths {
    /// True if a path has no width.
    includes_none: bool,
    /// Smallest and largest width.
    range_m: Option<(f32, f32)>,
}

impl Widths {
    fn add(&mut self, width_m: Option<f32>) {
        match (width_m, self.range_m) {
            (None, _) => self.includes_none = true,
            (Some(w), None) => self.range_m = Some((w, w)),
            (Some(w), Some((min, max))) => {
                self.range_m = Some((min.min(w), max.max(w)));
            }
        }
    }

    /// Returns `true` if a line rule makes all paths 1 pixel wide.
    pub(super) fn are_one_pixel(&self, rule: &LineRule, px_per_m: f64) -> bool {
        let own = self.range_m.into_iter();
        own.flat_map(|(min, max)| [Some(min), Some(max)])
            .chain(self.includes_none.then_some(None))
            .all(|width_m| (2.0 * rule.radius_px(width_m, px_per_m) - 1.0).abs() < 1e-6)
    }
}
