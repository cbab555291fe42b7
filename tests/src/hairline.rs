//! Compares pictures of one-pixel lines by a line rasterizer with those of the oracle, by position.
//!
//! Such pictures cannot agree pixel by pixel: without anti-aliasing a pixel is either line or
//! background, and the oracle gives it partial coverage; with multisampling a pixel has few
//! samples, and caps are square. The comparison therefore accepts a line in any of the eight
//! neighbors of a pixel.

use guideway_scene::{Frame, LineRule};

use crate::BoxError;
use crate::compare::pixel_difference;
use crate::sketch::{Drawing, Sketch};

/// Limits of the difference of two pictures of one-pixel lines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest share of lost pixels: those that the oracle covers by more than half, and that are
    /// empty together with their eight neighbors.
    pub lost: f64,
    /// Limit in levels of 0 to 255, and the largest share of the line pixels of either picture
    /// beyond it.
    pub beyond: (f64, f64),
}

impl Tolerance {
    /// Without anti-aliasing. A line at 45 degrees through pixel corners lacks a row of pixels that
    /// the oracle covers by two thirds.
    pub const ALIASED: Self = Self {
        lost: 0.0,
        beyond: (160.0, 0.25),
    };
    /// With at least four samples per pixel. Paths shorter than a pixel differ most, because their
    /// caps are square and those of the oracle round; and Mesa's llvmpipe loses lines in the pixels
    /// at the borders of its 64 x 64 tiles.
    pub const MULTISAMPLED: Self = Self {
        lost: 0.02,
        beyond: (160.0, 0.15),
    };
}

/// Pixel counts of two pictures of equal size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Difference {
    /// Line pixels of either picture.
    pub marked: usize,
    /// Drawn pixels that are empty in the oracle's picture together with their neighbors. Must be
    /// 0.
    pub stray: usize,
    /// Pixels that the oracle covers by more than half.
    pub covered: usize,
    /// Covered pixels that are empty together with their neighbors.
    pub lost: usize,
    /// Pixels beyond the limit of the tolerance.
    pub beyond: usize,
}

/// Lost or differing pixels that any picture may have, because shares of few pixels round to 0.
const SLACK_PX: f64 = 8.0;

/// The drawing of a sketch, with lines one pixel wide in one color.
pub fn drawing(sketch: Sketch) -> Drawing {
    let mut drawing = sketch.in_one_color().build();
    drawing.style.line_rule = LineRule::World {
        width_m: 1.0,
        min_px: 1.0,
        max_px: 1.0,
    };
    drawing
}

/// Compares pictures of lines on `background`.
///
/// # Errors
/// When the sizes differ, or a limit of `tolerance` is exceeded.
pub fn check(
    expected: &Frame,
    actual: &Frame,
    background: [u8; 4],
    tolerance: &Tolerance,
) -> Result<Difference, BoxError> {
    if expected.size() != actual.size() {
        return Err("the sizes differ".into());
    }
    let difference = measure(expected, actual, background, tolerance.beyond.0);
    let most = |share: f64, of: usize| share * of as f64 + SLACK_PX;
    let is_off = difference.stray > 0
        || difference.lost as f64 > most(tolerance.lost, difference.covered)
        || difference.beyond as f64 > most(tolerance.beyond.1, difference.marked);
    if is_off {
        Err(format!("{difference:?} exceeds {tolerance:?}").into())
    } else {
        Ok(difference)
    }
}

fn measure(expected: &Frame, actual: &Frame, background: [u8; 4], levels: f64) -> Difference {
    let (width, height) = (expected.size().width(), expected.size().height());
    let ink = |frame: &Frame, x: u32, y: u32| {
        pixel_difference(background, frame.pixels()[(y * width + x) as usize])
    };
    let around = |frame: &Frame, x: u32, y: u32| {
        let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
        let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
        rows.flat_map(|y| columns.clone().map(move |x| (x, y)))
            .any(|(x, y)| ink(frame, x, y) > 0.0)
    };
    // The pixel with the strongest difference has the color of the lines.
    let pixels = expected.pixels().iter().chain(actual.pixels());
    let most = pixels
        .map(|&p| pixel_difference(background, p))
        .fold(0.0, f64::max);
    let mut difference = Difference::default();
    for y in 0..height {
        for x in 0..width {
            let (wanted, drawn) = (ink(expected, x, y), ink(actual, x, y));
            difference.marked += usize::from(wanted.max(drawn) > 0.0);
            difference.stray += usize::from(drawn > 0.0 && !around(expected, x, y));
            let is_covered = wanted > 0.5 * most;
            difference.covered += usize::from(is_covered);
            difference.lost += usize::from(is_covered && !around(actual, x, y));
            difference.beyond += usize::from((wanted - drawn).abs() > levels);
        }
    }
    difference
}
