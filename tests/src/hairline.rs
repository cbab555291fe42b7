//! How far pictures of lines one pixel wide, drawn by a rasterizer of lines, are from the oracle's.
//!
//! Such lines cannot agree pixel by pixel. Without anti-aliasing a pixel is line or background where the
//! oracle gives it a share; with it there are a few samples a pixel, and ends are cut off square. What must
//! agree is where lines are: so neighbors count.

use guideway_scene::Frame;
use guideway_scene::LineRule;

use crate::compare::pixel_difference;
use crate::sketch::{Drawing, Sketch};

/// How many pixels may be wrong, in which way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of the pixels that the oracle covers by more than half, this share may have nothing drawn on it or its
    /// eight neighbors.
    pub lost: f64,
    /// Of the pixels that are line in either picture, the second, a share, may be off by more than the
    /// first, in levels of 0 to 255.
    pub beyond: (f64, f64),
}

impl Tolerance {
    /// Without anti-aliasing. Of a line at 45 degrees through the corners of pixels, a row of them is left out
    /// that the oracle covers by two thirds.
    pub const ALIASED: Self = Self {
        lost: 0.0,
        beyond: (160.0, 0.25),
    };
    /// With four samples a pixel or more. Paths shorter than a pixel are the worst, for their ends are cut
    /// off square where the oracle rounds them; and Mesa's llvmpipe loses what a line has in the pixels at
    /// the borders of its tiles of 64 x 64.
    pub const MULTISAMPLED: Self = Self {
        lost: 0.02,
        beyond: (160.0, 0.15),
    };
}

/// Pixels of two pictures of one size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Difference {
    /// Line in either picture.
    pub marked: usize,
    /// Drawn on, but the oracle leaves it and its eight neighbors alone. There may be none.
    pub stray: usize,
    /// Covered by more than half by the oracle.
    pub covered: usize,
    /// Of those, with nothing drawn on them or their eight neighbors.
    pub lost: usize,
    /// Off by more than the tolerance has it.
    pub beyond: usize,
}

/// Pixels that may be lost or off in any picture: a share of next to none is none.
const FEW: f64 = 8.0;

/// The drawing of a sketch with lines one pixel wide in one color.
pub fn drawing(sketch: Sketch) -> Drawing {
    let mut drawing = sketch.in_one_color().build();
    drawing.style.line_rule = LineRule::World {
        width_m: 1.0,
        min_px: 1.0,
        max_px: 1.0,
    };
    drawing
}

/// Compares pictures of dark lines on `background` or of others that show on it as well.
///
/// # Errors
/// When they differ in size, or by more than `tolerance`.
pub fn check(
    expected: &Frame,
    actual: &Frame,
    background: [u8; 4],
    tolerance: &Tolerance,
) -> Result<Difference, String> {
    if expected.size() != actual.size() {
        return Err("the sizes differ".to_owned());
    }
    let difference = measure(expected, actual, background, tolerance.beyond.0);
    let most = |share: f64, of: usize| share * of as f64 + FEW;
    let is_off = difference.stray > 0
        || difference.lost as f64 > most(tolerance.lost, difference.covered)
        || difference.beyond as f64 > most(tolerance.beyond.1, difference.marked);
    if is_off {
        Err(format!("{difference:?} is more than {tolerance:?}"))
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
    // The color of the lines shows as much as the darkest pixel, if there is any line.
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
