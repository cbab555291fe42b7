//! How many lines the cells have, and any block of them together.

use std::ops::Range;

/// A summed-area table of the cells' counts.
pub(super) struct Table {
    side: usize,
    most: u32,
    /// Of the cells left of and below each corner, rows of `side + 1`.
    sums: Vec<u64>,
}

impl Table {
    /// Bytes of a table.
    pub(super) fn bytes(side: u32) -> u64 {
        let corners = u64::from(side) + 1;
        corners * corners * size_of::<u64>() as u64
    }

    /// From the counts as the device gives them: `u32`, row by row from the lowest.
    pub(super) fn new(counts: &[u8], side: u32) -> Self {
        let side = side as usize;
        let mut most = 0;
        let mut sums = vec![0; (side + 1) * (side + 1)];
        let rows = counts.chunks_exact(side * size_of::<u32>());
        for (y, row) in rows.enumerate() {
            let mut of_row = 0;
            for (x, count) in row.as_chunks().0.iter().enumerate() {
                let count = u32::from_le_bytes(*count);
                most = most.max(count);
                of_row += u64::from(count);
                sums[(y + 1) * (side + 1) + x + 1] = sums[y * (side + 1) + x + 1] + of_row;
            }
        }
        Self { side, most, sums }
    }

    /// Lines in the cell that has most.
    pub(super) fn most(&self) -> u32 {
        self.most
    }

    /// Lines in all cells, counted once for each.
    pub(super) fn total(&self) -> u64 {
        self.within(0..self.side, 0..self.side)
    }

    /// Lines in the cells of these columns and rows.
    pub(super) fn within(&self, columns: Range<usize>, rows: Range<usize>) -> u64 {
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
    fn blocks_are_summed() {
        let counts: [u32; 9] = [1, 2, 3, 4, 5, 6, 7, 8, u32::MAX];
        let table = Table::new(bytemuck::cast_slice(&counts), 3);
        assert_eq!(table.total(), 36 + u64::from(u32::MAX));
        assert_eq!(table.within(1..3, 0..2), 2 + 3 + 5 + 6);
        assert_eq!(table.within(0..1, 2..9), 7);
        assert_eq!(table.within(1..1, 0..3), 0);
    }
}
