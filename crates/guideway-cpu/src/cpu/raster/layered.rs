//! Draws the pieces of a tile in several colors, by descending draw rank: gathers sixteen lines at
//! a time, adds them to the shape of their path, and composites the shape below those before it.

use guideway_scene::Rgba;
use guideway_spline::Point;

use super::bits::set_bits;
use super::caps::CapTables;
use super::cluster_in_tile::{ClusterInTile, PieceRef};
use super::coverage_mask::CoverageMask;
use super::job::{BandJob, Tile};
use super::line_batch::LineBatch;
use crate::cpu::flatten::cluster_lines::ClusterLines;
use crate::cpu::flatten::polylines::{Coordinate, bits_below};
use crate::cpu::flatten::tile_lines::TileLines;
use crate::cpu::ground::samples::{LAYERED, columns};
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
    x: [[f32; LANES]; 2],
    y: [[f32; LANES]; 2],
    paths: [u32; LANES],
    len: usize,
    /// Half the stroke width of all these lines, in columns.
    radius: f32,
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
            x: [[0.0; LANES]; 2],
            y: [[0.0; LANES]; 2],
            paths: [0; LANES],
            len: 0,
            radius: 0.0,
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
        let path = match cluster.lines() {
            ClusterLines::Cached(_, lines) => cluster.path(lines.member(piece)),
            ClusterLines::Clipped(lines) => cluster.path(lines.member(piece)),
            ClusterLines::None => return,
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
        let radius = self.radius_of(path);
        let bounds = mapped.lines.bounds(piece);
        let reach = Point::new(radius + 1.0, radius + 1.0);
        let [min, max] = [bounds.min, bounds.max].map(|p| p * mapped.scale + mapped.offset);
        let px_per_column = 1.0 / LAYERED as f32;
        let (min, max) = ((min - reach) * px_per_column, (max + reach) * px_per_column);
        if !self.mask.is_open(min, max) {
            return;
        }
        self.choose_radius(radius);
        for vertex in mapped.lines.line_starts(piece..piece + 1) {
            self.add_line(mapped.vertex(vertex), mapped.vertex(vertex + 1), path);
        }
    }

    /// Half the stroke width of a path, in columns.
    #[inline(always)]
    fn radius_of(&self, path: u32) -> f32 {
        let common_px = self.job.common_radius_px;
        columns::<LAYERED>(common_px.unwrap_or_else(|| self.job.ctx.radius_px(path)))
    }

    #[inline(always)]
    fn choose_radius(&mut self, radius: f32) {
        if radius != self.radius {
            self.flush();
            self.radius = radius;
        }
    }

    #[inline(always)]
    fn add_line(&mut self, start: Point<f32>, end: Point<f32>, path: u32) {
        self.x[0][self.len] = start.x;
        self.x[1][self.len] = end.x;
        self.y[0][self.len] = start.y;
        self.y[1][self.len] = end.y;
        self.paths[self.len] = path;
        self.len += 1;
        if self.len == LANES {
            self.flush();
        }
    }

    /// Strokes the lines that wait.
    #[inline(always)]
    fn flush(&mut self) {
        let batch = LineBatch::new(self.x, self.y, self.radius);
        let boxes = batch.boxes();
        let open = boxes.open(self.mask.open());
        let visible = bits_below(self.len) & open.lines;
        self.len = 0;
        if visible == 0 {
            return;
        }
        let slopes = batch.slopes();
        for lane in set_bits(visible) {
            let lane = lane % LANES;
            self.choose_layer(self.paths[lane]);
            let caps = self.cap_tables.of(self.radius);
            let pixel_box = boxes.pixel_box(lane, &open);
            batch.stroke(lane, &slopes, pixel_box, self.mask, caps);
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
