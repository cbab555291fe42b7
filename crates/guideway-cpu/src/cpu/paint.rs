use std::cmp::Reverse;
use std::sync::Mutex;

use bytemuck::cast_slice_mut;
use guideway_scene::RenderError;
use guideway_scene::Rgba;
use guideway_spline::Point;
use guideway_spline::mem::prefetch;
use rayon::prelude::*;

use super::backdrop::{Backdrop, solid_colors};
use super::bins::Bins;
use super::canvas::{Look, Rows, TILE_PX};
use super::filled::{Filled, Known};
use super::index::Index;
use super::kept::Kept;
use super::layers::Layers;
use super::painter::Painter;
use super::polylines::ROUNDS;
use super::seen::{Seen, Share, ask_for_next};
use super::shot::Shot;
use super::sight::Sights;
use super::span::{LAYERED, SOLID, Samples};
use super::stretch::{Pixels, Stretch};
use super::threads::own;
use super::tiles::{Grid, Parts};
use super::vectors::by_lane_width;

/// Pieces of several colors that are sorted at first; each time that more are needed, twice as many.
const FIRST_SORTED: usize = 256;
/// Clusters of a tile that hide so little of each other that all rounds of one are drawn at once.
const FEW_CLUSTERS: usize = 6;
/// Stretches of lines of wide clusters on a tile that hide as little.
const FEW_CROSSINGS: usize = 64;
/// Where the first round leaves so large a part of a tile open, pixels that are covered are not worth to be noted.
const OPEN_PART: f32 = 0.95;
/// Where so little of a tile is open from the start, lines that come first hide few of those behind.
const KNOWN_PART: f32 = 0.75;
/// Tiles that a thread draws in one go.
const MOST_TILES: usize = 8;

/// A band of the picture with all that goes on it.
#[derive(Clone, Copy)]
pub(super) struct Band<'a> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) grid: &'a Grid,
    pub(super) index: &'a Index,
    pub(super) sights: &'a Sights,
    pub(super) bins: &'a Bins,
    /// What of the tiles is drawn.
    pub(super) parts: &'a Parts,
    /// What the rest shows.
    pub(super) kept: Option<&'a Kept>,
    /// What is full for certain.
    pub(super) known: Known<'a>,
    /// Where it is found out what will be.
    pub(super) filling: Option<Filling<'a>>,
    /// Half the stroke width of all paths, if it is one.
    pub(super) common_radius_px: Option<f64>,
    /// Half the stroke width of the widest path.
    pub(super) widest_px: f64,
    /// One for each thread.
    pub(super) painters: &'a [Mutex<Painter>],
}

/// What a frame fills for certain, found for others.
#[derive(Clone, Copy)]
pub(super) struct Filling<'a> {
    /// The frame, with thinner strokes.
    pub(super) shot: &'a Shot<'a>,
    pub(super) filled: &'a Filled,
    /// What is full for certain wherever that will hold.
    pub(super) known: Known<'a>,
}

/// The part of a tile that is drawn.
pub(super) struct Tile {
    index: usize,
    pub(super) corner: Point<f64>,
    width_px: usize,
    height_px: usize,
}

impl<'a> Band<'a> {
    /// Paints the colors into the pixels of the band.
    pub(super) fn color(
        &self,
        pixels: &mut [[u8; 4]],
        solid: Option<Rgba>,
    ) -> Result<(), RenderError> {
        let background = self.shot.style.background;
        let load = |row_px: usize, pixels: &mut [[u8; 4]]| self.load(row_px, pixels);
        let Some(color) = solid else {
            let backdrop = Backdrop::new(background);
            let empty = background.to_u32().to_be_bytes();
            return self.for_each_tile(pixels, load, empty, |painter, tile, pixels| {
                paint_layers_by(self.shot.lane_width, self, painter, tile);
                let look = Look::Layers(&painter.layers, &backdrop);
                look.show(self.shot.lane_width, tile.width_px, pixels);
            });
        };
        let colors = solid_colors(color, background);
        self.for_each_tile(pixels, load, colors[0], |painter, tile, pixels| {
            self.paint_solid(painter, tile);
            let look = Look::Solid(&painter.solid, &colors);
            look.show(self.shot.lane_width, tile.width_px, pixels);
            if let Some(filling) = self.filling {
                self.fill(filling, painter, tile);
            }
        })
    }

    /// Covers samples with all that lies on a tile and is not known to be full.
    fn paint_solid(&self, painter: &mut Painter, tile: &Tile) {
        let full = self.known.tile(self.shot.lane_width, tile.corner);
        if full == [u32::MAX; TILE_PX] {
            painter.solid.begin_closed();
        } else {
            paint_solid_by(self.shot.lane_width, self, painter, tile, &full);
        }
    }

    /// Finds what thinner strokes fill of the pixels that are full.
    fn fill(&self, filling: Filling<'a>, painter: &mut Painter, tile: &Tile) {
        let Filling {
            shot,
            filled,
            known,
        } = filling;
        if !filled.rows.contains(&(tile.corner.y as usize / TILE_PX)) {
            return;
        }
        let thinner = Self {
            shot,
            common_radius_px: shot.common_radius_px(),
            widest_px: shot.widest_px(),
            ..*self
        };
        let known = known.tile(shot.lane_width, tile.corner);
        let (touched, in_view) = painter.solid.marked_pixels(tile.width_px, tile.height_px);
        let mut closed = in_view;
        for (closed, known) in closed.iter_mut().zip(&known) {
            *closed = !*closed | known;
        }
        paint_solid_by(shot.lane_width, &thinner, painter, tile, &closed);
        let (_, mut full) = painter.solid.marked_pixels(tile.width_px, tile.height_px);
        for (full, in_view) in full.iter_mut().zip(&in_view) {
            *full &= in_view;
        }
        filled.store(tile.corner, touched, &full);
    }

    /// Writes how many paths cover each pixel of the band, on average over its square.
    pub(super) fn density(&self, pixels: &mut [f32]) -> Result<(), RenderError> {
        self.for_each_tile(
            pixels,
            |row_px, pixels| self.load(row_px, cast_slice_mut(pixels)),
            0.0,
            |painter, tile, pixels| {
                paint_counts_by(self.shot.lane_width, self, painter, tile);
                for (pixels, counts) in pixels.rows().zip(painter.counts.iter()) {
                    for (pixel, &count) in pixels.iter_mut().zip(counts) {
                        *pixel = count as f32 / Samples::<LAYERED>::COUNT as f32;
                    }
                }
            },
        )
    }

    /// What rows of pixels show that are not drawn, from one of the picture on.
    fn load(&self, row_px: usize, pixels: &mut [[u8; 4]]) {
        if let Some(kept) = self.kept {
            kept.load(row_px, pixels);
        }
    }

    /// Calls `paint` for each part of a tile that is drawn and not empty, with its rows of pixels; `load` before,
    /// for all rows of a row of tiles.
    fn for_each_tile<P: Copy + Send + Sync>(
        &self,
        pixels: &mut [P],
        load: impl Fn(usize, &mut [P]) + Sync,
        empty: P,
        paint: impl Fn(&mut Painter, &Tile, &mut Pixels<'_, '_, P>) + Sync,
    ) -> Result<(), RenderError> {
        let width_px = self.shot.view.size().width() as usize;
        let rows = pixels.par_chunks_mut(width_px * TILE_PX);
        rows.enumerate().try_for_each(|(row, pixels)| {
            load((self.grid.rows.start + row) * TILE_PX, pixels);
            self.for_each_of(row, Stretch::new(pixels, width_px), empty, &paint)
        })
    }

    /// The same for some tiles of a row, by as many threads as are free.
    fn for_each_of<P: Copy + Send + Sync>(
        &self,
        row: usize,
        mut stretch: Stretch<'_, P>,
        empty: P,
        paint: &(impl Fn(&mut Painter, &Tile, &mut Pixels<'_, '_, P>) + Sync),
    ) -> Result<(), RenderError> {
        if stretch.columns.len() > MOST_TILES {
            let [left, right] = stretch.halves();
            let (left, right) = rayon::join(
                || self.for_each_of(row, left, empty, paint),
                || self.for_each_of(row, right, empty, paint),
            );
            return left.and(right);
        }
        let mut painter = own(self.painters);
        let tile_row = self.grid.rows.start + row;
        for column in stretch.columns.clone() {
            self.shot.cancel.check()?;
            let part = self.parts.at(column, tile_row);
            if part.is_empty() {
                continue;
            }
            let (columns, rows) = (part.columns(), part.rows());
            let tile = Tile {
                index: self.grid.tile(column, tile_row),
                corner: Point::new(
                    (column * TILE_PX + columns.start) as f64,
                    (tile_row * TILE_PX + rows.start) as f64,
                ),
                width_px: columns.len(),
                height_px: rows.len(),
            };
            let mut drawn = stretch.tile(column, columns, rows);
            painter.clusters.clear();
            painter.clusters.extend(self.bins.clusters(tile.index));
            let mut crossings = self.bins.crossings(tile.index);
            if painter.clusters.is_empty() && crossings.all(<[_]>::is_empty) {
                drawn.rows().for_each(|row| row.fill(empty));
            } else {
                // Written a frame ago, they are in no near cache.
                drawn.rows().for_each(|row| prefetch(row));
                paint(&mut painter, &tile, &mut drawn);
            }
        }
        Ok(())
    }
}

// A function each: in one, each would be compiled with less care for the others' sake.
by_lane_width!(
    fn paint_solid_by(band: &Band<'_>, painter: &mut Painter, tile: &Tile, closed: &Rows)
    by paint_solid
);
by_lane_width!(
    fn paint_layers_by(band: &Band<'_>, painter: &mut Painter, tile: &Tile)
    by paint_layers
);
by_lane_width!(
    fn paint_counts_by(band: &Band<'_>, painter: &mut Painter, tile: &Tile)
    by paint_counts
);

/// Covers samples with all that lies on the tile, in any order, until all are covered.
#[inline(always)]
fn paint_solid(band: &Band<'_>, painter: &mut Painter, tile: &Tile, closed: &Rows) {
    let Painter {
        solid: canvas,
        solid_discs: discs,
        clusters,
        ..
    } = painter;
    canvas.begin(tile.width_px, tile.height_px);
    let seen = canvas.open_count() as f32;
    canvas.close_pixels(closed);
    let open = canvas.open_count() as f32;
    let is_sparse = clusters.len() <= FEW_CLUSTERS;
    // What is found out for other frames is which pixels are covered.
    let may_stay_open = band.filling.is_none();
    let crossings = || band.bins.crossings(tile.index);
    if may_stay_open && is_sparse && crossings().map(<[_]>::len).sum::<usize>() <= FEW_CROSSINGS {
        canvas.stay_open();
    }
    let least_open = open * OPEN_PART;
    for of_cluster in crossings().flat_map(|all| all.chunk_by(|a, b| a.key == b.key)) {
        if canvas.is_full() {
            return;
        }
        let seen = Seen::<SOLID>::new(band, tile, of_cluster[0].key);
        seen.solid(canvas, discs, Share::Crossings(of_cluster));
    }
    let is_known = open <= seen * KNOWN_PART;
    let at_once = if is_sparse || is_known { ROUNDS } else { 1 };
    for first in (0..ROUNDS).step_by(at_once) {
        if may_stay_open && first == 1 && canvas.open_count() as f32 >= least_open {
            canvas.stay_open();
        }
        for (i, &key) in clusters.iter().enumerate() {
            if canvas.is_full() {
                return;
            }
            ask_for_next(band, clusters, i);
            let share = Share::Rounds(first..first + at_once);
            Seen::<SOLID>::new(band, tile, key).solid(canvas, discs, share);
        }
    }
}

/// Lays the tile's paths from the highest draw rank down, until nothing below can be seen.
#[inline(always)]
fn paint_layers(band: &Band<'_>, painter: &mut Painter, tile: &Tile) {
    let Painter {
        layers: canvas,
        discs,
        hits,
        clusters,
        ..
    } = painter;
    canvas.begin_layers(tile.width_px, tile.height_px);
    hits.clear();
    for (i, &key) in clusters.iter().enumerate() {
        ask_for_next(band, clusters, i);
        Seen::<LAYERED>::new(band, tile, key).gather(key, hits);
    }
    for crossing in band.bins.crossings(tile.index).flatten() {
        Seen::<LAYERED>::new(band, tile, crossing.key).add(crossing, hits);
    }
    let mut layers = Layers::new(band, tile, canvas, discs, None);
    let mut below = &mut hits[..];
    let mut count = FIRST_SORTED;
    while !below.is_empty() && !layers.is_full() {
        if count < below.len() {
            below.select_nth_unstable_by_key(count, |hit| Reverse(hit.rank));
        }
        let top;
        (top, below) = below.split_at_mut(count.min(below.len()));
        top.sort_unstable_by_key(|hit| Reverse(hit.rank));
        for hit in top.iter() {
            layers.add(hit);
        }
        count *= 2;
    }
    layers.finish();
}

/// Counts the samples that each path covers.
#[inline(always)]
fn paint_counts(band: &Band<'_>, painter: &mut Painter, tile: &Tile) {
    let Painter {
        layers: canvas,
        discs,
        hits,
        counts,
        clusters,
        ..
    } = painter;
    canvas.begin_layers(tile.width_px, tile.height_px);
    **counts = [[0; TILE_PX]; TILE_PX];
    let mut layers = Layers::new(band, tile, canvas, discs, Some(counts));
    hits.clear();
    for (i, &key) in clusters.iter().enumerate() {
        ask_for_next(band, clusters, i);
        Seen::<LAYERED>::new(band, tile, key).gather(key, hits);
        // No closure, for that would be compiled for any processor.
        for hit in hits.iter() {
            layers.add(hit);
        }
        hits.clear();
    }
    for crossing in band.bins.crossings(tile.index).flatten() {
        Seen::<LAYERED>::new(band, tile, crossing.key).add(crossing, hits);
    }
    for hit in hits.iter() {
        layers.add(hit);
    }
    layers.finish();
}
