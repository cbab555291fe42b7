//! Growth of the cost of splits and welds, as the exponent of a power of the number of paths.

use guideway_growth::exponent_of_time;
use guideway_layout::{Layout, NewPath};

use super::network::line;
use crate::site::{document_of, p};

/// Streets and avenues that cross, `n` lines in blocks of ten by ten; `n` is a multiple of 20.
fn town(n: usize) -> Layout {
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
    layout
}

#[test]
fn splits_and_welds_grow_almost_linearly() {
    let slope = exponent_of_time([240, 960, 3_840], town, |town| {
        let mut document = document_of(town.clone());
        document.select_all();
        let nodes = document
            .split_at_crossings(&document.selection().clone())
            .unwrap();
        assert_eq!(nodes.len(), 5 * town.paths.len());
        document.weld(&document.selection().clone(), 0.1).unwrap();
        document.undo();
    });
    // A quadratic step gives 2; tests that run beside it took it over 1.3 once.
    assert!(slope < 1.5, "exponent {slope:.2}");
}
