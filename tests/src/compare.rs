//! Compares two pictures pixel by pixel, and checks the difference against a tolerance.

use guideway_scene::Frame;

use crate::BoxError;

/// Difference of two pictures of equal size, in levels of 0 to 255. Colors are premultiplied by
/// opacity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Mean over all pixels of the larger of the mean color difference and the opacity difference.
    pub mean_abs: f64,
    /// Share of the pixels with their worst channel within [`Tolerance::within`].
    pub share_within: f64,
    /// The worst channel of the worst pixel.
    pub max_abs: f64,
    /// Column and row of the worst pixel.
    pub worst: (u32, u32),
    /// Number of pixels that differ.
    pub differing_pixels: usize,
}

/// Limits of the difference of two pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Limit of the mean, in levels of 0 to 255.
    pub mean: f64,
    /// Limit in levels, and the share of the pixels that must be within it.
    pub within: (f64, f64),
    /// Limit of the worst pixel, in levels.
    pub max: f64,
}

impl Tolerance {
    /// For methods with coverage in `f32` or with fewer samples than the oracle.
    pub const STANDARD: Self = Self {
        mean: 1.5,
        within: (32.0, 0.999),
        max: 128.0,
    };
    /// For equal pictures.
    pub const NONE: Self = Self {
        mean: 0.0,
        within: (0.0, 1.0),
        max: 0.0,
    };
    /// For pictures that differ only by rounded coordinates.
    pub const ROUNDING: Self = Self {
        mean: 0.1,
        within: (4.0, 0.999),
        max: 20.0,
    };
}

/// Measures the difference of `actual` and `expected`, and checks it against `tolerance`.
///
/// # Errors
/// When the sizes differ, or a limit is exceeded: the message names the limit and the worst pixel.
pub fn check(
    expected: &Frame,
    actual: &Frame,
    tolerance: &Tolerance,
) -> Result<Difference, BoxError> {
    if expected.size() != actual.size() {
        let size = |f: &Frame| format!("{} x {}", f.size().width(), f.size().height());
        let (expected, actual) = (size(expected), size(actual));
        return Err(format!("the size is {actual}, not {expected}").into());
    }
    let difference = measure(expected, actual, tolerance.within.0);
    let limits = [
        (
            difference.mean_abs > tolerance.mean,
            format!("mean at most {}", tolerance.mean),
        ),
        (
            difference.share_within < tolerance.within.1,
            format!(
                "{} % of the pixels within {} levels",
                tolerance.within.1 * 100.0,
                tolerance.within.0
            ),
        ),
        (
            difference.max_abs > tolerance.max,
            format!("no pixel beyond {} levels", tolerance.max),
        ),
    ];
    let broken: Vec<_> = limits.into_iter().filter(|l| l.0).map(|l| l.1).collect();
    if broken.is_empty() {
        return Ok(difference);
    }
    let (x, y) = difference.worst;
    let at = y as usize * expected.size().width() as usize + x as usize;
    Err(format!(
        "expected {}; found mean {:.3}, {:.3} % within, {} pixels differ, the worst ({x}, {y}) by \
         {:.0}: expected {:?}, drawn {:?}",
        broken.join(" and "),
        difference.mean_abs,
        difference.share_within * 100.0,
        difference.differing_pixels,
        difference.max_abs,
        expected.pixels()[at],
        actual.pixels()[at],
    )
    .into())
}

/// Difference of two pixels: that of their worst channel.
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
