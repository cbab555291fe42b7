//! Growth of the cost of splits and welds, as the exponent of a power of the number of paths.

use std::time::Instant;

use guideway_document::Document;
use guideway_layout::{Layout, NewPath};

use super::network::line;
use crate::site::{document_of, p};

/// Streets and avenues that cross, `n` lines in blocks of ten by ten; `n` is a multiple of 20.
fn town(n: usize) -> Document {
    let mut layout = Layout::default();
    let side = ((n as f64 / 20.0).sqrt().ceil()) as usize;
    for row in 0..n {
        let (block, i) = (row / 20, (row % 20) / 2);
        let (x, y) = ((block % side) as f64 * 12.0, (block / side) as f64 * 12.0);
        let at = i as f64 + 0.5;
        let ends = match row % 2 {
            0 => [p(x + at, y), p(x + at, y + 10.0)],
            _ => [p(x, y + at), p(x + 10.0, y + at)],
        };
        layout.paths.push(&NewPath {
            id: &format!("s{row}"),
            runs: &line(ends[0], ends[1]),
            ..NewPath::default()
        });
    }
    let mut document = document_of(layout);
    document.select_all();
    document
}

/// Slope of the line through (log size, log cost) with the least squared distances; the best of
/// three runs per size counts, because other programs may run beside.
fn exponent(sizes: [usize; 3], mut run: impl FnMut(usize) -> f64) -> f64 {
    let points = sizes.map(|n| {
        let best = (0..3).map(|_| run(n)).fold(f64::INFINITY, f64::min);
        ((n as f64).ln(), best.ln())
    });
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / 3.0;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    covariance / points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum::<f64>()
}

#[test]
fn splits_and_welds_grow_almost_linearly() {
    let slope = exponent([240, 960, 3_840], |n| {
        let mut document = town(n);
        let start = Instant::now();
        let nodes = document
            .split_at_crossings(&document.selection().clone())
            .unwrap();
        assert_eq!(nodes.len(), 5 * n);
        document.weld(&document.selection().clone(), 0.1).unwrap();
        document.undo();
        start.elapsed().as_secs_f64()
    });
    assert!(slope < 1.3, "exponent {slope:.2}");
}
