//! Table cells and columns that several sections share.

use guideway_bench::page::{Cell, Column};
use guideway_bench::{Measured, Outcome, Row, Summary};

/// Median with the 5th and 95th percentile, for the page.
pub(super) fn median_cell(summary: &Summary) -> Cell {
    Cell::Range([summary.median, summary.p5, summary.p95])
}

/// File columns of the frame times of one row.
const FRAME_KEYS: [&str; 6] = [
    "frame_mean_ms",
    "frame_median_ms",
    "frame_p5_ms",
    "frame_p95_ms",
    "frame_spread",
    "wall_median_ms",
];

/// The columns of [`FRAME_KEYS`].
pub(super) fn frame_columns() -> Vec<Column> {
    let name = |key: &&str| Column::in_file(*key);
    FRAME_KEYS.iter().map(name).collect()
}

/// The cells under [`FRAME_KEYS`].
pub(super) fn frame_cells(measured: Option<&Measured>) -> Vec<Cell> {
    let value = |of: fn(&Measured) -> f64| Cell::from(measured.map(of));
    vec![
        value(|m| m.frame_ms.mean),
        value(|m| m.frame_ms.median),
        value(|m| m.frame_ms.p5),
        value(|m| m.frame_ms.p95),
        value(|m| m.frame_ms.spread),
        value(|m| m.wall_ms.median),
    ]
}

/// Reason why a row was not measured; empty for a measured row.
pub(super) fn why_not(row: &Row) -> Cell {
    match &row.outcome {
        Outcome::Measured(_) => Cell::Nothing,
        Outcome::NotMeasured(why) => Cell::text(why.clone()),
    }
}
