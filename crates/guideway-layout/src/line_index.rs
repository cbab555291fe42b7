//! [`LineIndex`]: finds line and column of a byte of a text, and [`TextPosition`], the answer.

/// Bytes from checkpoint to checkpoint. Each lookup scans half of them on average.
const BLOCK_BYTES: usize = 1 << 10;

/// A place in a text: line and column count characters from 1. Column 0 is unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextPosition {
    /// Line, from 1.
    pub line: u32,
    /// Character in the line, from 1; 0 if only the line is known.
    pub column: u32,
}

impl TextPosition {
    /// The first byte of a text.
    pub const FIRST: Self = Self { line: 1, column: 1 };

    /// A line whose column is unknown.
    pub fn line(line: u32) -> Self {
        Self { line, column: 0 }
    }

    /// The place of a byte of a text that begins here; `within` is its place in the text alone.
    #[must_use]
    pub fn then(self, within: Self) -> Self {
        let column = match within.line {
            0 | 1 => self.column.saturating_add(within.column).saturating_sub(1),
            _ => within.column,
        };
        Self {
            line: self.line.saturating_add(within.line).saturating_sub(1),
            column,
        }
    }

    /// The place behind some bytes that begin here.
    #[must_use]
    pub fn after(self, bytes: &[u8]) -> Self {
        let newlines = bytes.iter().filter(|b| **b == b'\n').count() as u32;
        let last = match newlines {
            0 => bytes,
            _ => bytes.rsplit(|b| *b == b'\n').next().unwrap_or_default(),
        };
        // Every byte but those that continue a character of UTF-8.
        let characters = last.iter().filter(|b| **b & 0xC0 != 0x80).count() as u32;
        let before = if newlines == 0 { self.column } else { 1 };
        Self {
            line: self.line.saturating_add(newlines),
            column: before.saturating_add(characters),
        }
    }
}

/// Checkpoints of a text, from which any byte is near: 8 bytes per kilobyte.
#[derive(Clone, Debug)]
pub struct LineIndex<'t> {
    text: &'t [u8],
    blocks: Vec<TextPosition>,
}

impl<'t> LineIndex<'t> {
    /// Counts the lines of a text, in one pass.
    pub fn new(text: &'t str) -> Self {
        // A byte order mark is no character of the first line.
        let column = u32::from(!text.starts_with('\u{FEFF}'));
        let text = text.as_bytes();
        let mut at = TextPosition { line: 1, column };
        let mut blocks = Vec::with_capacity(text.len() / BLOCK_BYTES + 1);
        for block in text.chunks(BLOCK_BYTES) {
            blocks.push(at);
            at = at.after(block);
        }
        Self { text, blocks }
    }

    /// The line and column of a byte of the text, or of the last one before its end.
    pub fn position(&self, byte: usize) -> TextPosition {
        let byte = byte.min(self.text.len());
        let block = (byte / BLOCK_BYTES).min(self.blocks.len().saturating_sub(1));
        let Some(start) = self.blocks.get(block) else {
            return TextPosition::FIRST;
        };
        start.after(&self.text[block * BLOCK_BYTES..byte])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_of_each_line() {
        let long = "ä".repeat(BLOCK_BYTES);
        let text = format!("a\nhälle b\n{long}\n\nend");
        let lines = LineIndex::new(&text);
        let at = |part: &str| {
            let TextPosition { line, column } = lines.position(text.find(part).unwrap());
            (line, column)
        };
        assert_eq!(at("a"), (1, 1));
        assert_eq!(at("b"), (2, 7));
        assert_eq!(at("end"), (5, 1));
        let TextPosition { line, column } = lines.position("a\nhälle b\n".len() + 2 * 700);
        assert_eq!((line, column), (3, 701));
        assert_eq!(LineIndex::new("").position(7).line, 1);
        for (before, text) in [("ä\nbc", "d\nef"), ("ab", "cd"), ("", "\n"), ("a\n", "")] {
            let [start, within] = [before, text].map(|t| TextPosition::FIRST.after(t.as_bytes()));
            let whole = [before, text].concat();
            let expected = TextPosition::FIRST.after(whole.as_bytes());
            assert_eq!(start.then(within), expected, "{before:?}");
        }
        assert_eq!(LineIndex::new("\u{FEFF}{}").position(4).column, 2);
    }
}
