//! Density shading: maps the mean number of paths that cover a pixel to a color.
//!
//! A path counts half within half its width of either end ([`open_ends`]): so does the one that
//! goes on from there, and both together count once, whatever their directions and lengths. With
//! whole round caps each node would be a hot spot.
//!
//! With a million paths on two million pixels, a linear scale shows either crowded or single paths.
//! A logarithm shows both; histogram equalization spreads the colors over the pixels.

mod ends;

use rayon::prelude::*;

use crate::color::Rgba;
use crate::color_by::{Legend, LegendEntry, LegendScale};
use crate::frame::Frame;
use crate::ramp::{COLORS, Ramp, between};

pub use ends::{CLOSED_M, open_ends};

/// Pixels per parallel task: large enough that scheduling costs nothing against the work.
const CHUNK: usize = 1 << 16;

/// Map from counts to positions on the color ramp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMap {
    /// Proportional to the count.
    Linear,
    /// Logarithm of one plus the count.
    #[default]
    Log,
    /// Rank of the count among all pixels under more than one path, so that each color shows on
    /// equally many pixels. Like `eq_hist` of datashader (<https://datashader.org>), except that
    /// counts up to one share the first color: their opacity distinguishes them.
    Equalized,
}

/// Least distance of the numbers of a legend, as a share of its scale: a line of text.
const LEAST_GAP: f64 = 0.12;

/// Colors from few paths to many, of which a picture shows those that stand out from its paper.
const STEPS: [Rgba; 6] = [
    Rgba::opaque(20, 30, 80),
    Rgba::opaque(60, 50, 140),
    Rgba::opaque(140, 60, 140),
    Rgba::opaque(220, 90, 100),
    Rgba::opaque(250, 160, 70),
    Rgba::opaque(250, 240, 150),
];

/// Colors a whole frame from `counts`, the mean number of covering paths per pixel. Returns the
/// meaning of the colors.
///
/// # Panics
/// When `counts` and `frame` differ in length.
pub fn shade(counts: &[f32], tone: ToneMap, background: Rgba, frame: &mut Frame) -> Legend {
    let mut tones = ToneScale::new(tone, background);
    tones.observe(counts);
    tones.shade(counts, frame);
    tones.legend()
}

/// The color scale of one picture, derived from all its counts in a first pass.
///
/// The largest count maps to the last color, except with an equalized histogram and no count above
/// one. Counts below one let the background show through.
#[derive(Clone, Debug)]
pub struct ToneScale {
    tone: ToneMap,
    background: Rgba,
    colors: Ramp,
    max_count: f32,
    histogram: Histogram,
}

impl ToneScale {
    /// A scale that has seen no counts yet.
    pub fn new(tone: ToneMap, background: Rgba) -> Self {
        let color = |share| between(STEPS.len(), |i| STEPS[i], share);
        Self {
            tone,
            background,
            colors: Ramp::standing_out(color, background),
            max_count: 1.0,
            histogram: Histogram::default(),
        }
    }

    /// Adds the counts of a part of the picture: mean numbers of covering paths, none negative.
    pub fn observe(&mut self, counts: &[f32]) {
        let is_equalized = self.tone == ToneMap::Equalized;
        let parts = counts.par_chunks(CHUNK).map(|counts| {
            // Bits of non-negative floats order as the floats do, and integer maxima vectorize.
            let max_bits = counts.iter().map(|count| count.to_bits()).max();
            let mut histogram = Histogram::default();
            if is_equalized {
                histogram.add(counts);
            }
            (max_bits.unwrap_or(0), histogram)
        });
        let (max_bits, histogram) =
            parts.reduce(Default::default, |a, b| (a.0.max(b.0), a.1.merge(b.1)));
        self.max_count = self.max_count.max(f32::from_bits(max_bits));
        self.histogram = std::mem::take(&mut self.histogram).merge(histogram);
    }

    /// The largest count so far, at least 1: it has the last color.
    pub fn max_count(&self) -> f32 {
        self.max_count
    }

    /// Colors a frame, which may be a part of the picture.
    ///
    /// # Panics
    /// When `counts` and `frame` differ in length.
    pub fn shade(&self, counts: &[f32], frame: &mut Frame) {
        assert_eq!(counts.len(), frame.pixels().len(), "one count per pixel");
        let table = ColorTable::new(self);
        let pixels = frame.pixels_mut().par_chunks_mut(CHUNK);
        let parts = pixels.zip(counts.par_chunks(CHUNK));
        parts.for_each(|(pixels, counts)| {
            for (pixel, &count) in pixels.iter_mut().zip(counts) {
                *pixel = table.at(count);
            }
        });
    }

    /// Places of counts on the ramp, 0 to 1.
    fn along(&self) -> impl Fn(f32) -> f64 {
        let max_count = f64::from(self.max_count);
        let max_log = max_count.ln_1p();
        let ranks = self.histogram.ranks();
        // At least 1, to divide by it.
        let max_rank = ranks.up_to(self.max_count).max(1.0);
        move |count| match self.tone {
            ToneMap::Linear => f64::from(count) / max_count,
            ToneMap::Log => f64::from(count).ln_1p() / max_log,
            ToneMap::Equalized => ranks.up_to(count) / max_rank,
        }
    }

    /// The meaning of the colors: a scale from one path to the largest number, with round numbers.
    pub fn legend(&self) -> Legend {
        let along = self.along();
        let first = along(1.0).min(1.0);
        let span = 1.0 - first;
        let mut ticks: Vec<(f64, LegendEntry)> = Vec::new();
        for count in round_counts(self.max_count).rev() {
            let at = match span > 0.0 {
                true => ((along(count) - first) / span).clamp(0.0, 1.0),
                false => 0.0,
            };
            if ticks
                .last()
                .is_none_or(|(above, _)| above - at >= LEAST_GAP)
            {
                let entry = LegendEntry {
                    label: format!("{count}"),
                    color: self.colors.at(first + span * at),
                    paths: None,
                };
                ticks.push((at, entry));
            }
        }
        ticks.reverse();
        let (at, entries) = ticks.into_iter().unzip();
        let color = |i: usize| {
            self.colors
                .at(first + span * i as f64 / (COLORS - 1) as f64)
        };
        let colors = (0..COLORS).map(color).collect();
        Legend {
            column: "paths per pixel".to_owned(),
            unit: None,
            entries,
            scale: Some(LegendScale { colors, at }),
        }
    }
}

/// Round counts from one up to a number: 1, 2 and 5 times powers of ten.
fn round_counts(up_to: f32) -> impl DoubleEndedIterator<Item = f32> {
    let counts = (0..30).map(|i| [1.0, 2.0, 5.0][i % 3] * 10f32.powi(i as i32 / 3));
    let counts: Vec<f32> = counts.filter(|count| *count <= up_to).collect();
    counts.into_iter()
}

/// Lookup table from counts to pixels. Neighboring entries differ by about 1/1000 of 1 + count, so
/// that whole counts up to 2048 and, below one, whole numbers of samples have entries of their own.
struct ColorTable(Vec<[u8; 4]>);

impl ColorTable {
    /// Entries per power of two, as bits.
    const BITS: u32 = 10;
    /// Mantissa bits that the table drops.
    const BITS_BELOW: u32 = f32::MANTISSA_DIGITS - 1 - Self::BITS;

    /// A table of all counts of a scale.
    fn new(tones: &ToneScale) -> Self {
        let (max_count, background, along) = (tones.max_count, tones.background, tones.along());
        let pixels = (0..=Self::entry(max_count)).map(|entry| {
            let bits = ((entry as u32) << Self::BITS_BELOW) + 1_f32.to_bits();
            let count = (f32::from_bits(bits) - 1.0).min(max_count);
            let color = tones.colors.at(along(count));
            let shown = background.lerp(color, f64::from(count.min(1.0)));
            [shown.r, shown.g, shown.b, shown.a]
        });
        Self(pixels.collect())
    }

    #[inline]
    fn at(&self, count: f32) -> [u8; 4] {
        self.0[Self::entry(count).min(self.0.len() - 1)]
    }

    /// Index of the nearest entry. Float bits rise linearly between powers of two.
    #[inline]
    fn entry(count: f32) -> usize {
        let beyond_one = (1.0 + count).to_bits() - 1_f32.to_bits();
        ((beyond_one + (1 << (Self::BITS_BELOW - 1))) >> Self::BITS_BELOW) as usize
    }
}

/// Histogram of the counts above one.
#[derive(Clone, Debug, Default)]
struct Histogram {
    bins: Vec<u32>,
}

/// Cumulative histogram: number of pixels with at most a given count.
struct Ranks {
    /// Pixels of each bin and all lower ones.
    up_to: Vec<u32>,
}

impl Histogram {
    /// Bins per power of two. Whole counts up to twice this number lie in the middle of a bin, and
    /// bins are wide enough that a count maps to one color whatever the samples of a method.
    const BINS_PER_OCTAVE: u32 = 8;
    /// Width of a bin, in float bits.
    const BIN: u32 = (2_f32.to_bits() - 1_f32.to_bits()) / Self::BINS_PER_OCTAVE;

    fn add(&mut self, counts: &[f32]) {
        for &count in counts {
            let bin = Self::bin(count);
            if self.bins.len() <= bin {
                self.bins.resize(bin + 1, 0);
            }
            self.bins[bin] += u32::from(bin > 0);
        }
    }

    /// The sum of two histograms.
    fn merge(mut self, other: Self) -> Self {
        if self.bins.len() < other.bins.len() {
            return other.merge(self);
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

    /// Position of a count in bins above one: a piecewise linear logarithm, read off the float
    /// bits.
    fn position(count: f32) -> f64 {
        f64::from(Self::beyond_one(count)) / f64::from(Self::BIN)
    }

    /// The bin whose middle is nearest to a count.
    fn bin(count: f32) -> usize {
        ((Self::beyond_one(count) + Self::BIN / 2) / Self::BIN) as usize
    }

    fn beyond_one(count: f32) -> u32 {
        count.max(1.0).to_bits() - 1_f32.to_bits()
    }
}

impl Ranks {
    /// Number of pixels with at most this count, interpolated linearly between the middles of bins.
    fn up_to(&self, count: f32) -> f64 {
        let position = Histogram::position(count);
        let pixels = |bin: usize| {
            let known = self.up_to.get(bin).or(self.up_to.last());
            f64::from(known.copied().unwrap_or(0))
        };
        let bin = position as usize;
        pixels(bin) + (pixels(bin + 1) - pixels(bin)) * position.fract()
    }
}

#[cfg(test)]
mod tests;
