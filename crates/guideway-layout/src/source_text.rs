//! [`SourceSpans`]: the place of each row's object in the text of its file.

use crate::{LineIndex, TextPosition};

/// Start of a row without a place in the text.
const NONE: u32 = u32::MAX;

/// First byte of each row's object in the
/// [source text](crate::Provenance::source_text) and, if that is not kept, its line and column. A
/// writer of the same format copies objects that did not change, byte by byte.
///
/// Rows that were added since the read have no place. Rows past the end have none either.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceSpans {
    starts: Vec<u32>,
    /// Line 0 is no place.
    positions: Vec<TextPosition>,
}

impl SourceSpans {
    /// First byte of the object of a row.
    pub fn start(&self, row: usize) -> Option<usize> {
        let start = *self.starts.get(row)?;
        (start != NONE).then_some(start as usize)
    }

    /// Sets the first byte of the object of a row.
    ///
    /// # Panics
    /// When `start` does not fit `u32`.
    pub fn set(&mut self, row: usize, start: usize) {
        assert!(
            start < NONE as usize,
            "a text with places is smaller than 4 GiB"
        );
        if self.starts.len() <= row {
            self.starts.resize(row + 1, NONE);
        }
        self.starts[row] = start as u32;
    }

    /// Sets the line and column of the object of a row, in a text that is not kept.
    pub fn set_position(&mut self, row: usize, position: TextPosition) {
        if self.positions.len() <= row {
            self.positions.resize(row + 1, TextPosition::default());
        }
        self.positions[row] = position;
    }

    /// Replaces first bytes by lines and columns, for a text that is not kept.
    pub fn keep_positions(&mut self, lines: &LineIndex<'_>) {
        let starts = std::mem::take(&mut self.starts);
        for (row, start) in starts.into_iter().enumerate() {
            if start != NONE {
                self.set_position(row, lines.position(start as usize));
            }
        }
    }

    /// Line and column of the object of a row; `lines` are those of the kept text, if there is one.
    pub fn position(&self, row: usize, lines: Option<&LineIndex<'_>>) -> Option<TextPosition> {
        let stored = self.positions.get(row).copied();
        let stored = stored.filter(|position| position.line > 0);
        stored.or_else(|| Some(lines?.position(self.start(row)?)))
    }

    /// The places of the given rows, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        Self {
            starts: pick(&self.starts, rows, NONE),
            positions: pick(&self.positions, rows, TextPosition::default()),
        }
    }

    /// Heap bytes in use.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
            + self.positions.capacity() * size_of::<TextPosition>()
    }
}

fn pick<T: Copy>(column: &[T], rows: &[usize], none: T) -> Vec<T> {
    match column.is_empty() {
        true => Vec::new(),
        false => {
            let value = |&row: &usize| column.get(row).copied().unwrap_or(none);
            rows.iter().map(value).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selected_rows_keep_their_places() {
        let mut spans = SourceSpans::default();
        spans.set(2, 40);
        spans.set(0, 7);
        spans.set_position(1, TextPosition::line(9));
        let selected = spans.select(&[2, 1, 5, 0]);
        let starts: Vec<_> = (0..5).map(|row| selected.start(row)).collect();
        assert_eq!(starts, [Some(40), None, None, Some(7), None]);
        let text = "one\ntwo\n".repeat(9);
        let lines = LineIndex::new(&text);
        let lines: Vec<_> = (0..4)
            .map(|row| selected.position(row, Some(&lines)).map(|p| p.line))
            .collect();
        assert_eq!(lines, [Some(11), Some(9), None, Some(2)]);
        assert_eq!(selected.position(0, None), None);
    }
}
