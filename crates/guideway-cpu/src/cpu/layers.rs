//! Strokes of several colors, from the highest draw rank down, sixteen lines at a time.

use guideway_scene::Rgba;
use guideway_spline::Point;

use super::LANES;
use super::canvas::{Canvas, TILE_PX, set_bits};
use super::cluster::Lines;
use super::disc::Discs;
use super::paint::{Band, Tile};
use super::polylines::{Coordinate, bits_below};
use super::seen::{Hit, Seen, columns};
use super::span::LAYERED;
use super::stroke::{Batch, Placed};

/// Strokes of one opaque color after which it is worth a look whether anything is left to be covered.
const STROKES_A_FILL: usize = 32;

/// How many paths cover each pixel of a tile, times its samples.
pub(super) type Counts = [[u32; TILE_PX]; TILE_PX];

/// Paths whose strokes make one shape.
#[derive(Clone, Copy, PartialEq)]
struct Layer {
    color: Rgba,
    /// The only path of the shape; none where it does not matter which path covers a sample.
    alone: Option<u32>,
}

/// Lines on their way to the canvas.
pub(super) struct Layers<'a> {
    band: &'a Band<'a>,
    tile: &'a Tile,
    canvas: &'a mut Canvas<LAYERED>,
    discs: &'a mut Discs<LAYERED>,
    /// Where shapes are counted instead of laid as colors.
    counts: Option<&'a mut Counts>,
    x: [[f32; LANES]; 2],
    y: [[f32; LANES]; 2],
    /// Path of each line.
    paths: [u32; LANES],
    len: usize,
    /// Half the width of all these lines, in columns.
    radius: f32,
    /// What the shape on the canvas belongs to, and its strokes.
    layer: Option<Layer>,
    strokes: usize,
}

impl<'a> Layers<'a> {
    #[inline(always)]
    pub(super) fn new(
        band: &'a Band<'a>,
        tile: &'a Tile,
        canvas: &'a mut Canvas<LAYERED>,
        discs: &'a mut Discs<LAYERED>,
        counts: Option<&'a mut Counts>,
    ) -> Self {
        Self {
            band,
            tile,
            canvas,
            discs,
            counts,
            x: [[0.0; LANES]; 2],
            y: [[0.0; LANES]; 2],
            paths: [0; LANES],
            len: 0,
            radius: 0.0,
            layer: None,
            strokes: 0,
        }
    }

    /// Whether nothing more can be seen.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.canvas.is_full()
    }

    /// Adds a piece below all others.
    #[inline(always)]
    pub(super) fn add(&mut self, hit: &Hit) {
        let seen = Seen::<LAYERED>::new(self.band, self.tile, hit.key);
        let piece = hit.piece as usize;
        match seen.lines() {
            Lines::Kept(unit_m, lines) => {
                let path = seen.path(lines.member(piece));
                self.add_piece(&seen.placed(*unit_m, lines), piece, path);
            }
            Lines::Cut(lines) => {
                let path = seen.path(lines.member(piece));
                self.add_piece(&seen.placed_cut(lines), piece, path);
            }
            Lines::None => {}
        }
    }

    #[inline(always)]
    fn add_piece<T: Coordinate>(
        &mut self,
        placed: &Placed<'_, T, LAYERED>,
        piece: usize,
        path: u32,
    ) {
        let radius_px = self.band.common_radius_px;
        let radius =
            columns::<LAYERED>(radius_px.unwrap_or_else(|| self.band.shot.radius_px(path)));
        let bounds = placed.lines.bounds(piece);
        let reach = Point::new(radius + 1.0, radius + 1.0);
        let [least, most] = [bounds.min, bounds.max].map(|p| p * placed.scale + placed.offset);
        let per_px = 1.0 / LAYERED as f32;
        if !self
            .canvas
            .is_open((least - reach) * per_px, (most + reach) * per_px)
        {
            return;
        }
        if radius != self.radius {
            self.flush();
            self.radius = radius;
        }
        for vertex in placed.lines.begins_of(piece..piece + 1) {
            let (start, end) = (placed.vertex(vertex), placed.vertex(vertex + 1));
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
    }

    /// Strokes the lines that wait.
    #[inline(always)]
    fn flush(&mut self) {
        let batch = Batch::new(self.x, self.y, self.radius);
        let boxes = batch.boxes();
        let open = boxes.open(self.canvas.open());
        let todo = bits_below(self.len) & open.lines;
        self.len = 0;
        if todo == 0 {
            return;
        }
        let slopes = batch.slopes();
        for lane in set_bits(todo) {
            let lane = lane % LANES;
            self.choose_layer(self.paths[lane]);
            let disc = self.discs.of(self.radius);
            let part = boxes.part(lane, &open);
            batch.stroke(lane, &slopes, part, self.canvas, disc);
        }
    }

    /// Sees to it that a path belongs to the shape on the canvas.
    #[inline(always)]
    fn choose_layer(&mut self, path: u32) {
        let color = self.band.shot.scene.color(path);
        let is_shared = color.is_opaque() && self.counts.is_none();
        let layer = Layer {
            color,
            alone: (!is_shared).then_some(path),
        };
        if self.layer != Some(layer) || (is_shared && self.strokes == STROKES_A_FILL) {
            self.end_shape();
            self.layer = Some(layer);
        }
        self.strokes += 1;
    }

    #[inline(always)]
    fn end_shape(&mut self) {
        if let Some(layer) = self.layer.take() {
            match &mut self.counts {
                Some(counts) => self.canvas.count(counts),
                None => self.canvas.fill(layer.color),
            }
        }
        self.strokes = 0;
    }

    /// Strokes and lays what is left.
    #[inline(always)]
    pub(super) fn finish(mut self) {
        self.flush();
        self.end_shape();
    }
}
