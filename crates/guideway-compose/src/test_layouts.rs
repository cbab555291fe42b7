//! Layouts for the tests of several modules.

use guideway_layout::{Layout, NewPath};
use guideway_spline::{Point, Runs};

/// Numbers from 0 to 1, the same in every run.
pub(crate) fn numbers() -> impl FnMut() -> f64 {
    let mut state = 1_u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 40) as f64 / f64::from(1 << 24)
    }
}

/// A layout of straight ways, by their ends in meters.
pub(crate) fn straight_ways(ends: impl IntoIterator<Item = [Point<f64>; 2]>) -> Layout {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    for [from, to] in ends {
        runs.clear();
        runs.push_line(from, to);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}
