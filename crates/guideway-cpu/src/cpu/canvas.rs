mod bits;
mod show;
#[cfg(test)]
mod tests;

use std::ops::Range;

use guideway_scene::Rgba;
use guideway_spline::Point;

pub(super) use self::bits::set_bits;
use self::bits::{full_pixels, high_bits, low_bits, pixel_counts};
pub(super) use self::show::Look;
use super::span::{ROWS, SOLID, Spans};

/// Pixels along each side of a tile: a bit of a word each.
pub(super) const TILE_PX: usize = u32::BITS as usize;
/// Columns of samples of a window: pixels side by side that share a block of samples. A tile of `C` columns a
/// pixel has `C` windows.
const WINDOW_COLUMNS: usize = u32::BITS as usize;
/// Most pixels of a window.
const MOST_WINDOW_PX: usize = WINDOW_COLUMNS / SOLID;

/// The samples of a window: a word for each row of samples.
type Block = [u32; ROWS];
/// What still shines through at each sample of a block.
type Clear = [[f32; WINDOW_COLUMNS]; ROWS];
/// One flag for each block: a word for each window, a bit for each row of pixels.
type Flags<const C: usize> = [u32; C];

/// From so many pixels on, beside its width, it pays to find out which of them a row of a stroke needs. Short level lines
/// have fewer.
const WIDE_PX: u32 = 11;

/// What rows of pixels cut from a stroke.
pub(super) trait Cuts {
    /// Its width, in pixels.
    fn width_px(&self) -> u32;
    /// The pixels of a row that the part of the line within reach of it may touch, a bit each.
    fn pixels(&self, row: usize) -> u32;
    /// The samples covered in a row.
    fn spans(&self, row: usize) -> Spans;
}

/// Rows of pixels of a tile, and which pixels of each: a bit each.
#[derive(Clone, Copy)]
pub(super) struct Part {
    pub(super) rows: u32,
    pub(super) pixels: u32,
}

/// A flag for each pixel of a tile: a word for each row.
pub(super) type Rows = [u32; TILE_PX];

/// Which samples of one tile are covered, and by what, from the highest draw rank down.
///
/// Strokes gather as a shape; a fill then lays one color below all that is there, and starts a new shape.
/// Of one opaque color all strokes are one shape, whatever their order: such a canvas is solid.
pub(super) struct Canvas<const C: usize> {
    shape: Box<[[Block; TILE_PX]; C]>,
    /// Blocks where the shape may not be empty.
    touched: Flags<C>,
    /// Pixels of each row where something below can still be seen.
    open_pixels: Rows,
    /// Blocks that have such a pixel.
    open: Flags<C>,
    /// Whether solid strokes take note of pixels that are covered.
    closes: bool,
    opaque: Box<[[Block; TILE_PX]; C]>,
    /// Blocks where something translucent lies.
    glazed: Flags<C>,
    clear: Vec<[Clear; TILE_PX]>,
    /// Red, green, blue (0 to 255) and opacity (0 to 1) of each pixel, times its samples.
    sums: Box<[[[f32; 4]; TILE_PX]; TILE_PX]>,
}

impl<const C: usize> Canvas<C> {
    pub(super) const WINDOW_PX: usize = TILE_PX / C;
    const IS_SOLID: bool = C == SOLID;
    const NO_BLOCKS: [[Block; TILE_PX]; C] = [[[0; ROWS]; TILE_PX]; C];

    pub(super) fn new() -> Self {
        Self {
            shape: Box::new(Self::NO_BLOCKS),
            touched: [0; C],
            open_pixels: [0; TILE_PX],
            open: [0; C],
            closes: true,
            opaque: Box::new(Self::NO_BLOCKS),
            glazed: [0; C],
            clear: Vec::new(),
            sums: Box::new([[[0.0; 4]; TILE_PX]; TILE_PX]),
        }
    }

    /// Most bytes that one holds.
    pub(super) fn bytes(is_opaque: bool) -> u64 {
        let clear = if is_opaque { 0 } else { size_of::<Clear>() };
        let blocks = C * TILE_PX * (2 * size_of::<Block>() + clear);
        (blocks + size_of::<[[[f32; 4]; TILE_PX]; TILE_PX]>()) as u64
    }

    /// Starts an empty tile of which only `width_px` by `height_px` pixels are seen. What is not seen counts
    /// as covered: nothing waits for it.
    pub(super) fn begin(&mut self, width_px: usize, height_px: usize) {
        // Of most tiles from near, few blocks were touched.
        for (blocks, touched) in self.shape.iter_mut().zip(self.touched) {
            set_bits(touched).for_each(|row| blocks[row] = [0; ROWS]);
        }
        (self.touched, self.glazed) = ([0; C], [0; C]);
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

    /// Prepares for strokes that are not solid.
    pub(super) fn begin_layers(&mut self, width_px: usize, height_px: usize) {
        self.begin(width_px, height_px);
        std::mem::swap(&mut self.shape, &mut self.opaque);
        *self.shape = Self::NO_BLOCKS;
        self.touched = [0; C];
        *self.sums = [[[0.0; 4]; TILE_PX]; TILE_PX];
    }

    /// How many pixels lie in blocks that are not empty, and the pixels that are covered, of those that are seen.
    pub(super) fn marked_pixels(&self, width_px: usize, height_px: usize) -> (u32, Rows) {
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

    /// Covers some pixels, of a tile on which nothing lies yet. Nobody looks any more at the samples of a window without open ones.
    #[inline(always)]
    pub(super) fn close_pixels(&mut self, pixels: &Rows) {
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

    /// From now on, pixels that solid strokes cover stay open: to take note of them would cost more than to cover them again.
    pub(super) fn stay_open(&mut self) {
        self.closes = false;
    }

    /// How many pixels are open.
    pub(super) fn open_count(&self) -> u32 {
        self.open_pixels.iter().map(|row| row.count_ones()).sum()
    }

    /// Starts a tile that is covered.
    pub(super) fn begin_closed(&mut self) {
        self.open = [0; C];
        self.open_pixels = [0; TILE_PX];
    }

    /// Blocks where something below can still be seen.
    #[inline(always)]
    pub(super) fn open(&self) -> &Flags<C> {
        &self.open
    }

    /// Whether nothing below can be seen.
    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.open.iter().fold(0, |all, open| all | open) == 0
    }

    /// Whether anything can be seen below what lies between two corners, in pixels.
    #[inline(always)]
    pub(super) fn is_open(&self, least: Point<f32>, most: Point<f32>) -> bool {
        // A float below zero becomes 0: that is the clamp to the tile.
        let end_row = (most.y as usize).saturating_add(1).min(TILE_PX);
        let rows = &self.open_pixels[(least.y as usize).min(end_row)..end_row];
        let open = rows.iter().fold(0, |all, open| all | open);
        open & high_bits(least.x as u32) & low_bits((most.x as u32).saturating_add(1)) != 0
    }

    /// Adds a part of a stroke to the shape.
    #[inline(always)]
    pub(super) fn stroke(&mut self, stroke: &impl Cuts, part: Part) {
        let Part { rows, pixels } = part;
        let is_wide = pixels.count_ones() > stroke.width_px().saturating_add(WIDE_PX);
        for row in set_bits(rows) {
            let pixels = if is_wide {
                pixels & stroke.pixels(row)
            } else {
                pixels
            };
            if let Some(windows) = self.open_windows(row, pixels) {
                let spans = stroke.spans(row);
                self.add_all(windows, row, &spans);
            }
        }
    }

    /// The windows of a row that hold the first and the last open one of some pixels; none if all are covered.
    #[inline(always)]
    fn open_windows(&self, row: usize, pixels: u32) -> Option<Range<usize>> {
        let open = self.open_pixels[row % TILE_PX] & pixels;
        let end = C - open.leading_zeros() as usize / Self::WINDOW_PX;
        (open != 0).then_some(open.trailing_zeros() as usize / Self::WINDOW_PX..end)
    }

    /// Adds what is covered of some windows of a row.
    #[inline(always)]
    fn add_all(&mut self, windows: Range<usize>, row: usize, spans: &Spans) {
        for window in windows {
            self.add(window, row % TILE_PX, spans);
        }
    }

    #[inline(always)]
    fn add(&mut self, window: usize, row: usize, spans: &Spans) {
        let left = (window * WINDOW_COLUMNS) as u32;
        let block = &mut self.shape[window][row];
        let mut all = u32::MAX;
        for ((word, &first), &end) in block.iter_mut().zip(&spans.first).zip(&spans.end) {
            *word |= high_bits(first.max(left) - left) ^ high_bits(end.max(left) - left);
            all &= *word;
        }
        self.touched[window] |= 1 << row;
        if Self::IS_SOLID && self.closes {
            self.close(window, row, all);
        }
    }

    /// Takes note of pixels that are covered, by the samples that are in all rows of a block.
    #[inline(always)]
    fn close(&mut self, window: usize, row: usize, all: u32) {
        let full = full_pixels::<C>(all);
        self.open_pixels[row] &= !(full << (window * Self::WINDOW_PX));
        if all == u32::MAX {
            self.open[window] &= !(1 << row);
        }
    }

    /// Lays a color over the shape, below all that was laid before, and starts a new one.
    #[inline(always)]
    pub(super) fn fill(&mut self, color: Rgba) {
        let [r, g, b] = [color.r, color.g, color.b].map(f32::from);
        let ink = [r, g, b, 1.0];
        let opacity = f32::from(color.a) / 255.0;
        for window in 0..C {
            for row in set_bits(std::mem::take(&mut self.touched[window])) {
                let mut fresh = std::mem::take(&mut self.shape[window][row]);
                for (new, old) in fresh.iter_mut().zip(&self.opaque[window][row]) {
                    *new &= !old;
                }
                let weights = if color.is_opaque() && self.glazed[window] >> row & 1 == 0 {
                    pixel_counts::<C>(&fresh).map(f32::from)
                } else {
                    self.glaze(window, row, &fresh, opacity)
                };
                let sums = &mut self.sums[row][window * Self::WINDOW_PX..];
                for (sum, weight) in sums.iter_mut().zip(weights).take(Self::WINDOW_PX) {
                    for (sum, part) in sum.iter_mut().zip(ink) {
                        *sum += part * weight;
                    }
                }
                if color.is_opaque() {
                    self.cover(window, row, &fresh);
                }
            }
        }
    }

    /// Adds the shape's samples to the `counts` of the tile's pixels, and starts a new shape.
    #[inline(always)]
    pub(super) fn count(&mut self, counts: &mut [[u32; TILE_PX]; TILE_PX]) {
        for window in 0..C {
            for row in set_bits(std::mem::take(&mut self.touched[window])) {
                let shape = std::mem::take(&mut self.shape[window][row]);
                let counts = &mut counts[row][window * Self::WINDOW_PX..];
                let fresh = pixel_counts::<C>(&shape);
                for (count, n) in counts.iter_mut().zip(fresh).take(Self::WINDOW_PX) {
                    *count += u32::from(n);
                }
            }
        }
    }

    #[inline(always)]
    fn cover(&mut self, window: usize, row: usize, fresh: &Block) {
        let mut all = u32::MAX;
        for (old, new) in self.opaque[window][row].iter_mut().zip(fresh) {
            *old |= new;
            all &= *old;
        }
        self.close(window, row, all);
    }

    /// Takes `opacity` of what shines through at the samples of `fresh`; gives what each pixel took.
    #[inline(always)]
    fn glaze(
        &mut self,
        window: usize,
        row: usize,
        fresh: &Block,
        opacity: f32,
    ) -> [f32; MOST_WINDOW_PX] {
        const ALL: Clear = [[1.0; WINDOW_COLUMNS]; ROWS];
        if self.clear.is_empty() {
            self.clear = vec![[ALL; TILE_PX]; C];
        }
        let block = &mut self.clear[window][row];
        if self.glazed[window] >> row & 1 == 0 {
            self.glazed[window] |= 1 << row;
            *block = ALL;
        }
        let mut rows = 0_u32;
        for (row, word) in fresh.iter().enumerate() {
            rows |= u32::from(*word != 0) << row;
        }
        let rows = rows.trailing_zeros() as usize..(u32::BITS - rows.leading_zeros()) as usize;
        // Column by column, for sums of neighbors would be found one after the other.
        let mut taken = [[0.0; C]; MOST_WINDOW_PX];
        for row in rows {
            let (clear, word) = (&mut block[row % ROWS], fresh[row % ROWS]);
            let (pixels, _) = clear.as_chunks_mut::<C>();
            for (pixel, (clear, taken)) in pixels.iter_mut().zip(&mut taken).enumerate() {
                let bits = word >> (pixel * C);
                for column in 0..C {
                    let is_taken = bits >> column & 1 == 1;
                    let part = if is_taken {
                        clear[column] * opacity
                    } else {
                        0.0
                    };
                    taken[column] += part;
                    clear[column] -= part;
                }
            }
        }
        taken.map(|columns| columns.into_iter().sum())
    }
}
