//! Growth of the cost of `build`, as the exponent of a power of the number of lines.

use std::time::Instant;

use guideway_layout::Layout;

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

/// Runs per size.
const REPEATS: u32 = 7;

/// Slope of the line through (log size, log cost) with the least squared distances; the best run
/// per size counts, because other programs may run beside.
pub(crate) fn exponent(sizes: [usize; 3], mut run: impl FnMut(usize) -> f64) -> f64 {
    let points: Vec<(f64, f64)> = sizes
        .iter()
        .map(|&n| {
            let best = (0..REPEATS).map(|_| run(n)).fold(f64::INFINITY, f64::min);
            ((n as f64).ln(), best.ln())
        })
        .collect();
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / 3.0;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>()
}

#[test]
fn build_grows_almost_linearly() {
    let slope = exponent([1_000, 4_000, 16_000], |n| {
        let town = town(n);
        let start = Instant::now();
        let made = network(&town, &split());
        assert!(made.layout.paths.len() > 5 * n);
        start.elapsed().as_secs_f64()
    });
    assert!(slope < 1.3, "exponent {slope:.2}");
}
