//! Density shading: from how many paths cover a pixel, on average over its square, to a color.
//!
//! With a million paths on two million pixels a linear scale shows either the crowd or the single path;
//! the logarithm shows both, and equalizing the histogram spends the colors where the pixels are.

use crate::Rgba;
use rayon::prelude::*;

use crate::Frame;

/// So many pixels are gone through by one thread.
const AT_ONCE: usize = 1 << 16;

/// How counts become lightness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMap {
    /// In proportion.
    Linear,
    /// By the logarithm of one plus the count.
    #[default]
    Log,
    /// By how many of the pixels under more than one path have no larger count, so that each color shows
    /// on as many. As datashader's `eq_hist` (<https://datashader.org>), but that one path and less share
    /// the first color: their opacity tells them apart already.
    Equalized,
}

/// Steps from few to many, dark to light on any background: lightness rises evenly.
const STEPS: [Rgba; 6] = [
    Rgba::opaque(20, 30, 80),
    Rgba::opaque(60, 50, 140),
    Rgba::opaque(140, 60, 140),
    Rgba::opaque(220, 90, 100),
    Rgba::opaque(250, 160, 70),
    Rgba::opaque(250, 240, 150),
];

/// Colors a frame from `counts`, the mean number of covering paths of each pixel, all of which it has.
///
/// # Panics
/// When there is not one count a pixel.
pub fn shade(counts: &[f32], tone: ToneMap, background: Rgba, frame: &mut Frame) {
    let mut tones = Tones::new(tone);
    tones.look(counts);
    tones.shade(counts, background, frame);
}

/// How counts become colors in one picture, all of which was looked at. The largest count gets the last color, unless
/// nothing is above one path and the histogram is equalized; below one path the background shows through.
#[derive(Clone, Debug)]
pub struct Tones {
    tone: ToneMap,
    most: f32,
    histogram: Histogram,
}

impl Tones {
    /// Of a picture that is still to be looked at.
    pub fn new(tone: ToneMap) -> Self {
        Self {
            tone,
            most: 1.0,
            histogram: Histogram::default(),
        }
    }

    /// Looks at a part of the picture: the mean number of covering paths of each pixel, none of which is negative.
    pub fn look(&mut self, counts: &[f32]) {
        let is_equalized = self.tone == ToneMap::Equalized;
        let parts = counts.par_chunks(AT_ONCE).map(|counts| {
            // The bits of numbers go up as they do, and their greatest is found by vectors.
            let most = counts.iter().map(|count| count.to_bits()).max();
            let mut histogram = Histogram::default();
            if is_equalized {
                histogram.add(counts);
            }
            (most.unwrap_or(0), histogram)
        });
        let (most, histogram) = parts.reduce(Default::default, |a, b| (a.0.max(b.0), a.1.and(b.1)));
        self.most = self.most.max(f32::from_bits(most));
        self.histogram = std::mem::take(&mut self.histogram).and(histogram);
    }

    /// Colors a frame, which is a part of the picture.
    ///
    /// # Panics
    /// When there is not one count a pixel.
    pub fn shade(&self, counts: &[f32], background: Rgba, frame: &mut Frame) {
        assert_eq!(counts.len(), frame.pixels().len(), "one count a pixel");
        let most = f64::from(self.most);
        let most_log = most.ln_1p();
        let ranks = self.histogram.ranks();
        // At least one pixel, for there may be none.
        let most_rank = ranks.up_to(self.most).max(1.0);
        let ramp = Ramp::new(self.most, background, |count| match self.tone {
            ToneMap::Linear => f64::from(count) / most,
            ToneMap::Log => f64::from(count).ln_1p() / most_log,
            ToneMap::Equalized => ranks.up_to(count) / most_rank,
        });
        let pixels = frame.pixels_mut().par_chunks_mut(AT_ONCE);
        let parts = pixels.zip(counts.par_chunks(AT_ONCE));
        parts.for_each(|(pixels, counts)| {
            for (pixel, &count) in pixels.iter_mut().zip(counts) {
                *pixel = ramp.at(count);
            }
        });
    }
}

/// The pixels of counts, of each that is a thousandth more, and a thousandth of itself, than the one before. Those of up to
/// 2048 that are a whole number of paths or, below one, of samples are among them.
struct Ramp(Vec<[u8; 4]>);

impl Ramp {
    /// Bits that tell one from the next: so many parts has what lies between two powers of two.
    const BITS: u32 = 10;
    const BITS_BELOW: u32 = f32::MANTISSA_DIGITS - 1 - Self::BITS;

    /// Up to the largest count; `along` says how far along the steps a count is, from 0 to 1.
    fn new(most: f32, background: Rgba, along: impl Fn(f32) -> f64) -> Self {
        let pixels = (0..=Self::place(most)).map(|place| {
            let bits = ((place as u32) << Self::BITS_BELOW) + 1_f32.to_bits();
            let count = (f32::from_bits(bits) - 1.0).min(most);
            let along = along(count) * (STEPS.len() - 1) as f64;
            let below = (along as usize).min(STEPS.len() - 2);
            let color = STEPS[below].lerp(STEPS[below + 1], along - below as f64);
            let shown = background.lerp(color, f64::from(count.min(1.0)));
            [shown.r, shown.g, shown.b, shown.a]
        });
        Self(pixels.collect())
    }

    #[inline]
    fn at(&self, count: f32) -> [u8; 4] {
        self.0[Self::place(count).min(self.0.len() - 1)]
    }

    /// The nearest of them. The bits of a number go up evenly from one power of two to the next.
    #[inline]
    fn place(count: f32) -> usize {
        let beyond_one = (1.0 + count).to_bits() - 1_f32.to_bits();
        ((beyond_one + (1 << (Self::BITS_BELOW - 1))) >> Self::BITS_BELOW) as usize
    }
}

/// How many pixels have how large a count, among those under more than one path.
#[derive(Clone, Debug, Default)]
struct Histogram {
    bins: Vec<u32>,
}

/// How many of those pixels have at most how large a count.
struct Ranks {
    /// Pixels of each bin and all below.
    up_to: Vec<u32>,
}

impl Histogram {
    /// Bins from one power of two to the next. Whole counts up to twice as many lie in the middle of one,
    /// and bins are wide enough that a count has the same color however a method samples it.
    const A_DOUBLING: u32 = 8;
    /// What the bits of a number go up by from one to the next.
    const BIN: u32 = (2_f32.to_bits() - 1_f32.to_bits()) / Self::A_DOUBLING;

    fn add(&mut self, counts: &[f32]) {
        for &count in counts {
            let bin = Self::bin(count);
            if self.bins.len() <= bin {
                self.bins.resize(bin + 1, 0);
            }
            self.bins[bin] += u32::from(bin > 0);
        }
    }

    /// All pixels of both.
    fn and(mut self, other: Self) -> Self {
        if self.bins.len() < other.bins.len() {
            return other.and(self);
        }
        for (pixels, more) in self.bins.iter_mut().zip(other.bins) {
            *pixels += more;
        }
        self
    }

    fn ranks(&self) -> Ranks {
        let up_to = self.bins.iter().scan(0, |sum, &pixels| {
            *sum += pixels;
            Some(*sum)
        });
        Ranks {
            up_to: up_to.collect(),
        }
    }

    /// Where a count lies, in bins beyond one path. The bits of a number go up evenly from one power of two
    /// to the next, as a logarithm by straight lines.
    fn place(count: f32) -> f64 {
        f64::from(Self::beyond_one(count)) / f64::from(Self::BIN)
    }

    /// The bin in whose middle a count lies, or nearly.
    fn bin(count: f32) -> usize {
        ((Self::beyond_one(count) + Self::BIN / 2) / Self::BIN) as usize
    }

    fn beyond_one(count: f32) -> u32 {
        count.max(1.0).to_bits() - 1_f32.to_bits()
    }
}

impl Ranks {
    /// Pixels with at most this count, by a straight line from the middle of one bin to that of the next.
    fn up_to(&self, count: f32) -> f64 {
        let place = Histogram::place(count);
        let pixels = |bin: usize| {
            let known = self.up_to.get(bin).or(self.up_to.last());
            f64::from(known.copied().unwrap_or(0))
        };
        let bin = place as usize;
        pixels(bin) + (pixels(bin + 1) - pixels(bin)) * place.fract()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrameSize;

    #[test]
    fn nothing_shows_the_background_and_most_the_last_step() {
        let mut frame = Frame::new(FrameSize::new(3, 1).unwrap());
        for tone in [ToneMap::Linear, ToneMap::Log, ToneMap::Equalized] {
            shade(&[0.0, 10.0, 1000.0], tone, Rgba::WHITE, &mut frame);
            assert_eq!(frame.pixels()[0], [255; 4]);
            assert_eq!(frame.pixels()[2], [250, 240, 150, 255]);
        }
    }

    fn colors(counts: &[f32], tone: ToneMap) -> Vec<[u8; 4]> {
        let size = FrameSize::new(counts.len() as u32, 1).unwrap();
        let mut frame = Frame::new(size);
        shade(counts, tone, Rgba::WHITE, &mut frame);
        frame.pixels().to_vec()
    }

    fn step(index: usize) -> [u8; 4] {
        let Rgba { r, g, b, a } = STEPS[index];
        [r, g, b, a]
    }

    #[test]
    fn equalizing_gives_every_fifth_of_the_crowded_pixels_a_step() {
        let counts = [3.0, 1.0, 1024.0, 8.0, 0.5, 2.0, 3.5];
        let shown = colors(&counts, ToneMap::Equalized);
        let half = Rgba::WHITE.lerp(STEPS[0], 0.5);
        let mut expected = [2, 0, 5, 4, 0, 1, 3].map(step);
        expected[4] = [half.r, half.g, half.b, half.a];
        assert_eq!(shown, expected);
    }

    #[test]
    fn many_equal_pixels_take_many_steps() {
        let shown = colors(&[2.0, 2.0, 4.0, 2.0, 2.0], ToneMap::Equalized);
        assert_eq!(shown, [4, 4, 5, 4, 4].map(step));
    }

    #[test]
    fn nothing_beyond_one_path_has_the_first_color() {
        let shown = colors(&[1.0, 1.0, 0.0], ToneMap::Equalized);
        assert_eq!(shown[..2], [0; 2].map(step));
        assert_eq!(shown[2], [255; 4]);
    }

    #[test]
    fn colors_of_many_pixels_are_those_of_their_counts_within_a_level() {
        let mut frame = Frame::new(FrameSize::new(1000, 150).unwrap());
        let count = |i: usize| 0.7 + (i % 1009) as f32 * 0.37;
        let counts: Vec<f32> = (0..frame.pixels().len()).map(count).collect();
        assert!(counts.len() > 2 * AT_ONCE, "several threads look at them");
        let most = f64::from(count(1008));
        let exact = |count: f32, along: f64| {
            let below = (along * 5.0).min(4.0) as usize;
            let color = STEPS[below].lerp(STEPS[below + 1], along * 5.0 - below as f64);
            let Rgba { r, g, b, a } = Rgba::WHITE.lerp(color, f64::from(count.min(1.0)));
            [r, g, b, a]
        };
        for tone in [ToneMap::Log, ToneMap::Linear] {
            shade(&counts, tone, Rgba::WHITE, &mut frame);
            for (shown, &count) in frame.pixels().iter().zip(&counts) {
                let along = match tone {
                    ToneMap::Log => f64::from(count).ln_1p() / most.ln_1p(),
                    _ => f64::from(count) / most,
                };
                let exact = exact(count, along);
                let off = (0..4).map(|i| shown[i].abs_diff(exact[i])).max();
                assert!(off <= Some(1), "{tone:?} {count}: {shown:?}, {exact:?}");
            }
        }
    }

    #[test]
    fn parts_of_a_picture_that_are_looked_at_apart_are_one_picture() {
        let mut at_once = Frame::new(FrameSize::new(100, 30).unwrap());
        let mut by_parts = at_once.clone();
        let counts: Vec<f32> = (0..3000).map(|i| (i * i % 97) as f32 * 0.25).collect();
        shade(&counts, ToneMap::Equalized, Rgba::WHITE, &mut at_once);
        let mut tones = Tones::new(ToneMap::Equalized);
        counts.chunks(700).for_each(|part| tones.look(part));
        tones.shade(&counts, Rgba::WHITE, &mut by_parts);
        assert!(by_parts == at_once);
        let mut of_a_part = Tones::new(ToneMap::Equalized);
        of_a_part.look(&counts[..700]);
        of_a_part.shade(&counts, Rgba::WHITE, &mut by_parts);
        assert!(by_parts != at_once);
    }

    #[test]
    fn a_count_that_is_sampled_a_little_otherwise_looks_much_the_same() {
        let crowd: Vec<f32> = (0..1000).map(|i| 2.0 + (i % 4) as f32).collect();
        let mut histogram = Histogram::default();
        histogram.add(&crowd);
        let ranks = histogram.ranks();
        for count in [1.0, 2.0, 3.0, 4.0] {
            let apart = ranks.up_to(count * 1.01) - ranks.up_to(count);
            assert!((0.0..30.0).contains(&apart), "{count}: {apart}");
        }
    }
}
