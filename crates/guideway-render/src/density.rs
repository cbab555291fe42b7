//! Density shading: from how many paths cover a pixel, on average over its square, to a colour.
//!
//! With a million paths on two million pixels a linear scale shows either the crowd or the single path;
//! the logarithm shows both, and equalising the histogram spends the colours where the pixels are.

use guideway_scene::Rgba;

use crate::Frame;

/// How counts become lightness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneMap {
    /// In proportion.
    Linear,
    /// By the logarithm of one plus the count.
    #[default]
    Log,
    /// By how many of the pixels under more than one path have no larger count, so that each colour shows
    /// on as many. As datashader's `eq_hist` (<https://datashader.org>), but that one path and less share
    /// the first colour: their opacity tells them apart already.
    Equalised,
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

/// Colours a frame from `counts`, the mean number of covering paths of each pixel, all of which it has.
///
/// # Panics
/// When there is not one count a pixel.
pub fn shade(counts: &[f32], tone: ToneMap, background: Rgba, frame: &mut Frame) {
    let mut tones = Tones::new(tone);
    tones.look(counts);
    tones.shade(counts, background, frame);
}

/// How counts become colours in one picture, all of which was looked at. The largest count gets the last colour, unless
/// nothing is above one path and the histogram is equalised; below one path the background shows through.
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

    /// Looks at a part of the picture: the mean number of covering paths of each pixel.
    pub fn look(&mut self, counts: &[f32]) {
        self.most = counts.iter().copied().fold(self.most, f32::max);
        if self.tone == ToneMap::Equalised {
            self.histogram.add(counts);
        }
    }

    /// Colours a frame, which is a part of the picture.
    ///
    /// # Panics
    /// When there is not one count a pixel.
    pub fn shade(&self, counts: &[f32], background: Rgba, frame: &mut Frame) {
        assert_eq!(counts.len(), frame.pixels().len(), "one count a pixel");
        match self.tone {
            ToneMap::Linear => {
                let most = f64::from(self.most);
                paint(counts, background, frame, |count| f64::from(count) / most);
            }
            ToneMap::Log => {
                let most = f64::from(self.most).ln_1p();
                paint(counts, background, frame, |count| {
                    f64::from(count).ln_1p() / most
                });
            }
            ToneMap::Equalised => {
                let ranks = self.histogram.ranks();
                // At least one pixel, for there may be none.
                let most = ranks.up_to(self.most).max(1.0);
                paint(counts, background, frame, |count| ranks.up_to(count) / most);
            }
        }
    }
}

/// Colours pixels by how far along the steps their count is, from 0 to 1.
fn paint(counts: &[f32], background: Rgba, frame: &mut Frame, along: impl Fn(f32) -> f64) {
    for (pixel, &count) in frame.pixels_mut().iter_mut().zip(counts) {
        let along = along(count) * (STEPS.len() - 1) as f64;
        let below = (along as usize).min(STEPS.len() - 2);
        let color = STEPS[below].lerp(STEPS[below + 1], along - below as f64);
        let shown = background.lerp(color, f64::from(count.min(1.0)));
        *pixel = [shown.r, shown.g, shown.b, shown.a];
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
    /// and bins are wide enough that a count has the same colour however a method samples it.
    const A_DOUBLING: u32 = 8;

    fn add(&mut self, counts: &[f32]) {
        for &count in counts {
            let bin = Self::place(count).round() as usize;
            if self.bins.len() <= bin {
                self.bins.resize(bin + 1, 0);
            }
            self.bins[bin] += u32::from(bin > 0);
        }
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
        let beyond_one = count.max(1.0).to_bits() - 1_f32.to_bits();
        let a_doubling = 2_f32.to_bits() - 1_f32.to_bits();
        f64::from(beyond_one) / f64::from(a_doubling / Self::A_DOUBLING)
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
        for tone in [ToneMap::Linear, ToneMap::Log, ToneMap::Equalised] {
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
    fn equalising_gives_every_fifth_of_the_crowded_pixels_a_step() {
        let counts = [3.0, 1.0, 1024.0, 8.0, 0.5, 2.0, 3.5];
        let shown = colors(&counts, ToneMap::Equalised);
        let half = Rgba::WHITE.lerp(STEPS[0], 0.5);
        let mut expected = [2, 0, 5, 4, 0, 1, 3].map(step);
        expected[4] = [half.r, half.g, half.b, half.a];
        assert_eq!(shown, expected);
    }

    #[test]
    fn many_equal_pixels_take_many_steps() {
        let shown = colors(&[2.0, 2.0, 4.0, 2.0, 2.0], ToneMap::Equalised);
        assert_eq!(shown, [4, 4, 5, 4, 4].map(step));
    }

    #[test]
    fn nothing_beyond_one_path_has_the_first_colour() {
        let shown = colors(&[1.0, 1.0, 0.0], ToneMap::Equalised);
        assert_eq!(shown[..2], [0; 2].map(step));
        assert_eq!(shown[2], [255; 4]);
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
