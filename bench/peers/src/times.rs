//! Summary of frame times.

use guideway_bench::Summary;

/// Median of all frames except the first, in milliseconds.
pub(crate) fn median_after_first_ms(times_ms: &[f64]) -> f64 {
    Summary::of(&times_ms[1..]).map_or(f64::NAN, |times| times.median)
}
