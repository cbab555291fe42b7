//! Draws the pieces of a tile in several colors, by descending draw rank: gathers sixteen lines at
//! a time, adds them to the shape of their path, and composites the shape below those before it.

use guideway_scene::Rgba;
use guideway_spline::Point;

use super::bits::set_bits;
use super::caps::CapTables;
use super::cluster_in_tile::{ClusterInTile, PieceRef};
use super::coverage_mask::CoverageMask;
use super::job::{BandJob, Tile};
use super::waiting_lines::WaitingLines;
use crate::cpu::flatten::cluster_lines::ClusterLines;
use crate::cpu::flatten::polylines::Coordinate;
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::samples::LAYERED;
use crate::cpu::ground::tile::LANES;

/// Strokes of one opaque color per shape. Compositing a shape detects full tiles, so smaller shapes
/// detect them earlier.
const STROKES_PER_SHAPE: usize = 32;

/// Paths whose strokes make one shape.
#[derive(Clone, Copy, PartialEq)]
struct Layer {
    color: Rgba,
    /// The only path of the shape; `None` if several paths of one opaque color share it.
    alone: Option<u32>,
}

/// A tile that is being drawn, and the lines that wait for a full batch.
pub(crate) struct LayeredTile<'a> {
    job: &'a BandJob<'a>,
    tile: &'a Tile,
    mask: &'a mut CoverageMask<LAYERED>,
    cap_tables: &'a mut CapTables<LAYERED>,
    lines: WaitingLines,
    /// The layer of the shape in the mask, and its strokes.
    layer: Option<Layer>,
    strokes: usize,
}

impl<'a> LayeredTile<'a> {
    #[inline(always)]
    pub(crate) fn new(
        job: &'a BandJob<'a>,
        tile: &'a Tile,
        mask: &'a mut CoverageMask<LAYERED>,
        cap_tables: &'a mut CapTables<LAYERED>,
    ) -> Self {
        Self {
            job,
            tile,
            mask,
            cap_tables,
            lines: WaitingLines::default(),
            layer: None,
            strokes: 0,
        }
    }

    /// Returns `true` if no lower piece can be seen.
    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.mask.is_full()
    }

    /// Adds a piece below all others.
    #[inline(always)]
    pub(crate) fn add(&mut self, piece_ref: &PieceRef) {
        let key = piece_ref.key;
        let cluster = ClusterInTile::<LAYERED>::new(self.job, self.tile, key);
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
        let bounds = mapped.lines.bounds(piece);
        let reach = Point::new(radius + 1.0, radius + 1.0);
        let [min, max] = [bounds.min, bounds.max].map(|p| p * mapped.scale + mapped.offset);
        let px_per_column = 1.0 / LAYERED as f32;
        let (min, max) = ((min - reach) * px_per_column, (max + reach) * px_per_column);
        if !self.mask.is_open(min, max) {
            return;
        }
        if radius != self.lines.radius {
            self.flush();
            self.lines.radius = radius;
        }
        for vertex in mapped.lines.line_starts(piece..piece + 1) {
            let [start, end] = [mapped.vertex(vertex), mapped.vertex(vertex + 1)];
            if self.lines.push(start, end, path) {
                self.flush();
            }
        }
    }

    /// Strokes the lines that wait.
    #[inline(always)]
    fn flush(&mut self) {
        let Some(lines) = self.lines.take(self.mask) else {
            return;
        };
        for lane in set_bits(lines.visible) {
            let lane = lane % LANES;
            self.choose_layer(lines.paths[lane]);
            let caps = self.cap_tables.of(self.lines.radius);
            let stroke = (&lines.capsule(lane), caps);
            self.mask.stroke(&stroke, lines.pixel_box(lane));
        }
    }

    /// Starts a new shape unless `path` belongs to the one in the mask.
    #[inline(always)]
    fn choose_layer(&mut self, path: u32) {
        let color = self.job.ctx.scene.color(path);
        let is_shared = color.is_opaque();
        let layer = Layer {
            color,
            alone: (!is_shared).then_some(path),
        };
        if self.layer != Some(layer) || (is_shared && self.strokes == STROKES_PER_SHAPE) {
            self.end_shape();
            self.layer = Some(layer);
        }
        self.strokes += 1;
    }

    /// Composites the shape in the mask.
    #[inline(always)]
    fn end_shape(&mut self) {
        if let Some(layer) = self.layer.take() {
            self.mask.composite(layer.color);
        }
        self.strokes = 0;
    }

    /// Draws the lines that remain.
    #[inline(always)]
    pub(crate) fn finish(mut self) {
        self.flush();
        self.end_shape();
    }
}
