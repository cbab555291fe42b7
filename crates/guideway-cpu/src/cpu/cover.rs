use guideway_render::RenderError;
use guideway_spline::Point;
use rayon::prelude::*;

use super::bin::{Bins, Grid};
use super::canvas::{Canvas, PIXEL_SAMPLES};
use super::lines::{Line, Lines, Shot};
use super::span::TILE_PX;

/// Strokes of one colour after which it is worth a look whether anything is left to be covered.
const STROKES_A_FILL: usize = 32;

/// The lines of a band of the picture, by tile.
#[derive(Clone, Copy)]
pub(super) struct Band<'a> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) grid: &'a Grid,
    pub(super) lines: &'a Lines,
    pub(super) bins: &'a Bins,
}

/// One tile, and its place in the pixels of its row of tiles.
struct Tile {
    index: usize,
    corner: Point<f32>,
    left_px: usize,
    width_px: usize,
    height_px: usize,
}

impl Band<'_> {
    /// Paints the colours into the pixels of the band.
    pub(super) fn color(&self, pixels: &mut [[u8; 4]]) -> Result<(), RenderError> {
        let background = self.shot.style.background;
        self.for_each_tile(pixels, |canvas, tile, rows| {
            self.paint(canvas, tile);
            for (y, pixels) in rows.enumerate() {
                canvas.row_over(y, background, pixels);
            }
        })
    }

    /// Writes how many paths cover each pixel of the band, on average over its square.
    pub(super) fn density(&self, pixels: &mut [f32]) -> Result<(), RenderError> {
        self.for_each_tile(pixels, |canvas, tile, rows| {
            let counts = self.count(canvas, tile);
            for (pixels, counts) in rows.zip(counts.chunks(TILE_PX)) {
                for (pixel, &count) in pixels.iter_mut().zip(counts) {
                    *pixel = count as f32 / PIXEL_SAMPLES as f32;
                }
            }
        })
    }

    /// Calls `paint` for each tile, with its part of each row of pixels.
    fn for_each_tile<P: Send>(
        &self,
        pixels: &mut [P],
        paint: impl Fn(&mut Canvas, &Tile, &mut dyn Iterator<Item = &mut [P]>) + Sync,
    ) -> Result<(), RenderError> {
        let width_px = self.shot.view.size().width() as usize;
        let rows = pixels.par_chunks_mut(width_px * TILE_PX).enumerate();
        rows.try_for_each_init(Canvas::new, |canvas, (row, pixels)| {
            let height_px = pixels.len() / width_px;
            let top_px = (self.grid.rows.start + row) * TILE_PX;
            for column in 0..self.grid.columns {
                self.shot.cancel.check()?;
                let left_px = column * TILE_PX;
                let tile = Tile {
                    index: row * self.grid.columns + column,
                    corner: Point::new(left_px as f32, top_px as f32),
                    left_px,
                    width_px: TILE_PX.min(width_px - left_px),
                    height_px,
                };
                let within = tile.left_px..tile.left_px + tile.width_px;
                let rows = pixels.chunks_exact_mut(width_px);
                paint(canvas, &tile, &mut rows.map(|row| &mut row[within.clone()]));
            }
            Ok(())
        })
    }

    /// Lays the tile's paths from the highest draw rank down, until nothing below can be seen. Of one
    /// opaque colour, it does not matter which path a sample belongs to: they share a shape.
    fn paint(&self, canvas: &mut Canvas, tile: &Tile) {
        canvas.begin(tile.width_px, tile.height_px);
        let mut layer = None;
        let mut strokes = 0;
        for line in self.lines_from_the_top(tile) {
            let color = self.shot.scene.color(line.path);
            let path = (!color.is_opaque()).then_some(line.path);
            let is_same = layer == Some((color, path));
            if !is_same || (color.is_opaque() && strokes == STROKES_A_FILL) {
                if let Some((color, _)) = layer {
                    canvas.fill(color);
                }
                if canvas.is_full() {
                    return;
                }
                layer = Some((color, path));
                strokes = 0;
            }
            self.stroke(canvas, tile, line);
            strokes += 1;
        }
        if let Some((color, _)) = layer {
            canvas.fill(color);
        }
    }

    /// Counts the samples that each path covers.
    fn count(&self, canvas: &mut Canvas, tile: &Tile) -> [u32; TILE_PX * TILE_PX] {
        canvas.begin(tile.width_px, tile.height_px);
        let mut counts = [0; TILE_PX * TILE_PX];
        let mut path = None;
        for line in self.lines_from_the_top(tile) {
            if path.is_some_and(|path| path != line.path) {
                canvas.count(&mut counts);
            }
            path = Some(line.path);
            self.stroke(canvas, tile, line);
        }
        canvas.count(&mut counts);
        counts
    }

    fn lines_from_the_top(&self, tile: &Tile) -> impl Iterator<Item = &Line> {
        self.lines.falling(self.bins.tile(tile.index).rev())
    }

    fn stroke(&self, canvas: &mut Canvas, tile: &Tile, line: &Line) {
        let radius_px = self.shot.radius_px(line.path) as f32;
        canvas.stroke(line.start - tile.corner, line.end - tile.corner, radius_px);
    }
}
