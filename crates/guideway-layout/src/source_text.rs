//! [`SourceSpans`]: the place of each row's object in the text of its file.

/// Start of a row without a place in the text.
const NONE: u32 = u32::MAX;

/// First byte of each row's object in [`Provenance::text`](crate::Provenance::text). A writer of
/// the same format copies objects that did not change, byte by byte.
///
/// Rows that were added since the read have no place. Rows past the end have none either.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceSpans {
    starts: Vec<u32>,
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
    /// When `start` does not fit `u32`; texts of that size are not kept.
    pub fn set(&mut self, row: usize, start: usize) {
        assert!(start < NONE as usize, "a kept text is smaller than 4 GiB");
        if self.starts.len() <= row {
            self.starts.resize(row + 1, NONE);
        }
        self.starts[row] = start as u32;
    }

    /// The places of the given rows, in this order.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let start = |&row: &usize| self.starts.get(row).copied().unwrap_or(NONE);
        match self.starts.is_empty() {
            true => Self::default(),
            false => Self {
                starts: rows.iter().map(start).collect(),
            },
        }
    }

    /// Heap bytes in use.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
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
        let selected = spans.select(&[2, 1, 5, 0]);
        let starts: Vec<_> = (0..5).map(|row| selected.start(row)).collect();
        assert_eq!(starts, [Some(40), None, None, Some(7), None]);
    }
}
