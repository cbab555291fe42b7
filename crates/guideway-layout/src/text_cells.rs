//! [`TextCells`]: a column of optional texts whose rows can be replaced one by one.

use crate::TextColumn;

/// Span of a row without a text.
const ABSENT: [u32; 2] = [u32::MAX, 0];

/// A column of optional texts in one buffer: 8 bytes per row in addition to the text.
///
/// Equal texts of consecutive rows share their bytes. Replacing a text costs its length: the old
/// bytes stay in the buffer until the column is copied by [`Self::select`].
#[derive(Clone, Debug, Default)]
pub struct TextCells {
    bytes: String,
    /// First byte and end of each row's text, or [`ABSENT`].
    spans: Vec<[u32; 2]>,
}

impl TextCells {
    /// A column of texts; row `i` has one where `present[i]` is true.
    ///
    /// # Panics
    /// When the columns differ in length.
    pub fn from_column(text: &TextColumn, present: &[bool]) -> Self {
        assert_eq!(
            text.len(),
            present.len(),
            "columns must have the same length"
        );
        let mut cells = Self::default();
        for (text, &present) in text.iter().zip(present) {
            cells.push(present.then_some(text));
        }
        cells
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// The text of a row; `None` if it has none or lies past the end.
    pub fn get(&self, row: usize) -> Option<&str> {
        let span = *self.spans.get(row)?;
        (span != ABSENT).then(|| &self.bytes[span[0] as usize..span[1] as usize])
    }

    /// The cells of all rows.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Option<&str>> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// Appends a row.
    ///
    /// # Panics
    /// When the column would exceed [`TextColumn::MAX_BYTES`]; readers refuse such files earlier.
    pub fn push(&mut self, text: Option<&str>) {
        let span = self.span_of(self.len(), text);
        self.spans.push(span);
    }

    /// Sets or removes the text of a row; appends rows without a text before it as needed.
    ///
    /// # Panics
    /// As [`Self::push`].
    pub(crate) fn set(&mut self, row: usize, text: Option<&str>) {
        self.pad_to(row + 1);
        self.spans[row] = self.span_of(row, text);
    }

    /// Appends rows without a text until the column has `rows` rows.
    pub(crate) fn pad_to(&mut self, rows: usize) {
        if self.len() < rows {
            self.spans.resize(rows, ABSENT);
        }
    }

    /// The given rows, in this order; rows past the end have no text.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let mut selected = Self::default();
        rows.iter().for_each(|&row| selected.push(self.get(row)));
        selected
    }

    /// Heap bytes in use.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.bytes.capacity() + self.spans.capacity() * size_of::<[u32; 2]>()
    }

    /// Span of a text that is about to be stored in `row`.
    fn span_of(&mut self, row: usize, text: Option<&str>) -> [u32; 2] {
        let Some(text) = text else {
            return ABSENT;
        };
        if row > 0 && self.get(row - 1) == Some(text) {
            return self.spans[row - 1];
        }
        let start = self.bytes.len();
        self.bytes.push_str(text);
        let end = self.bytes.len();
        assert!(
            end < TextColumn::MAX_BYTES,
            "a text column holds at most 4 GiB"
        );
        [start as u32, end as u32]
    }
}

impl<'a> FromIterator<Option<&'a str>> for TextCells {
    fn from_iter<I: IntoIterator<Item = Option<&'a str>>>(rows: I) -> Self {
        let mut cells = Self::default();
        rows.into_iter().for_each(|text| cells.push(text));
        cells
    }
}

impl PartialEq for TextCells {
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn returns_the_texts_that_were_set() {
        let mut cells: TextCells = [Some("é"), None, Some("")].into_iter().collect();
        cells.set(4, Some("b"));
        cells.set(0, Some("longer"));
        cells.set(2, None);
        let rows = [Some("longer"), None, None, None, Some("b")];
        assert!(cells.iter().eq(rows));
        assert_eq!(cells.get(5), None);
        let selected = cells.select(&[4, 0, 9]);
        assert!(selected.iter().eq([Some("b"), Some("longer"), None]));
    }

    #[test]
    fn equality_compares_cells_and_ignores_replaced_texts() {
        let mut a: TextCells = [Some("old"), Some("x")].into_iter().collect();
        let b: TextCells = [Some("new"), Some("x")].into_iter().collect();
        assert_ne!(a, b);
        a.set(0, Some("new"));
        assert_eq!(a, b);
        assert_ne!(a, [Some("new"), None].into_iter().collect());
    }

    #[test]
    fn repeated_texts_share_their_bytes() {
        let mut cells = TextCells::default();
        (0..1000).for_each(|_| cells.push(Some("BIDIRECTIONAL")));
        assert!(cells.bytes.len() < 100);
    }
}
