//! Ramps of colors for numbers: named palettes, cut to what stands out from the background, and
//! round ticks beside them.

use crate::breaks::ClassBreaks;
use crate::color::Rgba;

/// Least contrast of a line with what is around it (WCAG 2.2, criterion 1.4.11).
pub(crate) const CONTRAST: f64 = 3.0;
/// Colors of a ramp. Derived: neighbors differ by less than an eye can tell.
pub(crate) const COLORS: usize = 65;
/// Least share of a palette that a ramp shows as it is: on a background of medium gray, no longer
/// part has the contrast.
const LEAST_SHARE: f64 = 0.25;
/// Most ticks beside a ramp.
const MOST_TICKS: f64 = 8.0;

/// A named sequence of colors whose lightness rises evenly.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Palette {
    /// From blue over red to orange: stands out from white and from dark paper as a whole.
    #[default]
    Warm,
    /// From purple over green to yellow, by Smith and van der Walt.
    Viridis,
    /// From blue over red to yellow, by the same.
    Plasma,
    /// From blue to yellow, nearly the same for any color vision, by Nuñez and others.
    Cividis,
    /// From black to white.
    Gray,
}

impl Palette {
    /// All palettes.
    pub const ALL: [Self; 5] = [
        Self::Warm,
        Self::Viridis,
        Self::Plasma,
        Self::Cividis,
        Self::Gray,
    ];

    /// The palette of a name; `None` if there is none.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|palette| palette.name() == name)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Warm => "warm",
            Self::Viridis => "viridis",
            Self::Plasma => "plasma",
            Self::Cividis => "cividis",
            Self::Gray => "gray",
        }
    }

    /// Colors as 0xRRGGBB, evenly along the palette.
    fn steps(self) -> &'static [u32] {
        match self {
            Self::Warm => &[0x42_5e_d4, 0x88_50_be, 0xba_46_8c, 0xd4_50_50, 0xe2_70_14],
            Self::Viridis => &[
                0x44_01_54, 0x47_2d_7b, 0x3b_52_8b, 0x2c_72_8e, 0x21_91_8c, 0x28_ae_80, 0x5e_c9_62,
                0xad_dc_30, 0xfd_e7_25,
            ],
            Self::Plasma => &[
                0x0d_08_87, 0x4c_02_a1, 0x7e_03_a8, 0xa9_23_95, 0xcc_47_78, 0xe5_6b_5d, 0xf8_95_40,
                0xfd_c5_27, 0xf0_f9_21,
            ],
            Self::Cividis => &[
                0x00_22_4e, 0x12_35_70, 0x3b_49_6c, 0x57_5d_6d, 0x70_71_73, 0x8a_86_78, 0xa5_9c_74,
                0xc3_b3_69, 0xe1_cc_55, 0xfe_e8_38,
            ],
            Self::Gray => &[0x10_10_10, 0xf0_f0_f0],
        }
    }

    /// The color at a share of the palette, 0 to 1.
    fn at(self, share: f64) -> Rgba {
        let steps = self.steps();
        let color = |step: usize| Rgba::from_u32(steps[step] << 8 | 0xff);
        between(steps.len(), color, share)
    }
}

/// Palette, and range or class breaks, that map numbers to colors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberColors {
    /// The colors.
    pub palette: Palette,
    /// The numbers at both ends of the palette; `None`, or an infinite end, for the least and the
    /// largest one. Numbers beyond have the color of the end.
    pub range: Option<[f64; 2]>,
    /// The ends of classes, which have colors evenly along the palette; a range has no effect
    /// beside them. `None` for a continuous scale, or for classes of few distinct numbers.
    pub breaks: Option<ClassBreaks>,
    /// The paper below the paths, from which the colors stand out.
    pub background: Rgba,
}

impl Default for NumberColors {
    fn default() -> Self {
        Self {
            palette: Palette::default(),
            range: None,
            breaks: None,
            background: Rgba::WHITE,
        }
    }
}

/// The color at a share, 0 to 1, of `count` colors that are evenly spaced; beyond that of the end.
pub(crate) fn between(count: usize, color: impl Fn(usize) -> Rgba, share: f64) -> Rgba {
    let along = share.clamp(0.0, 1.0) * (count - 1) as f64;
    let below = (along as usize).min(count - 2);
    color(below).lerp(color(below + 1), along - below as f64)
}

/// Colors evenly along a scale, lowest number first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ramp(Vec<Rgba>);

impl Ramp {
    /// The colors of a palette that stand out from a background.
    pub(crate) fn new(by: &NumberColors) -> Self {
        Self::standing_out(|share| by.palette.at(share), by.background)
    }

    /// The longest part of some colors, by shares of 0 to 1, that stands out from a background. If
    /// all parts are short, all colors, mixed with black or white until they stand out.
    pub(crate) fn standing_out(colors: impl Fn(f64) -> Rgba, background: Rgba) -> Self {
        let paper = match background.a {
            0 => Rgba::WHITE,
            _ => background,
        };
        const STEPS: usize = 256;
        let share = |step: usize| step as f64 / STEPS as f64;
        let stands_out = |step: &usize| contrast(colors(share(*step)), paper) >= CONTRAST;
        let (mut best, mut first) = (0..0, None);
        for step in 0..=STEPS + 1 {
            let is_in = step <= STEPS && stands_out(&step);
            match first {
                None if is_in => first = Some(step),
                Some(start) if !is_in => {
                    if step - start > best.len() {
                        best = start..step;
                    }
                    first = None;
                }
                _ => {}
            }
        }
        let is_short = (best.len() as f64) < LEAST_SHARE * STEPS as f64;
        let (low, high) = match is_short {
            true => (0.0, 1.0),
            false => (share(best.start), share(best.end - 1)),
        };
        let color = |i: usize| {
            let along = i as f64 / (COLORS - 1) as f64;
            let color = colors(low + (high - low) * along);
            match is_short {
                true => standing_out(color, paper),
                false => color,
            }
        };
        Self((0..COLORS).map(color).collect())
    }

    /// The color at a share of the range of numbers; beyond 0 to 1 that of the end.
    pub(crate) fn at(&self, share: f64) -> Rgba {
        between(COLORS, |i| self.0[i], share)
    }

    /// The colors, evenly along the scale.
    pub(crate) fn into_colors(self) -> Vec<Rgba> {
        self.0
    }
}

/// A color, mixed with black or white, whichever is farther from the paper, until it stands out.
fn standing_out(color: Rgba, paper: Rgba) -> Rgba {
    const STEPS: u32 = 256;
    let (black, white) = (Rgba::BLACK, Rgba::WHITE);
    let is_dark = contrast(black, paper) >= contrast(white, paper);
    let end = if is_dark { black } else { white };
    let mixed = (0..=STEPS).map(|step| color.lerp(end, f64::from(step) / f64::from(STEPS)));
    // All on one side of the paper, so that no color between two of them is that of the paper.
    let mut fitting = mixed.filter(|mixed| {
        let is_beyond = (luminance(*mixed) < luminance(paper)) == is_dark;
        is_beyond && contrast(*mixed, paper) >= CONTRAST
    });
    fitting.next().unwrap_or(end)
}

/// Contrast of two opaque colors, 1 to 21 (WCAG 2.2).
pub(crate) fn contrast(a: Rgba, b: Rgba) -> f64 {
    let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
    (a / b).max(b / a)
}

/// Relative luminance (WCAG 2.2).
fn luminance(color: Rgba) -> f64 {
    let linear = |channel: u8| match f64::from(channel) / 255.0 {
        c if c <= 0.04045 => c / 12.92,
        c => ((c + 0.055) / 1.055).powf(2.4),
    };
    0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b)
}

/// Round numbers within a range and their texts: multiples of 1, 2 or 5 times a power of ten.
pub(crate) fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return vec![(low, plain(low, 6))];
    }
    // The tolerance keeps a step that rounding made too small.
    let step = round_step(span / MOST_TICKS * (1.0 - 1e-9));
    let decimals = if step >= 1.0 {
        0
    } else {
        (-step.log10()).ceil() as usize
    };
    let first = (low / step - 1e-6).ceil();
    let last = (high / step + 1e-6).floor();
    let numbers = (0..=(last - first).max(0.0) as usize).map(|i| (first + i as f64) * step);
    numbers
        .map(|number| (number, plain(number, decimals)))
        .collect()
}

/// The smallest of 1, 2 and 5 times a power of ten that is not less than `min`, which is positive.
pub fn round_step(min: f64) -> f64 {
    let magnitude = 10f64.powf(min.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * magnitude);
    // The logarithm may round down so that `min` exceeds even the last step slightly.
    steps
        .into_iter()
        .find(|&step| step >= min)
        .unwrap_or(20.0 * magnitude)
}

/// A number with at most this many decimals, without zeros at the end.
fn plain(number: f64, decimals: usize) -> String {
    // Adding 0 turns -0 into 0.
    let text = format!("{:.decimals$}", number + 0.0);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DARK: Rgba = Rgba::opaque(24, 26, 30);

    #[test]
    fn every_ramp_stands_out_from_its_background() {
        for palette in Palette::ALL {
            for background in [Rgba::WHITE, DARK, Rgba::BLACK, Rgba::opaque(250, 245, 230)] {
                let ramp = Ramp::new(&NumberColors {
                    palette,
                    background,
                    ..NumberColors::default()
                });
                for step in 0..=100 {
                    let color = ramp.at(f64::from(step) / 100.0);
                    let of = contrast(color, background);
                    assert!(of >= 2.98, "{palette:?} on {background}, {step}: {of}");
                }
                assert!(contrast(ramp.at(0.0), ramp.at(1.0)) > 1.4, "{palette:?}");
            }
        }
    }

    #[test]
    fn a_palette_without_contrast_is_mixed_until_it_stands_out() {
        let [gray, navy] = [Rgba::opaque(119, 119, 119), Rgba::opaque(30, 58, 138)];
        for background in [gray, navy, Rgba::opaque(128, 128, 128)] {
            for palette in Palette::ALL {
                let ramp = Ramp::new(&NumberColors {
                    palette,
                    background,
                    ..NumberColors::default()
                });
                for step in 0..=100 {
                    let color = ramp.at(f64::from(step) / 100.0);
                    let of = contrast(color, background);
                    assert!(of >= 2.9, "{palette:?} on {background}, {step}: {of}");
                }
                assert_ne!(ramp.at(0.0), ramp.at(1.0), "{palette:?} on {background}");
            }
        }
    }

    #[test]
    fn ticks_are_round_and_few() {
        let texts = |low, high| ticks(low, high).into_iter().map(|(_, text)| text);
        let texts = |low, high| texts(low, high).collect::<Vec<_>>();
        assert_eq!(texts(0.5, 1.613), ["0.6", "0.8", "1", "1.2", "1.4", "1.6"]);
        assert_eq!(texts(0.0, 1.9), ["0", "0.5", "1", "1.5"]);
        assert_eq!(texts(-4.0, 9.0), ["-4", "-2", "0", "2", "4", "6", "8"]);
        assert_eq!(texts(10.0, 23_000.0), ["5000", "10000", "15000", "20000"]);
        assert_eq!(texts(0.021, 0.0225)[..2], ["0.021", "0.0212"]);
        assert_eq!(texts(7.0, 7.0), ["7"]);
        for high in [1e-9, 0.37, 1.0, 2.0, 6.1, 99.0, 1e12] {
            let count = ticks(0.0, high).len();
            assert!((4..=9).contains(&count), "{high}: {count}");
        }
    }
}
