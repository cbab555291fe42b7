//! A summed-area table of the lines per cell: sums any block of cells in constant time.
//!
//! Input: counts per cell, read back from the device. Output: sums over blocks of cells.

use std::ops::Range;

/// A summed-area table of the counts per cell.
pub(super) struct CountTable {
    side: usize,
    max_count: u32,
    /// Per corner, the sum over the cells left of and below it; rows of `side + 1` corners.
    sums: Vec<u64>,
}

impl CountTable {
    /// Bytes of a table for a grid of `side` x `side` cells.
    pub(super) fn bytes(side: u32) -> u64 {
        let corners = u64::from(side) + 1;
        corners * corners * size_of::<u64>() as u64
    }

    /// Builds the table from little-endian `u32` counts, row by row from the lowest.
    pub(super) fn new(counts: &[u8], side: u32) -> Self {
        let side = side as usize;
        let mut max_count = 0;
        let mut sums = vec![0; (side + 1) * (side + 1)];
        let rows = counts.chunks_exact(side * size_of::<u32>());
        for (y, row) in rows.enumerate() {
            let mut row_sum = 0;
            for (x, count) in row.as_chunks().0.iter().enumerate() {
                let count = u32::from_le_bytes(*count);
                max_count = max_count.max(count);
                row_sum += u64::from(count);
                sums[(y + 1) * (side + 1) + x + 1] = sums[y * (side + 1) + x + 1] + row_sum;
            }
        }
        Self {
            side,
            max_count,
            sums,
        }
    }

    /// Lines in the fullest cell.
    pub(super) fn max_count(&self) -> u32 {
        self.max_count
    }

    /// Entries of all cells; a line counts once per cell.
    pub(super) fn total(&self) -> u64 {
        self.sum(0..self.side, 0..self.side)
    }

    /// Entries of the cells in a block of columns and rows.
    pub(super) fn sum(&self, columns: Range<usize>, rows: Range<usize>) -> u64 {
        let at =
            |x: usize, y: usize| self.sums[y.min(self.side) * (self.side + 1) + x.min(self.side)];
        at(columns.end, rows.end) + at(columns.start, rows.start)
            - at(columns.start, rows.end)
            - at(columns.end, rows.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_blocks_without_overflow() {
        let counts: [u32; 9] = [1, 2, 3, 4, 5, 6, 7, 8, u32::MAX];
        let table = CountTable::new(bytemuck::cast_slice(&counts), 3);
        assert_eq!(table.total(), 36 + u64::from(u32::MAX));
        assert_eq!(table.sum(1..3, 0..2), 2 + 3 + 5 + 6);
        assert_eq!(table.sum(0..1, 2..9), 7);
        assert_eq!(table.sum(1..1, 0..3), 0);
    }
}
