use std::ops::Range;

use arrow_array::ArrayRef;

/// The columns of all record batches, and which rows begin a path that is drawn.
pub(super) struct Table {
    pub(super) batches: Vec<Batch>,
    /// Ascending and apart.
    pub(super) kept: Vec<Range<usize>>,
}

/// One record batch.
pub(super) struct Batch {
    /// Number of its first row in the table.
    pub(super) first_row: usize,
    pub(super) rows: usize,
    pub(super) columns: Vec<ArrayRef>,
}

impl Table {
    /// Number of paths drawn.
    pub(super) fn path_count(&self) -> usize {
        self.kept.iter().map(Range::len).sum()
    }

    /// The kept rows of a batch, counted from its first.
    pub(super) fn kept_in<'a>(&'a self, batch: &'a Batch) -> impl Iterator<Item = usize> + 'a {
        self.stretches_in(batch).flatten()
    }

    /// The same, those that follow each other at once.
    pub(super) fn stretches_in<'a>(
        &'a self,
        batch: &'a Batch,
    ) -> impl Iterator<Item = Range<usize>> + 'a {
        let (start, end) = (batch.first_row, batch.first_row + batch.rows);
        let first = self.kept.partition_point(|r| r.end <= start);
        let last = self.kept.partition_point(|r| r.start < end);
        self.kept[first..last.max(first)]
            .iter()
            .map(move |r| r.start.max(start) - start..r.end.min(end) - start)
    }
}
