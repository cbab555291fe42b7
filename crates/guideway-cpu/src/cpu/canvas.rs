use guideway_scene::Rgba;
use guideway_spline::Point;
use multiversion::multiversion;

use super::span::{Capsule, SAMPLES, Spans, TILE_PX};

/// Pixels of a row that share a word of samples.
const BLOCK_PX: usize = 4;
const BLOCKS_ACROSS: usize = TILE_PX / BLOCK_PX;
const BLOCKS: usize = TILE_PX * BLOCKS_ACROSS;
/// Samples of a pixel.
pub(super) const PIXEL_SAMPLES: usize = SAMPLES * SAMPLES;

/// The samples of four pixels side by side: a word for each row of samples, 16 bits of it for each pixel.
type Block = [u64; SAMPLES];

/// Which samples of one tile are covered, and by what, from the highest draw rank down.
///
/// Strokes gather as a shape; a fill then lays one colour below all that is there, and starts a new shape.
pub(super) struct Canvas {
    shape: Box<[Block; BLOCKS]>,
    /// Blocks where the shape may not be empty, a bit each; so for the next two.
    touched: u64,
    opaque: Box<[Block; BLOCKS]>,
    full: u64,
    /// Blocks where something translucent lies.
    glazed: u64,
    /// What still shines through at each sample of a glazed block.
    clear: Vec<[[f32; BLOCK_PX * SAMPLES]; SAMPLES]>,
    /// Red, green, blue (0 to 255) and opacity (0 to 1) of each pixel, times its samples.
    sums: Box<[[f32; 4]; TILE_PX * TILE_PX]>,
}

impl Canvas {
    pub(super) fn new() -> Self {
        Self {
            shape: Box::new([[0; SAMPLES]; BLOCKS]),
            touched: 0,
            opaque: Box::new([[0; SAMPLES]; BLOCKS]),
            full: 0,
            glazed: 0,
            clear: Vec::new(),
            sums: Box::new([[0.0; 4]; TILE_PX * TILE_PX]),
        }
    }

    /// Most bytes that one holds.
    pub(super) fn bytes() -> u64 {
        let block = 2 * size_of::<Block>() + size_of::<[[f32; BLOCK_PX * SAMPLES]; SAMPLES]>();
        (BLOCKS * block + size_of::<[[f32; 4]; TILE_PX * TILE_PX]>()) as u64
    }

    /// Starts an empty tile of which only `width_px` by `height_px` pixels are seen.
    pub(super) fn begin(&mut self, width_px: usize, height_px: usize) {
        *self.shape = [[0; SAMPLES]; BLOCKS];
        *self.opaque = [[0; SAMPLES]; BLOCKS];
        *self.sums = [[0.0; 4]; TILE_PX * TILE_PX];
        (self.touched, self.full, self.glazed) = (0, 0, 0);
        // What is not seen counts as covered: nothing waits for it.
        for (index, block) in self.opaque.iter_mut().enumerate() {
            let (row, left) = (index / BLOCKS_ACROSS, index % BLOCKS_ACROSS * BLOCK_PX);
            let seen_px = width_px.saturating_sub(left).min(BLOCK_PX);
            if row >= height_px || seen_px == 0 {
                self.full |= 1 << index;
            } else {
                *block = [!low_bits((seen_px * SAMPLES) as u32); SAMPLES];
            }
        }
    }

    /// Whether nothing below can be seen.
    pub(super) fn is_full(&self) -> bool {
        self.full == u64::MAX
    }

    /// Adds a capsule to the shape: pixels from the tile's upper left corner.
    pub(super) fn stroke(&mut self, a: Point<f32>, b: Point<f32>, radius_px: f32) {
        stroke(self, a, b, radius_px);
    }

    #[inline(always)]
    fn add(&mut self, blocks: usize, spans: &Spans) {
        let bits = BLOCK_PX * SAMPLES;
        let first = spans.first.iter().fold(u32::MAX, |a, &b| a.min(b)) as usize;
        let end = spans.end.iter().fold(0, |a, &b| a.max(b)) as usize;
        for across in first / bits..end.div_ceil(bits) {
            let index = blocks + across;
            if self.full >> index & 1 == 1 {
                continue;
            }
            self.touched |= 1 << index;
            let left = (across * bits) as u32;
            let within = |x: u32| x.saturating_sub(left);
            let block = &mut self.shape[index];
            for ((word, &first), &end) in block.iter_mut().zip(&spans.first).zip(&spans.end) {
                *word |= low_bits(within(end)) & !low_bits(within(first));
            }
        }
    }

    /// Lays a colour over the shape, below all that was laid before.
    pub(super) fn fill(&mut self, color: Rgba) {
        let [r, g, b] = [color.r, color.g, color.b].map(f32::from);
        let ink = [r, g, b, 1.0];
        let opacity = f32::from(color.a) / 255.0;
        for index in set_bits(std::mem::take(&mut self.touched)) {
            let mut fresh = std::mem::take(&mut self.shape[index]);
            for (new, old) in fresh.iter_mut().zip(&self.opaque[index]) {
                *new &= !old;
            }
            let weights = if color.is_opaque() && self.glazed >> index & 1 == 0 {
                pixel_counts(&fresh).map(|n| n as f32)
            } else {
                self.glaze(index, &fresh, opacity)
            };
            for (pixel, weight) in pixels_of(index).zip(weights) {
                for (sum, part) in self.sums[pixel].iter_mut().zip(ink) {
                    *sum += part * weight;
                }
            }
            if color.is_opaque() {
                self.cover(index, &fresh);
            }
        }
    }

    fn cover(&mut self, index: usize, fresh: &Block) {
        let mut all = u64::MAX;
        for (old, new) in self.opaque[index].iter_mut().zip(fresh) {
            *old |= new;
            all &= *old;
        }
        if all == u64::MAX {
            self.full |= 1 << index;
        }
    }

    /// Takes `opacity` of what shines through at the samples of `fresh`; gives what each pixel took.
    fn glaze(&mut self, index: usize, fresh: &Block, opacity: f32) -> [f32; BLOCK_PX] {
        if self.clear.is_empty() {
            self.clear = vec![[[1.0; BLOCK_PX * SAMPLES]; SAMPLES]; BLOCKS];
        }
        if self.glazed >> index & 1 == 0 {
            self.glazed |= 1 << index;
            self.clear[index] = [[1.0; BLOCK_PX * SAMPLES]; SAMPLES];
        }
        let mut taken = [0.0; BLOCK_PX];
        for (row, word) in self.clear[index].iter_mut().zip(fresh) {
            let pixels = row.chunks_exact_mut(SAMPLES).zip(&mut taken);
            for (i, (clear, taken)) in pixels.enumerate() {
                let bits = (word >> (i * SAMPLES)) as u32 & 0xffff;
                if bits == 0 {
                    continue;
                }
                let mut sum = 0.0;
                for (j, clear) in clear.iter_mut().enumerate() {
                    let part = if bits >> j & 1 == 1 {
                        *clear * opacity
                    } else {
                        0.0
                    };
                    sum += part;
                    *clear -= part;
                }
                *taken += sum;
            }
        }
        taken
    }

    /// Adds the shape's samples to the `counts` of the tile's pixels, and starts a new shape.
    pub(super) fn count(&mut self, counts: &mut [u32; TILE_PX * TILE_PX]) {
        for index in set_bits(std::mem::take(&mut self.touched)) {
            let shape = std::mem::take(&mut self.shape[index]);
            for (pixel, n) in pixels_of(index).zip(pixel_counts(&shape)) {
                counts[pixel] += n;
            }
        }
    }

    /// The colour of each pixel of one row over the background.
    pub(super) fn row_over(&self, row: usize, background: Rgba, pixels: &mut [[u8; 4]]) {
        let sums = &self.sums[row * TILE_PX..];
        for (pixel, sum) in pixels.iter_mut().zip(sums) {
            *pixel = over(*sum, background);
        }
    }
}

/// [`Canvas::stroke`], by the widest vectors there are: all give the same bits.
#[multiversion(targets("x86_64+avx2", "x86_64+avx512f+avx512dq+avx512vl"))]
fn stroke(canvas: &mut Canvas, a: Point<f32>, b: Point<f32>, radius_px: f32) {
    let capsule = Capsule::new(a, b, radius_px);
    for row in capsule.pixel_rows() {
        let blocks = row * BLOCKS_ACROSS;
        if canvas.full >> blocks & 0b1111 != 0b1111 {
            canvas.add(blocks, &capsule.spans(row));
        }
    }
}

/// The mean of a pixel's samples, of which `sum` is the sum, over the background: straight alpha.
fn over(sum: [f32; 4], background: Rgba) -> [u8; 4] {
    let below = Rgba::to_u32(background).to_be_bytes();
    if sum[3] == 0.0 {
        return below;
    }
    let per_sample = 1.0 / PIXEL_SAMPLES as f32;
    let shines = (1.0 - sum[3] * per_sample).max(0.0) * f32::from(background.a) / 255.0;
    let opacity = sum[3] * per_sample + shines;
    let channel = |i: usize| {
        let color = (sum[i] * per_sample + f32::from(below[i]) * shines) / opacity;
        (color + 0.5) as u8
    };
    [
        channel(0),
        channel(1),
        channel(2),
        (opacity * 255.0 + 0.5) as u8,
    ]
}

/// The pixels of a block, by index in the tile.
fn pixels_of(block: usize) -> std::ops::Range<usize> {
    block * BLOCK_PX..(block + 1) * BLOCK_PX
}

fn set_bits(mut bits: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lowest = (bits != 0).then(|| bits.trailing_zeros() as usize);
        bits &= bits.wrapping_sub(1);
        lowest
    })
}

/// A word with its lowest `count` bits set: all, if that is more than it has.
#[inline(always)]
fn low_bits(count: u32) -> u64 {
    let shift = u64::BITS.saturating_sub(count);
    // As a choice between two values this is one instruction on a vector.
    if shift < u64::BITS {
        u64::MAX >> shift
    } else {
        0
    }
}

/// How many samples are set of each pixel of a block: bits summed within bytes, then bytes within pixels.
fn pixel_counts(block: &Block) -> [u32; BLOCK_PX] {
    let mut bytes = 0;
    for &word in block {
        let pairs = word - (word >> 1 & 0x5555_5555_5555_5555);
        let fours = (pairs & 0x3333_3333_3333_3333) + (pairs >> 2 & 0x3333_3333_3333_3333);
        // At most 8 a word, so 128 in all: the bytes do not overflow.
        bytes += (fours + (fours >> 4)) & 0x0f0f_0f0f_0f0f_0f0f;
    }
    let pixels = (bytes & 0x00ff_00ff_00ff_00ff) + (bytes >> 8 & 0x00ff_00ff_00ff_00ff);
    [0, 16, 32, 48].map(|shift| (pixels >> shift) as u32 & 0xffff)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(canvas: &Canvas, background: Rgba) -> Vec<[u8; 4]> {
        let mut pixels = vec![[0; 4]; TILE_PX * TILE_PX];
        for (row, pixels) in pixels.chunks_mut(TILE_PX).enumerate() {
            canvas.row_over(row, background, pixels);
        }
        pixels
    }

    #[test]
    fn bits_are_counted_by_pixel() {
        let mut block = [0; SAMPLES];
        assert_eq!(pixel_counts(&block), [0; 4]);
        block[3] = 0x0001_8000_ffff_0013;
        assert_eq!(pixel_counts(&block), [3, 16, 1, 1]);
        assert_eq!(pixel_counts(&[u64::MAX; SAMPLES]), [256; 4]);
    }

    #[test]
    fn what_is_laid_first_hides_what_comes_after() {
        let mut canvas = Canvas::new();
        canvas.begin(16, 16);
        let (red, blue) = (Rgba::opaque(255, 0, 0), Rgba::opaque(0, 0, 255));
        canvas.stroke(Point::new(0.0, 4.5), Point::new(16.0, 4.5), 0.5);
        canvas.fill(red);
        canvas.stroke(Point::new(8.5, 0.0), Point::new(8.5, 16.0), 0.25);
        canvas.fill(blue);
        let pixels = drawn(&canvas, Rgba::WHITE);
        assert_eq!(pixels[4 * 16 + 8], [255, 0, 0, 255]);
        assert_eq!(pixels[5 * 16 + 8], [128, 128, 255, 255]);
        assert_eq!(pixels[5 * 16 + 4], [255; 4]);
    }

    #[test]
    fn translucent_paths_are_composited_a_sample_at_a_time() {
        let mut canvas = Canvas::new();
        canvas.begin(16, 16);
        let half_black = Rgba::from_u32(0x0000_0080);
        for _ in 0..2 {
            canvas.stroke(Point::new(0.0, 4.5), Point::new(16.0, 4.5), 0.25);
            canvas.fill(half_black);
        }
        canvas.stroke(Point::new(0.0, 4.5), Point::new(16.0, 4.5), 9.0);
        canvas.fill(Rgba::opaque(0, 255, 0));
        let pixels = drawn(&canvas, Rgba::WHITE);
        let clear = (1.0 - 128.0 / 255.0_f64).powi(2);
        let green = 255.0 * (0.5 + 0.5 * clear);
        assert_eq!(pixels[4 * 16 + 8], [0, green.round() as u8, 0, 255]);
    }

    #[test]
    fn a_translucent_background_shows_through_with_straight_alpha() {
        let background = Rgba::from_u32(0xff00_0080);
        let mut canvas = Canvas::new();
        canvas.begin(16, 16);
        canvas.stroke(Point::new(0.0, 4.5), Point::new(16.0, 4.5), 0.25);
        canvas.fill(Rgba::opaque(0, 0, 255));
        let pixels = drawn(&canvas, background);
        assert_eq!(pixels[0], [255, 0, 0, 128]);
        // Half opaque blue, and a quarter red.
        assert_eq!(pixels[4 * 16 + 8], [85, 0, 170, 192]);
    }

    #[test]
    fn a_tile_is_full_when_all_that_is_seen_is_covered() {
        let mut canvas = Canvas::new();
        canvas.begin(5, 3);
        canvas.stroke(Point::new(0.0, 0.0), Point::new(0.0, 4.0), 4.5);
        canvas.fill(Rgba::BLACK);
        assert!(!canvas.is_full());
        canvas.stroke(Point::new(4.5, 0.0), Point::new(4.5, 4.0), 0.75);
        canvas.fill(Rgba::BLACK);
        assert!(canvas.is_full());
    }
}
