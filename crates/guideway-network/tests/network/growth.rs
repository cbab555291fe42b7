//! Growth of the cost of `build` and of the checks of a network, as the exponent of a power of the
//! number of lines.

use guideway_growth::exponent_of_time;
use guideway_layout::{CheckOptions, Layout, check};
use guideway_network::{AnalyzeOptions, analyze};

use crate::sketch::{drawing, network, split};

/// Streets and avenues that cross, `n` lines in all, in blocks of ten by ten.
fn town(n: usize) -> Layout {
    let mut lines = Vec::with_capacity(n);
    let side = ((n as f64 / 20.0).sqrt().ceil()) as usize;
    'all: for block in 0..side * side {
        let (x, y) = ((block % side) as f64 * 12.0, (block / side) as f64 * 12.0);
        for i in 0..10 {
            let at = f64::from(i) + 0.5;
            for line in [[x + at, y, x + at, y + 10.0], [x, y + at, x + 10.0, y + at]] {
                lines.push(line);
                if lines.len() == n {
                    break 'all;
                }
            }
        }
    }
    drawing(&lines)
}

#[test]
fn build_grows_almost_linearly() {
    let slope = exponent_of_time([1_000, 4_000, 16_000], town, |town| {
        let made = network(town, &split());
        assert!(made.layout.paths.len() > 5 * town.paths.len());
    });
    assert!(slope < 1.3, "exponent {slope:.2}");
}

#[test]
fn checks_grow_almost_linearly() {
    let made = |n: usize| network(&town(n), &split()).layout;
    let slope = exponent_of_time([300, 1_200, 4_800], made, |layout| {
        let found = check(layout, &CheckOptions::default());
        let of_network = analyze(layout, &AnalyzeOptions::default());
        // Each block is a part of its own.
        assert!(found.iter().chain(of_network.iter()).count() > 0);
    });
    assert!(slope < 1.3, "exponent {slope:.2}");
}
