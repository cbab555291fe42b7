//! [`Numbering`]: the row in the layout of each element that the file refers to by its number.

use std::ops::Range;

/// Numbers of the elements of a table in a file, some of which the layout does not have.
#[derive(Debug, Default)]
pub(super) struct Numbering {
    /// Numbers that the layout does not have: ascending, disjoint ranges.
    gaps: Vec<Gap>,
    /// Number of elements in the layout.
    rows: u32,
}

#[derive(Debug)]
struct Gap {
    numbers: Range<u32>,
    /// Numbers in all gaps up to the end of this one.
    missing: u32,
    /// They are beyond the area of the read, not wrong.
    is_skipped: bool,
}

impl Numbering {
    /// Makes the numbering of `rows` elements in the layout, besides the missing ones and those
    /// that were not read; both are ascending, and have nothing in common.
    pub(super) fn new(missing: Vec<u32>, skipped: Vec<Range<u32>>, rows: usize) -> Self {
        let missing = missing
            .into_iter()
            .map(|number| (number..number.saturating_add(1), false));
        let skipped = skipped.into_iter().map(|numbers| (numbers, true));
        let mut all: Vec<_> = missing.chain(skipped).collect();
        all.sort_unstable_by_key(|(numbers, _)| numbers.start);
        let mut count = 0;
        let gap = |(numbers, is_skipped): (Range<u32>, bool)| {
            count = u32::saturating_add(count, numbers.len() as u32);
            Gap {
                numbers,
                missing: count,
                is_skipped,
            }
        };
        Self {
            gaps: all.into_iter().map(gap).collect(),
            rows: rows as u32,
        }
    }

    /// Returns the row of the element with a number, if the layout has it.
    pub(super) fn row(&self, number: u32) -> Option<u32> {
        let row = match self.gap_before(number) {
            None => number,
            Some(gap) if gap.numbers.contains(&number) => return None,
            Some(gap) => number.checked_sub(gap.missing)?,
        };
        Some(row).filter(|&row| row < self.rows)
    }

    /// Returns `true` if the element with a number was not read.
    pub(super) fn is_skipped(&self, number: u32) -> bool {
        let gap = self.gap_before(number);
        gap.is_some_and(|gap| gap.is_skipped && gap.numbers.contains(&number))
    }

    /// The last gap that begins at or before a number.
    fn gap_before(&self, number: u32) -> Option<&Gap> {
        let after = self.gaps.partition_point(|gap| gap.numbers.start <= number);
        self.gaps[..after].last()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_skip_missing_elements() {
        let numbering = Numbering::new(vec![0, 3, 4], Vec::new(), 3);
        let rows: Vec<_> = (0..8).map(|number| numbering.row(number)).collect();
        let expected = [None, Some(0), Some(1), None, None, Some(2), None, None];
        assert_eq!(rows, expected);
        assert!((0..8).all(|number| !numbering.is_skipped(number)));
    }

    #[test]
    fn numbers_skip_ranges_that_were_not_read() {
        let numbering = Numbering::new(vec![4], vec![0..2, 5..7], 3);
        let rows: Vec<_> = (0..10).map(|number| numbering.row(number)).collect();
        let none = [None; 3];
        let expected = [
            &none[..2],
            &[Some(0), Some(1)],
            &none,
            &[Some(2), None, None],
        ]
        .concat();
        assert_eq!(rows, expected);
        let skipped = (0..10).filter(|&number| numbering.is_skipped(number));
        assert!(skipped.eq([0, 1, 5, 6]));
    }
}
