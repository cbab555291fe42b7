//! Splits work into ranges that a device finishes in a short time each.
//!
//! Input: items and their work. Output: consecutive ranges of items within a limit.

use std::ops::Range;

use crate::params::ALL;

/// Splits `count` things into consecutive ranges of `at_once` each. The last range is open: it ends
/// at [`ALL`].
pub(super) fn equal_ranges(count: u32, at_once: u32) -> Vec<Range<u32>> {
    let mut ranges: Vec<_> = (0..count.max(1))
        .step_by(at_once.max(1) as usize)
        .map(|first| first..first.saturating_add(at_once))
        .collect();
    if let Some(last) = ranges.last_mut() {
        last.end = ALL;
    }
    ranges
}

/// Splits items, in order, into ranges of limited work.
pub(super) struct WorkSplitter {
    max_work: u64,
    max_items: u32,
    ranges: Vec<Range<u32>>,
    /// Work of the last range.
    work: u64,
}

impl WorkSplitter {
    /// Limits each range to `max_work`, unless a single item exceeds it, and to `max_items`.
    pub(super) fn new(max_work: u64, max_items: u32) -> Self {
        Self {
            max_work: max_work.max(1),
            max_items: max_items.max(1),
            ranges: Vec::new(),
            work: 0,
        }
    }

    /// Adds items that share `work` evenly.
    pub(super) fn push(&mut self, items: u32, work: u64) {
        let pieces = work.div_ceil(self.max_work) as u32;
        let pieces = pieces
            .max(items.div_ceil(self.max_items))
            .clamp(1, items.max(1));
        let part = |all: u64, piece: u32| all * u64::from(piece) / u64::from(pieces);
        for piece in 0..pieces {
            let of = |all: u64| part(all, piece + 1) - part(all, piece);
            self.push_piece(of(items.into()) as u32, of(work));
        }
    }

    fn push_piece(&mut self, items: u32, work: u64) {
        let end = self.ranges.last().map_or(0, |last| last.end);
        match self.ranges.last_mut() {
            Some(last)
                if self.work + work <= self.max_work
                    && last.end - last.start + items <= self.max_items =>
            {
                last.end += items;
                self.work += work;
            }
            _ => {
                self.ranges.push(end..end + items);
                self.work = work;
            }
        }
    }

    /// Returns the ranges: consecutive, from 0 to the number of items.
    pub(super) fn finish(self) -> Vec<Range<u32>> {
        self.ranges
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(max_work: u64, max_items: u32, pushed: &[(u32, u64)]) -> Vec<Range<u32>> {
        let mut splitter = WorkSplitter::new(max_work, max_items);
        pushed
            .iter()
            .for_each(|&(items, work)| splitter.push(items, work));
        splitter.finish()
    }

    #[test]
    fn fills_each_range_up_to_the_work_limit() {
        assert_eq!(
            split(10, 100, &[(1, 4), (1, 6), (1, 1), (1, 10)]),
            [0..2, 2..3, 3..4]
        );
    }

    #[test]
    fn splits_large_work_evenly_over_its_items() {
        assert_eq!(split(10, 100, &[(4, 40)]), [0..1, 1..2, 2..3, 3..4]);
        assert_eq!(split(10, 100, &[(3, 14)]), [0..1, 1..3]);
    }

    #[test]
    fn gives_an_oversized_item_a_range_without_splitting_it() {
        assert_eq!(split(10, 100, &[(1, 1000), (1, 1)]), [0..1, 1..2]);
    }

    #[test]
    fn limits_the_items_of_each_range() {
        assert_eq!(split(10, 4, &[(9, 0)]), [0..3, 3..6, 6..9]);
        assert_eq!(split(10, 4, &[(3, 0), (3, 0)]), [0..3, 3..6]);
        assert!(split(10, 4, &[]).is_empty());
    }
}
