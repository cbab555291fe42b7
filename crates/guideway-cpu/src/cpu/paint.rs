use std::cmp::Reverse;
use std::sync::{Mutex, PoisonError};

use guideway_render::RenderError;
use guideway_scene::Rgba;
use guideway_spline::Point;
use multiversion::multiversion;
use rayon::prelude::*;

use super::canvas::{Canvas, TILE_PX, solid_colors};
use super::cluster::{Cluster, Lines};
use super::polylines::ROUNDS;
use super::seen::Seen;
use super::shot::{LaneWidth, Shot};
use super::span::{Disc, LAYERED, ROWS, SOLID};
use super::tiles::{Bins, Grid};

/// Strokes of one colour after which it is worth a look whether anything is left to be covered.
const STROKES_A_FILL: usize = 32;

/// What one thread paints with.
pub(super) struct Painter {
    solid: Canvas<SOLID>,
    solid_disc: Disc<SOLID>,
    layers: Canvas<LAYERED>,
    disc: Disc<LAYERED>,
    hits: Vec<Hit>,
    counts: Box<[[u32; TILE_PX]; TILE_PX]>,
}

/// A piece that may leave a mark on a tile.
pub(super) struct Hit {
    pub(super) rank: u32,
    pub(super) cluster: u32,
    pub(super) piece: u32,
}

/// A band of the picture with all that goes on it.
#[derive(Clone, Copy)]
pub(super) struct Band<'a> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) grid: &'a Grid,
    /// Rows of paths, a cluster's next to each other.
    pub(super) paths: &'a [u32],
    pub(super) clusters: &'a [Cluster],
    pub(super) bins: &'a Bins,
    /// Draw rank of each path; none if it is its row.
    pub(super) ranks: Option<&'a [u32]>,
    /// Half the stroke width of all paths, if it is one.
    pub(super) common_radius_px: Option<f64>,
    /// Half the stroke width of the widest path.
    pub(super) widest_px: f64,
    /// One for each thread.
    pub(super) painters: &'a [Mutex<Painter>],
}

/// One tile, and its place in the pixels of its row of tiles.
pub(super) struct Tile {
    index: usize,
    pub(super) corner: Point<f64>,
    width_px: usize,
    height_px: usize,
}

/// What is painted on a tile.
#[derive(Clone, Copy)]
enum Matter {
    /// One opaque colour.
    Solid,
    /// Colours by draw rank.
    Layers,
    /// The number of paths.
    Counts,
}

impl Painter {
    pub(super) fn new() -> Self {
        Self {
            solid: Canvas::new(),
            solid_disc: Disc::default(),
            layers: Canvas::new(),
            disc: Disc::default(),
            hits: Vec::new(),
            counts: Box::new([[0; TILE_PX]; TILE_PX]),
        }
    }

    /// Most bytes that one holds, apart from a list of what lies on a tile.
    pub(super) fn bytes(is_opaque: bool) -> u64 {
        let canvases = Canvas::<SOLID>::bytes(true) + Canvas::<LAYERED>::bytes(is_opaque);
        let discs = Disc::<SOLID>::bytes() + Disc::<LAYERED>::bytes();
        canvases + discs + size_of::<[[u32; TILE_PX]; TILE_PX]>() as u64
    }
}

impl Band<'_> {
    /// Paints the colours into the pixels of the band.
    pub(super) fn color(
        &self,
        pixels: &mut [[u8; 4]],
        solid: Option<Rgba>,
    ) -> Result<(), RenderError> {
        let background = self.shot.style.background;
        let Some(color) = solid else {
            return self.for_each_tile(
                pixels,
                background.to_u32().to_be_bytes(),
                |painter, tile, rows| {
                    self.paint(painter, tile, Matter::Layers);
                    for (y, pixels) in rows.enumerate() {
                        painter.layers.row_over(y, background, pixels);
                    }
                },
            );
        };
        let colors = solid_colors(color, background);
        self.for_each_tile(pixels, colors[0], |painter, tile, rows| {
            self.paint(painter, tile, Matter::Solid);
            for (y, pixels) in rows.enumerate() {
                painter.solid.solid_row(y, &colors, pixels);
            }
        })
    }

    /// Writes how many paths cover each pixel of the band, on average over its square.
    pub(super) fn density(&self, pixels: &mut [f32]) -> Result<(), RenderError> {
        self.for_each_tile(pixels, 0.0, |painter, tile, rows| {
            self.paint(painter, tile, Matter::Counts);
            for (pixels, counts) in rows.zip(painter.counts.iter()) {
                for (pixel, &count) in pixels.iter_mut().zip(counts) {
                    *pixel = count as f32 / (ROWS * LAYERED) as f32;
                }
            }
        })
    }

    /// Calls `paint` for each tile that is not empty, with its part of each row of pixels.
    fn for_each_tile<P: Copy + Send + Sync>(
        &self,
        pixels: &mut [P],
        empty: P,
        paint: impl Fn(&mut Painter, &Tile, &mut dyn Iterator<Item = &mut [P]>) + Sync,
    ) -> Result<(), RenderError> {
        let width_px = self.shot.view.size().width() as usize;
        let rows = pixels.par_chunks_mut(width_px * TILE_PX).enumerate();
        rows.try_for_each(|(row, pixels)| {
            let painter =
                &self.painters[rayon::current_thread_index().unwrap_or(0) % self.painters.len()];
            let mut painter = painter.lock().unwrap_or_else(PoisonError::into_inner);
            let height_px = pixels.len() / width_px;
            let top_px = (self.grid.rows.start + row) * TILE_PX;
            for column in 0..self.grid.columns {
                self.shot.cancel.check()?;
                let left_px = column * TILE_PX;
                let tile = Tile {
                    index: row * self.grid.columns + column,
                    corner: Point::new(left_px as f64, top_px as f64),
                    width_px: TILE_PX.min(width_px - left_px),
                    height_px,
                };
                let within = left_px..left_px + tile.width_px;
                let rows = pixels.chunks_exact_mut(width_px);
                let mut rows = rows.map(|row| &mut row[within.clone()]);
                if self.bins.tile(tile.index).is_empty() {
                    rows.for_each(|row| row.fill(empty));
                } else {
                    paint(&mut painter, &tile, &mut rows);
                }
            }
            Ok(())
        })
    }

    fn paint(&self, painter: &mut Painter, tile: &Tile, matter: Matter) {
        match self.shot.lane_width {
            LaneWidth::Widest => paint_widest(self, painter, tile, matter),
            LaneWidth::Eight => paint_eight(self, painter, tile, matter),
            LaneWidth::Baseline => paint(self, painter, tile, matter),
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2"))]
fn paint_widest(band: &Band<'_>, painter: &mut Painter, tile: &Tile, matter: Matter) {
    paint(band, painter, tile, matter);
}

#[multiversion(targets("x86_64+avx2"))]
fn paint_eight(band: &Band<'_>, painter: &mut Painter, tile: &Tile, matter: Matter) {
    paint(band, painter, tile, matter);
}

#[inline(always)]
fn paint(band: &Band<'_>, painter: &mut Painter, tile: &Tile, matter: Matter) {
    match matter {
        Matter::Solid => paint_solid(band, painter, tile),
        Matter::Layers => paint_layers(band, painter, tile),
        Matter::Counts => paint_counts(band, painter, tile),
    }
}

/// Covers samples with all that lies on the tile, in any order, until all are covered.
#[inline(always)]
fn paint_solid(band: &Band<'_>, painter: &mut Painter, tile: &Tile) {
    let Painter {
        solid: canvas,
        solid_disc: disc,
        ..
    } = painter;
    canvas.begin(tile.width_px, tile.height_px);
    for round in 0..ROUNDS {
        for &number in band.bins.tile(tile.index) {
            if canvas.is_full() {
                return;
            }
            let cluster = Seen::<SOLID> { band, tile, number };
            match &band.clusters[number as usize].lines {
                Lines::Kept(unit_m, lines) => {
                    cluster.solid(canvas, disc, &cluster.placed(*unit_m, lines), round);
                }
                Lines::Cut(lines) => {
                    cluster.solid(canvas, disc, &cluster.placed_cut(lines), round);
                }
                Lines::None => {}
            }
        }
    }
}

/// Lays the tile's paths from the highest draw rank down, until nothing below can be seen. Of one opaque
/// colour, it does not matter which path a sample belongs to: they share a shape.
#[inline(always)]
fn paint_layers(band: &Band<'_>, painter: &mut Painter, tile: &Tile) {
    let Painter {
        layers: canvas,
        disc,
        hits,
        ..
    } = painter;
    canvas.begin_layers(tile.width_px, tile.height_px);
    hits.clear();
    for &number in band.bins.tile(tile.index) {
        Seen::<LAYERED> { band, tile, number }.gather(hits);
    }
    hits.sort_unstable_by_key(|hit| Reverse(hit.rank));
    let mut layer = None;
    let mut strokes = 0;
    for hit in hits.iter() {
        let cluster = Seen::<LAYERED> {
            band,
            tile,
            number: hit.cluster,
        };
        let path = cluster.path(hit.piece as usize);
        let color = band.shot.scene.color(path);
        let alone = (!color.is_opaque()).then_some(path);
        let is_same = layer == Some((color, alone));
        if !is_same || (color.is_opaque() && strokes == STROKES_A_FILL) {
            if let Some((color, _)) = layer {
                canvas.fill(color);
            }
            if canvas.is_full() {
                return;
            }
            layer = Some((color, alone));
            strokes = 0;
        }
        cluster.piece(canvas, disc, hit.piece as usize, path);
        strokes += 1;
    }
    if let Some((color, _)) = layer {
        canvas.fill(color);
    }
}

/// Counts the samples that each path covers.
#[inline(always)]
fn paint_counts(band: &Band<'_>, painter: &mut Painter, tile: &Tile) {
    let Painter {
        layers: canvas,
        disc,
        hits,
        counts,
        ..
    } = painter;
    canvas.begin_layers(tile.width_px, tile.height_px);
    **counts = [[0; TILE_PX]; TILE_PX];
    let mut last = None;
    for &number in band.bins.tile(tile.index) {
        let cluster = Seen::<LAYERED> { band, tile, number };
        hits.clear();
        cluster.gather(hits);
        for hit in hits.iter() {
            let path = cluster.path(hit.piece as usize);
            if last.is_some_and(|last| last != path) {
                canvas.count(counts);
            }
            last = Some(path);
            cluster.piece(canvas, disc, hit.piece as usize, path);
        }
    }
    canvas.count(counts);
}
