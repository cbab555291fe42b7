//! Work cut into pieces that each take a device a short while.

use std::ops::Range;

/// Cuts items, in order, into ranges of limited work.
pub(super) struct Cutter {
    most_work: u64,
    most_items: u32,
    ranges: Vec<Range<u32>>,
    /// Work of the last range.
    work: u64,
}

impl Cutter {
    /// Ranges of at most so much work, unless a single item is more, and of at most so many items.
    pub(super) fn new(most_work: u64, most_items: u32) -> Self {
        Self {
            most_work: most_work.max(1),
            most_items: most_items.max(1),
            ranges: Vec::new(),
            work: 0,
        }
    }

    /// Adds items that share `work` evenly.
    pub(super) fn push(&mut self, items: u32, work: u64) {
        let pieces = work.div_ceil(self.most_work) as u32;
        let pieces = pieces
            .max(items.div_ceil(self.most_items))
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
                if self.work + work <= self.most_work
                    && last.end - last.start + items <= self.most_items =>
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

    /// The ranges: they follow each other from 0 to the number of items.
    pub(super) fn finish(self) -> Vec<Range<u32>> {
        self.ranges
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(most_work: u64, most_items: u32, pushed: &[(u32, u64)]) -> Vec<Range<u32>> {
        let mut cutter = Cutter::new(most_work, most_items);
        pushed
            .iter()
            .for_each(|&(items, work)| cutter.push(items, work));
        cutter.finish()
    }

    #[test]
    fn work_is_gathered_up_to_the_limit() {
        assert_eq!(
            cut(10, 100, &[(1, 4), (1, 6), (1, 1), (1, 10)]),
            [0..2, 2..3, 3..4]
        );
    }

    #[test]
    fn much_work_of_many_items_is_shared_out() {
        assert_eq!(cut(10, 100, &[(4, 40)]), [0..1, 1..2, 2..3, 3..4]);
        assert_eq!(cut(10, 100, &[(3, 14)]), [0..1, 1..3]);
    }

    #[test]
    fn an_item_is_never_cut() {
        assert_eq!(cut(10, 100, &[(1, 1000), (1, 1)]), [0..1, 1..2]);
    }

    #[test]
    fn there_are_never_too_many_items() {
        assert_eq!(cut(10, 4, &[(9, 0)]), [0..3, 3..6, 6..9]);
        assert_eq!(cut(10, 4, &[(3, 0), (3, 0)]), [0..3, 3..6]);
        assert!(cut(10, 4, &[]).is_empty());
    }
}
