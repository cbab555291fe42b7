//! Units and limits of the 16-bit fixed-point rasterizer. The cull stage tests them per cluster.

use std::ops::RangeInclusive;

use super::samples::{ROWS, SOLID};

/// Steps per pixel. Derived: cached lines are rounded to about as much already.
pub(crate) const STEPS: i32 = 64;
/// Steps from one row of samples to the next.
pub(crate) const ROW_STEPS: i32 = STEPS / ROWS as i32;
/// Steps from one sample of a row to the next.
pub(crate) const COLUMN_STEPS: i32 = STEPS / SOLID as i32;

/// Largest reach of a cluster from its origin, in pixels. Derived: with strokes of at most
/// [`MAX_RADIUS_PX`] no line ends farther than 280 px from the corner of a tile that its cluster
/// touches, and sums with half chords stay within 16 bits.
const MAX_REACH_PX: f64 = 120.0;
/// Largest half stroke width, in pixels.
pub(crate) const MAX_RADIUS_PX: f64 = 8.0;
/// Smallest half stroke width, in pixels. Thinner strokes lose too large a part to the half step
/// that borders are rounded by, and all strokes that share a pixel err alike.
const MIN_RADIUS_PX: f64 = 0.5;

/// Returns `true` if 16 bits hold the lines of a cluster of this reach, with strokes of these half
/// widths.
pub(crate) fn fits(reach_px: f64, radii_px: RangeInclusive<f64>) -> bool {
    reach_px <= MAX_REACH_PX
        && *radii_px.start() >= MIN_RADIUS_PX
        && *radii_px.end() <= MAX_RADIUS_PX
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rejects_large_clusters_and_thin_or_wide_strokes() {
        assert!(fits(120.0, 0.5..=8.0));
        assert!(!fits(121.0, 0.5..=8.0));
        assert!(!fits(120.0, 0.4..=8.0));
        assert!(!fits(120.0, 0.5..=8.1));
    }
}
