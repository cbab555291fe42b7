//! How far two pictures are apart, and whether that is near enough.

use guideway_scene::Frame;

/// How far two pictures of one size are apart, in levels of 0 to 255. Colors count as much as they show:
/// they are multiplied with their opacity first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Mean over all pixels and their colors; a pixel's opacity counts where it is further off.
    pub mean_abs: f64,
    /// Share of the pixels whose worst channel is within [`Tolerance::within`].
    pub share_within: f64,
    /// The worst channel of the worst pixel.
    pub max_abs: f64,
    /// Column and row of the worst pixel.
    pub worst: (u32, u32),
    /// Pixels that differ at all.
    pub differing_pixels: usize,
}

/// How far two pictures may be apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Greatest mean, in levels of 0 to 255.
    pub mean: f64,
    /// This share of the pixels is at most so many levels off.
    pub within: (f64, f64),
    /// Greatest difference of any pixel, in levels.
    pub max: f64,
}

impl Tolerance {
    /// For methods that compute coverage in `f32` or by fewer samples than the oracle.
    pub const STANDARD: Self = Self {
        mean: 1.5,
        within: (32.0, 0.999),
        max: 128.0,
    };
    /// For two pictures that are the same, bit for bit.
    pub const NONE: Self = Self {
        mean: 0.0,
        within: (0.0, 1.0),
        max: 0.0,
    };
    /// For two pictures that differ by nothing but the rounding of coordinates.
    pub const ROUNDING: Self = Self {
        mean: 0.1,
        within: (4.0, 0.999),
        max: 20.0,
    };
}

/// Measures how far `actual` is from `expected`, by the limits of `tolerance`.
///
/// # Errors
/// When they differ in size, or by more than `tolerance`: the message names the limit and the worst pixel.
pub fn check(
    expected: &Frame,
    actual: &Frame,
    tolerance: &Tolerance,
) -> Result<Difference, String> {
    if expected.size() != actual.size() {
        let size = |f: &Frame| format!("{} x {}", f.size().width(), f.size().height());
        let (expected, actual) = (size(expected), size(actual));
        return Err(format!("the size is {actual}, not {expected}"));
    }
    let difference = measure(expected, actual, tolerance.within.0);
    let limits = [
        (
            difference.mean_abs > tolerance.mean,
            format!("a mean of at most {}", tolerance.mean),
        ),
        (
            difference.share_within < tolerance.within.1,
            format!(
                "{} % of the pixels within {}",
                tolerance.within.1 * 100.0,
                tolerance.within.0
            ),
        ),
        (
            difference.max_abs > tolerance.max,
            format!("no pixel beyond {}", tolerance.max),
        ),
    ];
    let broken: Vec<_> = limits.into_iter().filter(|l| l.0).map(|l| l.1).collect();
    if broken.is_empty() {
        return Ok(difference);
    }
    let (x, y) = difference.worst;
    let at = y as usize * expected.size().width() as usize + x as usize;
    Err(format!(
        "asked: {}; found: mean {:.3}, {:.3} % within, {} pixels differ, the worst ({x}, {y}) by {:.0}: \
         {:?} is expected, {:?} is drawn",
        broken.join(" and "),
        difference.mean_abs,
        difference.share_within * 100.0,
        difference.differing_pixels,
        difference.max_abs,
        expected.pixels()[at],
        actual.pixels()[at],
    ))
}

/// How far one pixel is from another: by their worst channel.
pub fn pixel_difference(expected: [u8; 4], actual: [u8; 4]) -> f64 {
    let channels = channel_differences(expected, actual);
    channels.into_iter().fold(0.0, f64::max)
}

fn channel_differences(expected: [u8; 4], actual: [u8; 4]) -> [f64; 4] {
    let shown = |[r, g, b, a]: [u8; 4]| {
        let opacity = f64::from(a) / 255.0;
        let [r, g, b] = [r, g, b].map(|channel| f64::from(channel) * opacity);
        [r, g, b, f64::from(a)]
    };
    let (expected, actual) = (shown(expected), shown(actual));
    [0, 1, 2, 3].map(|channel: usize| (expected[channel] - actual[channel]).abs())
}

fn measure(expected: &Frame, actual: &Frame, within: f64) -> Difference {
    let mut difference = Difference::default();
    let (mut sum, mut near) = (0.0, 0_usize);
    let pairs = expected.pixels().iter().zip(actual.pixels());
    for (index, (&expected_pixel, &actual_pixel)) in pairs.enumerate() {
        let apart = pixel_difference(expected_pixel, actual_pixel);
        let [r, g, b, a] = channel_differences(expected_pixel, actual_pixel);
        sum += ((r + g + b) / 3.0).max(a);
        near += usize::from(apart <= within);
        difference.differing_pixels += usize::from(apart > 0.0);
        if apart > difference.max_abs {
            let width = expected.size().width();
            difference.max_abs = apart;
            difference.worst = (index as u32 % width, index as u32 / width);
        }
    }
    let pixels = expected.pixels().len() as f64;
    difference.mean_abs = sum / pixels;
    difference.share_within = near as f64 / pixels;
    difference
}
