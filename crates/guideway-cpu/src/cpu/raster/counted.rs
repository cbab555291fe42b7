//! Counts the paths per sample of a tile: gathers sixteen lines at a time, and adds the samples of
//! each path once. A path that is not closed counts half within half its width of either end.
//!
//! Counts are sums of integers, so their order is free. The lines of a path that lie side by side
//! are united in the mask; a line alone, and the disc around an end, are counted from their spans
//! without it. Ends at one place, where paths meet, are one disc that is counted several times.

use guideway_scene::density::open_ends;
use guideway_spline::Point;

use super::caps::CapTables;
use super::cluster_in_tile::{ClusterInTile, PieceRef};
use super::coverage_mask::CoverageMask;
use super::disc::Disc;
use super::job::{BandJob, Tile};
use super::line_batch::LineBatch;
use super::waiting_lines::WaitingLines;
use crate::cpu::flatten::cluster_lines::ClusterLines;
use crate::cpu::flatten::polylines::{Coordinate, bits_below};
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::samples::{LAYERED, columns};
use crate::cpu::ground::tile::{LANES, SampleHalves, TILE_PX};

/// Ends that wait until they are counted: enough that most that lie at one place meet.
const MAX_ENDS: usize = 1024;

/// An end of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathEnd {
    /// Columns from the corner of the tile.
    at: Point<f32>,
    /// Half the stroke width, in columns.
    radius: f32,
}

impl PathEnd {
    /// Equal ends have equal keys, and ends of one radius are side by side.
    #[inline(always)]
    fn key(&self) -> (u32, u64) {
        let Point { x, y } = self.at;
        let at = u64::from(x.to_bits()) << u32::BITS | u64::from(y.to_bits());
        (self.radius.to_bits(), at)
    }
}

/// A tile whose paths are being counted, and the lines that wait for a full batch.
pub(crate) struct CountedTile<'a> {
    job: &'a BandJob<'a>,
    tile: &'a Tile,
    mask: &'a mut CoverageMask<LAYERED>,
    cap_tables: &'a mut CapTables<LAYERED>,
    counts: &'a mut SampleHalves,
    ends: &'a mut Vec<PathEnd>,
    lines: WaitingLines,
    /// The path whose shape is in the mask, and the columns of pixels that it may touch, one bit
    /// each.
    shape: Option<u32>,
    shape_pixels: u32,
}

impl<'a> CountedTile<'a> {
    /// Starts with empty `counts`, and without `ends`.
    #[inline(always)]
    pub(crate) fn new(
        job: &'a BandJob<'a>,
        tile: &'a Tile,
        mask: &'a mut CoverageMask<LAYERED>,
        cap_tables: &'a mut CapTables<LAYERED>,
        counts: &'a mut SampleHalves,
        ends: &'a mut Vec<PathEnd>,
    ) -> Self {
        *counts = [[0; TILE_PX]; TILE_PX];
        ends.clear();
        Self {
            job,
            tile,
            mask,
            cap_tables,
            counts,
            ends,
            lines: WaitingLines::default(),
            shape: None,
            shape_pixels: 0,
        }
    }

    /// Counts pieces, those of a path side by side.
    #[inline(always)]
    pub(crate) fn add(&mut self, pieces: &[PieceRef]) {
        // The ends first, and all of them: their points lie anywhere in memory, and the processor
        // waits for several at once.
        let mut last = None;
        for piece in pieces {
            let of = self.path_of(piece).map(|path| (path, piece.key));
            if of != last {
                last = of;
                self.add_ends(of);
            }
        }
        for piece in pieces {
            self.add_lines(piece);
        }
        if self.ends.len() >= MAX_ENDS {
            self.count_ends();
        }
    }

    #[inline(always)]
    fn path_of(&self, piece: &PieceRef) -> Option<u32> {
        let cluster = ClusterInTile::<LAYERED>::new(self.job, self.tile, piece.key);
        cluster.path_of(piece.piece as usize)
    }

    /// Keeps the ends of a path that touch the tile.
    #[inline(always)]
    fn add_ends(&mut self, path_and_key: Option<(u32, u32)>) {
        let Some((path, key)) = path_and_key else {
            return;
        };
        let side = (TILE_PX * LAYERED) as f32;
        let radius = self.job.radius::<LAYERED>(path);
        let cluster = ClusterInTile::<LAYERED>::new(self.job, self.tile, key);
        let ends = open_ends(self.job.ctx.scene.layout().paths.get(path as usize));
        for at_m in ends.into_iter().flatten() {
            let at_px = cluster.shown_px(at_m);
            let at = Point::new(columns::<LAYERED>(at_px.x), columns::<LAYERED>(at_px.y));
            let is_inside = |at: f32| at + radius > 0.0 && at - radius < side;
            if is_inside(at.x) && is_inside(at.y) {
                self.ends.push(PathEnd { at, radius });
            }
        }
    }

    #[inline(always)]
    fn add_lines(&mut self, piece_ref: &PieceRef) {
        let cluster = ClusterInTile::<LAYERED>::new(self.job, self.tile, piece_ref.key);
        let piece = piece_ref.piece as usize;
        let Some(path) = cluster.path_of(piece) else {
            return;
        };
        match cluster.lines() {
            ClusterLines::Cached(unit_m, lines) => {
                self.add_piece(&cluster.map_cached(*unit_m, lines), piece, path);
            }
            ClusterLines::Clipped(lines) => {
                self.add_piece(&cluster.map_clipped(lines), piece, path);
            }
            ClusterLines::None => {}
        }
    }

    #[inline(always)]
    fn add_piece<T: Coordinate>(
        &mut self,
        mapped: &TileLines<'_, T, LAYERED>,
        piece: usize,
        path: u32,
    ) {
        let radius = self.job.radius::<LAYERED>(path);
        if radius != self.lines.radius {
            self.count_lines();
            self.lines.radius = radius;
        }
        for vertex in mapped.lines.line_starts(piece..piece + 1) {
            let [start, end] = [mapped.vertex(vertex), mapped.vertex(vertex + 1)];
            if self.lines.push(start, end, path) {
                self.count_lines();
            }
        }
    }

    /// Counts the lines that wait, or adds them to the shape of their path.
    #[inline(always)]
    fn count_lines(&mut self) {
        let Some(lines) = self.lines.take(self.mask) else {
            return;
        };
        let mut visible = lines.visible;
        while visible != 0 {
            let lane = visible.trailing_zeros() as usize % LANES;
            visible &= visible - 1;
            let path = lines.paths[lane];
            if self.shape != Some(path) {
                self.end_shape();
            }
            let next = lines.paths[visible.trailing_zeros() as usize % LANES];
            let is_alone = self.shape.is_none() && visible != 0 && next != path;
            let caps = self.cap_tables.of(self.lines.radius);
            let pixel_box = lines.pixel_box(lane);
            let stroke = (&lines.capsule(lane), caps);
            if is_alone {
                self.mask.count_stroke(&stroke, pixel_box, 2, self.counts);
            } else {
                self.mask.stroke(&stroke, pixel_box);
                self.shape = Some(path);
                self.shape_pixels |= pixel_box.pixels;
            }
        }
    }

    /// Counts the shape in the mask.
    #[inline(always)]
    fn end_shape(&mut self) {
        if self.shape.take().is_some() {
            let pixels = std::mem::take(&mut self.shape_pixels);
            self.mask.count(2, pixels, self.counts);
        }
    }

    /// Takes half a count back around the ends that wait.
    #[inline(always)]
    fn count_ends(&mut self) {
        self.ends.sort_unstable_by_key(PathEnd::key);
        let mut at = 0;
        while at < self.ends.len() {
            let radius = self.ends[at].radius;
            let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
            let (mut times, mut len) = ([0; LANES], 0);
            while len < LANES && at < self.ends.len() && self.ends[at].radius == radius {
                let end = self.ends[at];
                (x[len], y[len]) = (end.at.x, end.at.y);
                while at < self.ends.len() && self.ends[at] == end {
                    times[len] += 1;
                    at += 1;
                }
                len += 1;
            }
            let boxes = LineBatch::<LAYERED>::new([x, x], [y, y], radius).boxes();
            let open = boxes.open(self.mask.open());
            let mut visible = bits_below(len) & open.lines;
            let caps = self.cap_tables.of(radius);
            while visible != 0 {
                let lane = visible.trailing_zeros() as usize % LANES;
                visible &= visible - 1;
                let disc = (&Disc::new::<LAYERED>(x[lane], y[lane]), caps);
                let pixel_box = boxes.pixel_box(lane, &open);
                self.mask
                    .count_stroke(&disc, pixel_box, -times[lane], self.counts);
            }
        }
        self.ends.clear();
    }

    /// Counts what remains.
    #[inline(always)]
    pub(crate) fn finish(mut self) {
        self.count_lines();
        self.end_shape();
        self.count_ends();
    }
}
