//! A pass: the part of the work that every pixel does in one dispatch.

use std::ops::Range;

/// A range of cell rows and of lines per cell that every pixel tests in one dispatch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pass {
    /// Index of the chunk.
    pub(super) chunk: usize,
    /// Rows of cells, counted from the lowest row that a pixel reads.
    pub(super) cell_rows: Range<u32>,
    /// Lines, counted from the first line of each cell.
    pub(super) lines: Range<u32>,
    pub(super) is_first: bool,
    pub(super) is_last: bool,
    /// Number of passes over the chunk.
    pub(super) passes_of_chunk: u64,
}
