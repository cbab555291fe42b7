//! [`HiddenStrokes`]: which strokes of the device draw hidden paths. Their points stay there.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// A bit per stroke, which threads may set at the same time.
#[derive(Default)]
pub(crate) struct HiddenStrokes {
    words: Vec<AtomicU64>,
}

impl HiddenStrokes {
    /// Makes room for the bits of `strokes` strokes; new strokes are shown.
    pub(crate) fn grow(&mut self, strokes: usize) {
        let words = strokes.div_ceil(64).max(self.words.len());
        self.words.resize_with(words, AtomicU64::default);
    }

    /// Returns `true` if the path of a stroke is hidden.
    pub(crate) fn is_hidden(&self, stroke: u32) -> bool {
        let word = self.words.get(stroke as usize / 64);
        word.is_some_and(|word| word.load(Relaxed) >> (stroke % 64) & 1 == 1)
    }

    /// Hides or shows a stroke. Returns `true` if that is a change.
    pub(crate) fn set(&self, stroke: u32, is_hidden: bool) -> bool {
        let Some(word) = self.words.get(stroke as usize / 64) else {
            return false;
        };
        let bit = 1 << (stroke % 64);
        let before = match is_hidden {
            true => word.fetch_or(bit, Relaxed),
            false => word.fetch_and(!bit, Relaxed),
        };
        (before & bit != 0) != is_hidden
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_are_hidden_and_shown_one_by_one() {
        let mut hidden = HiddenStrokes::default();
        assert!(!hidden.is_hidden(70) && !hidden.set(70, true));
        hidden.grow(71);
        assert!(hidden.set(70, true) && !hidden.set(70, true));
        hidden.grow(300);
        let all: Vec<u32> = (0..300)
            .filter(|&stroke| hidden.is_hidden(stroke))
            .collect();
        assert_eq!(all, [70]);
        assert!(hidden.set(70, false) && !hidden.is_hidden(70));
    }
}
