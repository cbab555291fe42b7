//! [`Numbering`]: the row in the layout of each element that the file refers to by its number.

/// Numbers of the elements of a table in a file, some of which the layout does not have.
#[derive(Debug, Default)]
pub(super) struct Numbering {
    /// Numbers of the elements that the layout does not have, ascending.
    missing: Vec<u32>,
    /// Number of elements in the layout.
    rows: u32,
}

impl Numbering {
    /// Makes the numbering of `rows` elements in the layout, besides the missing ones.
    pub(super) fn new(missing: Vec<u32>, rows: usize) -> Self {
        Self {
            missing,
            rows: rows as u32,
        }
    }

    /// Returns the row of the element with a number, if the layout has it.
    pub(super) fn row(&self, number: u32) -> Option<u32> {
        match self.missing.binary_search(&number) {
            Ok(_) => None,
            Err(before) => Some(number - before as u32).filter(|&row| row < self.rows),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_skip_missing_elements() {
        let numbering = Numbering::new(vec![0, 3, 4], 3);
        let rows: Vec<_> = (0..8).map(|number| numbering.row(number)).collect();
        let expected = [None, Some(0), Some(1), None, None, Some(2), None, None];
        assert_eq!(rows, expected);
    }
}
