//! What of a scene goes where, before any memory of the device is taken.

use std::ops::Range;

use guideway_layout::PathRef;
use guideway_scene::{LineRule, Rgba, Scene};
use guideway_spline::{Bounds, Point};

use super::shared::{CORNERS, DrawElements, PathRecord, Tally, WORKGROUP};
use crate::options::Commands;
use crate::sys::Limits;

/// A scene measured and cut into chunks that the device's limits allow for.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plan {
    /// Where the device's coordinates begin: the middle of the scene.
    pub(super) origin_m: Point<f64>,
    /// Largest coordinate from there.
    pub(super) reach_m: f64,
    /// Longest side of the box of one segment's control points.
    pub(super) longest_m: f64,
    pub(super) widths: Widths,
    /// Longer side of the box of the smallest path's control points; infinite without paths.
    pub(super) smallest_m: f64,
    pub(super) chunks: Vec<ChunkPlan>,
}

/// Paths, next to each other in draw order, that share buffers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct ChunkPlan {
    /// Places in the draw order.
    pub(super) order: Range<usize>,
    /// Those that have segments.
    pub(super) paths: u32,
    pub(super) segments: u32,
    pub(super) points: u32,
}

/// Bytes of each buffer of a chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ChunkBytes {
    pub(super) points: u64,
    pub(super) paths: u64,
    /// A commands buffer or a list of patches: what the pre-pass writes.
    pub(super) output: u64,
    /// Indices of control points: four a segment, or the first only.
    pub(super) segments: u64,
}

impl ChunkBytes {
    pub(super) fn total(self) -> u64 {
        self.points + self.paths + self.output + self.segments + size_of::<Tally>() as u64
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
        let of = |count: u32, size: usize| u64::from(count) * size as u64;
        let corner = of(self.segments, size_of::<u32>());
        let (output, segments) = match commands {
            Commands::PerPath => (
                of(self.paths, size_of::<DrawElements>()),
                corner * u64::from(CORNERS),
            ),
            Commands::Compact => (corner, corner),
        };
        ChunkBytes {
            points: of(self.points, size_of::<[f32; 2]>()),
            paths: of(self.paths, size_of::<PathRecord>()),
            output,
            segments,
        }
    }

    fn fits(&self, commands: Commands, limits: &Limits) -> bool {
        let most_paths = u64::from(limits.workgroups) * u64::from(WORKGROUP);
        self.bytes(commands).largest() <= limits.buffer_bytes && u64::from(self.paths) <= most_paths
    }

    /// No paths yet, from this place in the draw order on.
    fn at(start: usize) -> Self {
        Self {
            order: start..start,
            ..Self::default()
        }
    }

    /// With one more path; none if that is more than can be counted.
    fn with(&self, path: Size) -> Option<Self> {
        Some(Self {
            order: self.order.start..self.order.end + 1,
            paths: self.paths + u32::from(path.segments > 0),
            segments: self.segments.checked_add(path.segments)?,
            points: self.points.checked_add(path.points)?,
        })
    }
}

#[derive(Clone, Copy)]
struct Size {
    segments: u32,
    points: u32,
}

fn size(path: PathRef<'_>) -> Size {
    let runs = || path.runs().filter(|run| run.segments().len() > 0);
    Size {
        segments: runs().map(|run| run.segments().len() as u32).sum(),
        points: runs().map(|run| run.len() as u32).sum(),
    }
}

impl Plan {
    /// Measures a scene.
    ///
    /// # Errors
    /// When one path alone is beyond the device's limits: its row, and which limit.
    pub(super) fn new(scene: &Scene, commands: Commands, limits: &Limits) -> Result<Self, TooLong> {
        let middle = scene.bounds().map(Bounds::center);
        let mut plan = Self {
            origin_m: middle.unwrap_or(Point::new(0.0, 0.0)),
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
                let with = chunk.with(size(path));
                with.filter(|with| with.fits(commands, limits))
            };
            chunk = match with_path(&chunk) {
                Some(larger) => larger,
                None => {
                    let next = ChunkPlan::at(chunk.order.end);
                    plan.chunks.push(chunk);
                    with_path(&next).ok_or(TooLong { row })?
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
                let away_m = point - self.origin_m;
                self.reach_m = self.reach_m.max(away_m.x.abs()).max(away_m.y.abs());
            }
            for hull in run.segments().filter_map(Bounds::of_points) {
                self.longest_m = self.longest_m.max(hull.size().x).max(hull.size().y);
            }
        }
    }
}

/// A path with more control points than one buffer of the device holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLong {
    pub(super) row: u32,
}

/// The widths that the paths of a scene have: enough of them to ask a rule, which grows with the width.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Widths {
    some_have_none: bool,
    least_and_most_m: Option<(f32, f32)>,
}

impl Widths {
    fn add(&mut self, width_m: Option<f32>) {
        match (width_m, self.least_and_most_m) {
            (None, _) => self.some_have_none = true,
            (Some(w), None) => self.least_and_most_m = Some((w, w)),
            (Some(w), Some((least, most))) => {
                self.least_and_most_m = Some((least.min(w), most.max(w)));
            }
        }
    }

    /// Whether a rule asks for lines one pixel wide, whichever the path.
    pub(super) fn are_one_pixel(&self, rule: &LineRule, px_per_m: f64) -> bool {
        let own = self.least_and_most_m.into_iter();
        own.flat_map(|(least, most)| [Some(least), Some(most)])
            .chain(self.some_have_none.then_some(None))
            .all(|width_m| (2.0 * rule.radius_px(width_m, px_per_m) - 1.0).abs() < 1e-6)
    }
}

/// The one opaque color of a scene's paths, black if there are none; or what it has instead.
pub(super) fn one_color(scene: &Scene) -> Result<Rgba, &'static str> {
    match scene.common_color() {
        None => Err("paths of several colors"),
        Some(color) if !color.is_opaque() => Err("translucent paths"),
        Some(color) => Ok(color),
    }
}
