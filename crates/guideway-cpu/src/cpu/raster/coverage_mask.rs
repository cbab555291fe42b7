//! Coverage mask of a tile: which samples its strokes cover, one bit per sample.
//!
//! Input: capsules, row by row of pixels. Output: the samples as bits for [`super::resolve`], or
//! summed colors and counts per pixel.

mod composite;
pub(crate) mod stored;
#[cfg(test)]
mod tests;

use std::ops::Range;

use guideway_spline::Point;

use super::bits::{
    SampleBlock, WINDOW_COLUMNS, full_pixels, high_bits, low_bits, pixel_counts, set_bits,
    window_bits,
};
use super::capsule::RowSpans;
use crate::cpu::ground::samples::{ROWS, SOLID};
use crate::cpu::ground::tile::{PixelRows, SampleHalves, TILE_PX};

/// Transmittance of each sample of a block, from 0 to 1.
type Transmittance = [[f32; WINDOW_COLUMNS]; ROWS];
/// One flag per block: a word per window, a bit per row of pixels.
type DirtyBits<const C: usize> = [u32; C];

/// Least number of pixels, beside the width of the stroke, for which a row of pixels is restricted
/// to those it needs. Measured by `guideway bench d1 --methods cpu --magnify 20`.
const WIDE_PX: u32 = 11;

/// Coverage of a stroke, row by row.
pub(crate) trait RowCoverage {
    /// Stroke width in pixels.
    fn width_px(&self) -> u32;
    /// The pixels of a row that the stroke may touch, one bit each.
    fn pixels(&self, row: usize) -> u32;
    /// The samples covered in a row of pixels.
    fn spans(&self, row: usize) -> RowSpans;
}

/// Rows and columns of pixels of a tile, one bit each.
#[derive(Clone, Copy)]
pub(crate) struct PixelBox {
    pub(crate) rows: u32,
    pub(crate) pixels: u32,
}

/// The samples of one tile: which are covered, and by what, from the highest draw rank down.
///
/// Strokes are collected as a shape. [`Self::composite`] draws one color below all that is there,
/// wherever the shape is, and starts a new shape. If all is one opaque color, all strokes are one
/// shape in any order: such a mask is solid (`C` = [`SOLID`]).
///
/// ```text
///   tile: 32 x 32 px, C windows of 32 sample columns    block: one row of pixels of a window
///
///         window 0      window C-1                        16 rows of 32 samples, a word each
///       +---------+   +---------+                         row 0   ################................
///       | block 0 |...| block 0 |  row 0 of pixels        row 1   ################................
///       | block 1 |   | block 1 |  row 1                   ...     32 / C pixels side by side
///       |   ...   |   |   ...   |
///       +---------+   +---------+
/// ```
pub(crate) struct CoverageMask<const C: usize> {
    pub(super) shape: Box<[[SampleBlock; TILE_PX]; C]>,
    /// Blocks in which the shape may have samples.
    pub(super) touched: DirtyBits<C>,
    /// Pixels of each row through which lower paths are visible.
    open_pixels: PixelRows,
    /// Blocks with such a pixel.
    pub(super) open: DirtyBits<C>,
    /// True if solid strokes record full pixels.
    closes: bool,
    opaque: Box<[[SampleBlock; TILE_PX]; C]>,
    /// Blocks with something translucent.
    translucent: DirtyBits<C>,
    transmittance: Vec<[Transmittance; TILE_PX]>,
    /// Sums over the samples of each pixel: red, green, blue (0 to 255) and opacity (0 to 1).
    pub(super) sums: Box<[[[f32; 4]; TILE_PX]; TILE_PX]>,
}

impl<const C: usize> CoverageMask<C> {
    pub(crate) const WINDOW_PX: usize = TILE_PX / C;
    const IS_SOLID: bool = C == SOLID;
    const NO_BLOCKS: [[SampleBlock; TILE_PX]; C] = [[[0; ROWS]; TILE_PX]; C];

    pub(crate) fn new() -> Self {
        Self {
            shape: Box::new(Self::NO_BLOCKS),
            touched: [0; C],
            open_pixels: [0; TILE_PX],
            open: [0; C],
            closes: true,
            opaque: Box::new(Self::NO_BLOCKS),
            translucent: [0; C],
            transmittance: Vec::new(),
            sums: Box::new([[[0.0; 4]; TILE_PX]; TILE_PX]),
        }
    }

    /// Upper bound of the heap bytes held.
    pub(crate) fn bytes(is_opaque: bool) -> u64 {
        let transmittance = if is_opaque {
            0
        } else {
            size_of::<Transmittance>()
        };
        let blocks = C * TILE_PX * (2 * size_of::<SampleBlock>() + transmittance);
        (blocks + size_of::<[[[f32; 4]; TILE_PX]; TILE_PX]>()) as u64
    }

    /// Starts an empty tile of `width_px` by `height_px` visible pixels. The rest counts as
    /// covered.
    pub(crate) fn begin(&mut self, width_px: usize, height_px: usize) {
        self.clear_shape();
        (self.touched, self.translucent) = ([0; C], [0; C]);
        self.closes = true;
        for (window, open) in self.open.iter_mut().enumerate() {
            let is_seen = window * Self::WINDOW_PX < width_px;
            *open = if is_seen {
                low_bits(height_px as u32)
            } else {
                0
            };
        }
        self.open_pixels = [0; TILE_PX];
        self.open_pixels[..height_px].fill(low_bits(width_px as u32));
        let last = (width_px - 1) / Self::WINDOW_PX;
        let unseen = !low_bits(((width_px - last * Self::WINDOW_PX) * C) as u32);
        if unseen != 0 {
            self.shape[last] = [[unseen; ROWS]; TILE_PX];
            self.touched[last] = u32::MAX;
        }
    }

    fn clear_shape(&mut self) {
        // In most tiles of a near view few blocks are dirty.
        for (blocks, touched) in self.shape.iter_mut().zip(self.touched) {
            set_bits(touched).for_each(|row| blocks[row] = [0; ROWS]);
        }
    }

    /// Starts an empty tile for shapes that are composited.
    pub(crate) fn begin_layers(&mut self, width_px: usize, height_px: usize) {
        self.begin(width_px, height_px);
        std::mem::swap(&mut self.shape, &mut self.opaque);
        *self.shape = Self::NO_BLOCKS;
        self.touched = [0; C];
        *self.sums = [[[0.0; 4]; TILE_PX]; TILE_PX];
    }

    /// Number of pixels in blocks with samples, and the visible pixels that are full.
    pub(crate) fn pixel_coverage(&self, width_px: usize, height_px: usize) -> (u32, PixelRows) {
        let seen = low_bits(width_px as u32);
        let mut closed = [0; TILE_PX];
        for (closed, open) in closed.iter_mut().zip(&self.open_pixels).take(height_px) {
            *closed = seen & !open;
        }
        let empty = self.touched.iter().zip(&self.open);
        let empty = empty
            .map(|(touched, open)| (!touched & open).count_ones())
            .sum::<u32>();
        let blocks = (width_px.div_ceil(Self::WINDOW_PX) * height_px) as u32;
        ((blocks - empty) * Self::WINDOW_PX as u32, closed)
    }

    /// Covers some pixels of an empty tile. Samples of windows without open pixels are left unset:
    /// nothing reads them.
    #[inline(always)]
    pub(crate) fn close_pixels(&mut self, pixels: &PixelRows) {
        let mut closed = [0; TILE_PX];
        for row in 0..TILE_PX {
            closed[row] = self.open_pixels[row] & pixels[row];
            self.open_pixels[row] &= !pixels[row];
        }
        for window in 0..C {
            let of_window = low_bits(Self::WINDOW_PX as u32) << (window * Self::WINDOW_PX);
            let (mut open, mut part) = ([0; TILE_PX], [0; TILE_PX]);
            for row in 0..TILE_PX {
                let is_open = self.open_pixels[row] & of_window != 0;
                open[row] = if is_open { 1 << row } else { 0 };
                let is_part = is_open & (closed[row] & of_window != 0);
                part[row] = if is_part { 1 << row } else { 0 };
            }
            self.open[window] &= open.iter().fold(0, |all, bit| all | bit);
            for row in set_bits(part.iter().fold(0, |all, bit| all | bit)) {
                self.set_samples(window, row % TILE_PX, closed[row % TILE_PX]);
            }
        }
    }

    /// Sets all samples of some pixels of a row in one window.
    #[inline(always)]
    fn set_samples(&mut self, window: usize, row: usize, pixels: u32) {
        let pixels = pixels >> (window * Self::WINDOW_PX);
        let mut mask = 0;
        for pixel in 0..Self::WINDOW_PX {
            mask |= (pixels >> pixel & 1) * (low_bits(C as u32) << (pixel * C));
        }
        for word in &mut self.shape[window][row] {
            *word |= mask;
        }
        self.touched[window] |= 1 << row;
    }

    /// Stops recording full pixels, where recording costs more than covering them again.
    pub(crate) fn skip_closing(&mut self) {
        self.closes = false;
    }

    /// Number of open pixels.
    pub(crate) fn open_count(&self) -> u32 {
        self.open_pixels.iter().map(|row| row.count_ones()).sum()
    }

    /// Starts a tile that is full.
    pub(crate) fn begin_full(&mut self) {
        self.open = [0; C];
        self.open_pixels = [0; TILE_PX];
    }

    /// Blocks with open pixels.
    #[inline(always)]
    pub(crate) fn open(&self) -> &DirtyBits<C> {
        &self.open
    }

    /// Returns `true` if all visible pixels are full.
    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.open.iter().fold(0, |all, open| all | open) == 0
    }

    /// Returns `true` if a box, in pixels, holds an open pixel.
    #[inline(always)]
    pub(crate) fn is_open(&self, min: Point<f32>, max: Point<f32>) -> bool {
        // Casting a negative float gives 0, which clamps to the tile.
        let end_row = (max.y as usize).saturating_add(1).min(TILE_PX);
        let rows = &self.open_pixels[(min.y as usize).min(end_row)..end_row];
        let open = rows.iter().fold(0, |all, open| all | open);
        open & high_bits(min.x as u32) & low_bits((max.x as u32).saturating_add(1)) != 0
    }

    /// Adds a part of a stroke to the shape.
    #[inline(always)]
    pub(crate) fn stroke(&mut self, stroke: &impl RowCoverage, part: PixelBox) {
        for row in set_bits(part.rows) {
            if let Some(windows) = self.open_windows(stroke, row, part.pixels) {
                let spans = stroke.spans(row);
                self.add_all(windows, row, &spans);
            }
        }
    }

    /// The windows from the first to the last open one that a part of a stroke may touch in a row
    /// of pixels; `None` if all are full.
    #[inline(always)]
    fn open_windows(
        &self,
        stroke: &impl RowCoverage,
        row: usize,
        pixels: u32,
    ) -> Option<Range<usize>> {
        // The same in all rows of a stroke.
        let is_wide = pixels.count_ones() > stroke.width_px().saturating_add(WIDE_PX);
        let pixels = if is_wide {
            pixels & stroke.pixels(row)
        } else {
            pixels
        };
        let open = self.open_pixels[row % TILE_PX] & pixels;
        (open != 0).then_some(Self::windows_of(open))
    }

    /// The windows from the first to the last one of some columns of pixels, one bit each.
    #[inline(always)]
    fn windows_of(pixels: u32) -> Range<usize> {
        let end = C - pixels.leading_zeros() as usize / Self::WINDOW_PX;
        (pixels.trailing_zeros() as usize / Self::WINDOW_PX).min(end)..end
    }

    /// Adds the coverage of some windows of a row.
    #[inline(always)]
    fn add_all(&mut self, windows: Range<usize>, row: usize, spans: &RowSpans) {
        for window in windows {
            self.add(window, row % TILE_PX, spans);
        }
    }

    #[inline(always)]
    fn add(&mut self, window: usize, row: usize, spans: &RowSpans) {
        let left = (window * WINDOW_COLUMNS) as u32;
        let block = &mut self.shape[window][row];
        let mut all = u32::MAX;
        let fresh = window_bits(&spans.first, &spans.end, left);
        for (word, new) in block.iter_mut().zip(fresh) {
            *word |= new;
            all &= *word;
        }
        self.touched[window] |= 1 << row;
        if Self::IS_SOLID && self.closes {
            self.close(window, row, all);
        }
    }

    /// Records full pixels of a block; `all` has the samples that are covered in every row.
    #[inline(always)]
    fn close(&mut self, window: usize, row: usize, all: u32) {
        let full = full_pixels::<C>(all);
        self.open_pixels[row] &= !(full << (window * Self::WINDOW_PX));
        if all == u32::MAX {
            self.open[window] &= !(1 << row);
        }
    }

    /// Adds `halves` per sample of the shape to the `counts` of pixels, and starts a new shape. The
    /// shape may touch the columns of `pixels`, one bit each.
    #[inline(always)]
    pub(crate) fn count(&mut self, halves: i32, pixels: u32, counts: &mut SampleHalves) {
        for window in Self::windows_of(pixels) {
            for row in set_bits(std::mem::take(&mut self.touched[window])) {
                let shape = std::mem::take(&mut self.shape[window][row]);
                let counts = &mut counts[row][window * Self::WINDOW_PX..];
                let fresh = pixel_counts::<C>(&shape);
                for (count, n) in counts.iter_mut().zip(fresh).take(Self::WINDOW_PX) {
                    *count += halves * i32::from(n);
                }
            }
        }
    }

    /// Adds `halves` per sample of a part of a stroke to the `counts` of pixels, as if it were a
    /// shape by itself, without the mask.
    #[inline(always)]
    pub(crate) fn count_stroke(
        &self,
        stroke: &impl RowCoverage,
        part: PixelBox,
        halves: i32,
        counts: &mut SampleHalves,
    ) {
        for row in set_bits(part.rows) {
            if let Some(windows) = self.open_windows(stroke, row, part.pixels) {
                let spans = stroke.spans(row);
                let pixels = windows.start * Self::WINDOW_PX..windows.end * Self::WINDOW_PX;
                for pixel in pixels {
                    let left = (pixel * C) as u32;
                    let right = left + C as u32;
                    let mut samples = 0;
                    for (&first, &end) in spans.first.iter().zip(&spans.end) {
                        samples += end.max(left).min(right) - first.max(left).min(right);
                    }
                    counts[row % TILE_PX][pixel % TILE_PX] += halves * samples as i32;
                }
            }
        }
    }
}
