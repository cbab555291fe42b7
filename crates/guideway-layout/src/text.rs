//! [`TextColumn`]: a column of strings in one buffer.

use std::ops::Range;

/// A column of strings in one buffer: 4 bytes per row in addition to the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TextColumn {
    bytes: String,
    ends: Vec<u32>,
}

impl TextColumn {
    /// Most bytes of text per column. Derived: end offsets are `u32`.
    pub const MAX_BYTES: usize = u32::MAX as usize;

    /// An empty column with capacity for `rows` strings and `bytes` bytes of text.
    pub fn with_capacity(rows: usize, bytes: usize) -> Self {
        Self {
            bytes: String::with_capacity(bytes),
            ends: Vec::with_capacity(rows),
        }
    }

    /// Appends a row.
    ///
    /// # Panics
    /// When the column would exceed [`Self::MAX_BYTES`]; readers refuse such files earlier.
    pub fn push(&mut self, text: &str) {
        self.push_all(text, [text.len()]);
    }

    /// Appends adjacent rows of one text: row `i` reaches up to byte `ends[i]`.
    ///
    /// # Panics
    /// As [`Self::push`]; when `ends` decreases, does not end with the text, or splits a character.
    pub fn push_all(&mut self, text: &str, ends: impl IntoIterator<Item = usize>) {
        let before = self.bytes.len();
        self.bytes.push_str(text);
        assert!(
            self.bytes.len() <= Self::MAX_BYTES,
            "a text column holds at most 4 GiB"
        );
        let mut last = 0;
        self.ends.extend(ends.into_iter().map(|end| {
            assert!(
                last <= end && text.is_char_boundary(end),
                "ends of rows must not decrease or split a character"
            );
            last = end;
            (before + end) as u32
        }));
        assert!(last == text.len(), "the last row must end with the text");
    }

    /// Replaces the texts of some rows, which are in increasing order. Cost: O(whole column).
    ///
    /// # Panics
    /// As [`Self::push`]; when a row is not below [`Self::len`].
    pub fn replace(&mut self, rows: &[(usize, &str)]) {
        let mut replaced = Self::with_capacity(self.len(), self.bytes.len());
        let mut next = 0;
        for &(row, text) in rows {
            replaced.append(self, next..row);
            replaced.push(text);
            next = row + 1;
        }
        replaced.append(self, next..self.len());
        *self = replaced;
    }

    /// Appends adjacent rows of another column.
    fn append(&mut self, other: &Self, rows: Range<usize>) {
        let first = match rows.start {
            0 => 0,
            row => other.ends[row - 1] as usize,
        };
        let ends = &other.ends[rows];
        let last = ends.last().map_or(first, |&end| end as usize);
        let ends = ends.iter().map(|&end| end as usize - first);
        self.push_all(&other.bytes[first..last], ends);
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The text of a row.
    ///
    /// # Panics
    /// When `row` is not below [`Self::len`].
    pub fn get(&self, row: usize) -> &str {
        let start = if row == 0 {
            0
        } else {
            self.ends[row - 1] as usize
        };
        &self.bytes[start..self.ends[row] as usize]
    }

    /// All rows in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &str> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.bytes.capacity() + self.ends.capacity() * size_of::<u32>()
    }
}

impl<'a> FromIterator<&'a str> for TextColumn {
    fn from_iter<I: IntoIterator<Item = &'a str>>(rows: I) -> Self {
        let mut column = Self::default();
        rows.into_iter().for_each(|row| column.push(row));
        column
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn push_all_equals_single_pushes() {
        let mut column: TextColumn = ["é", ""].into_iter().collect();
        column.push_all("añb", [1, 1, 3, 4]);
        let rows = ["é", "", "a", "", "ñ", "b"];
        assert_eq!(column, rows.into_iter().collect());
        column.push_all("", []);
        assert_eq!(column.len(), rows.len());
    }

    #[test]
    fn replace_changes_the_given_rows_only() {
        let mut column: TextColumn = ["a", "", "añb", "d"].into_iter().collect();
        column.replace(&[(1, "long"), (3, "")]);
        assert_eq!(column, ["a", "long", "añb", ""].into_iter().collect());
        column.replace(&[(0, "")]);
        assert_eq!(column, ["", "long", "añb", ""].into_iter().collect());
    }

    #[test]
    fn push_all_panics_on_invalid_ends() {
        for ends in [&[2, 1, 4][..], &[1], &[2, 4], &[5]] {
            let push = || TextColumn::default().push_all("añb", ends.iter().copied());
            assert!(std::panic::catch_unwind(push).is_err(), "{ends:?}");
        }
    }
}
