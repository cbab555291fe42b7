//! The sample pattern of a pixel: 16 rows of `C` samples, 8 where all is one color and 16
//! elsewhere.
//!
//! ```text
//!   C = 8 (solid): odd rows are shifted by         C = 16 (layered): the grid of the oracle
//!   half a sample, like a checkerboard
//!     row 0   x . x . x . x . ...                    row 0   x x x x x x x x ...
//!     row 1   . x . x . x . x ...                    row 1   x x x x x x x x ...
//! ```
//!
//! Lengths in the rasterizer are measured in sample columns: 1 column = 1 / `C` pixel on both axes,
//! so that a circle stays a circle.

use guideway_spline::{greater, lesser};

use super::snapped_view::STEPS_PER_PX;
use super::tile::LANES;

/// Sample rows per pixel: one per SIMD lane.
pub(crate) const ROWS: usize = LANES;
/// Samples per row where colors or paths differ: the pattern of the oracle, 256 samples per pixel.
pub(crate) const LAYERED: usize = 16;
/// Samples per row where all is one color. The shift of every other row resolves upright borders as
/// finely as level ones, with half the samples.
pub(crate) const SOLID: usize = 8;

/// The samples of a pixel with `C` columns.
pub(crate) struct SamplePattern<const C: usize>;

impl<const C: usize> SamplePattern<C> {
    /// Samples per pixel.
    pub(crate) const COUNT: usize = ROWS * C;
    /// Distance of neighboring rows, in columns.
    pub(crate) const ROW_STEP: f32 = C as f32 / ROWS as f32;
    /// Distance outside of a stroke up to which a sample counts as covered, in columns. Derived:
    /// one and a half steps of the snapped view, so that a border through a row of samples covers
    /// it, as in exact arithmetic, wherever the picture begins.
    pub(crate) const SLACK: f32 = 1.5 * C as f32 / STEPS_PER_PX as f32;

    /// Distance of each row from the upper side of the pixel, in columns.
    pub(crate) const ROW_Y: [f32; LANES] = {
        let mut y = [0.0; LANES];
        let mut i = 0;
        while i < LANES {
            y[i] = (i as f32 + 0.5) * Self::ROW_STEP;
            i += 1;
        }
        y
    };

    /// Offset per row that makes a position round to the first sample at or behind it.
    pub(crate) const TO_SAMPLE: [f32; LANES] = {
        let shifts = ROWS / C;
        let mut to_sample = [0.0; LANES];
        let mut i = 0;
        while i < LANES {
            to_sample[i] = 0.5 - ((i % shifts) as f32 + 0.5) / shifts as f32;
            i += 1;
        }
        to_sample
    };

    /// Rounds a length in columns to the nearest step of the snapped view.
    ///
    /// All numbers that depend on the position of a line are multiples of a step. Their sums are
    /// exact, so a line moved by whole pixels covers the same samples, moved by as much.
    #[inline(always)]
    pub(crate) fn snap(x: f32) -> f32 {
        // The last digit of a sum with `step` is one step.
        let step = 1.5 * (1 << 23) as f32 * (C as f32 / STEPS_PER_PX as f32);
        (x + step) - step
    }
}

/// Converts pixels to columns.
#[inline(always)]
pub(crate) fn columns<const C: usize>(px: f64) -> f32 {
    (px * C as f64) as f32
}

/// Adding this rounds a small number to the nearest integer, in the low bits of the sum.
const ROUND: f32 = (1 << 23) as f32;

/// Rounds to the nearest integer from 0 to `max`.
#[inline(always)]
pub(crate) fn round(x: f32, max: f32) -> u32 {
    (clamp(x, max) + ROUND).to_bits() - ROUND.to_bits()
}

/// `f32::clamp` from 0 to `max` in two instructions; the result for a NaN is unspecified.
#[inline(always)]
pub(crate) fn clamp(x: f32, max: f32) -> f32 {
    lesser(greater(x, 0.0), max)
}
