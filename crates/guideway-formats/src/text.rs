//! What JSON and XML share: UTF-8, and a look at the size and depth of a text before it is parsed.

use guideway_layout::Limits;

use crate::{Problem, ReadError, source::Source};

/// The text of a file, without a byte order mark.
pub(crate) fn decode_utf8<'b>(source: &Source<'_>, bytes: &'b [u8]) -> Result<&'b str, ReadError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to() as u64;
        source.fail(match error.error_len() {
            None => Problem::Truncated {
                at: bytes.len() as u64,
                detail: "the last character is cut".into(),
            },
            Some(_) => Problem::NotUtf8 {
                at,
                detail: "these bytes are no character",
            },
        })
    })?;
    Ok(text.strip_prefix('\u{FEFF}').unwrap_or(text))
}

/// Text of a file for a message: one line, no control characters, and not without end.
pub(crate) fn printable(text: &str) -> String {
    const MOST: usize = 500;
    let escape = |c: char| match c.is_control() {
        true => c.escape_default().collect(),
        false => String::from(c),
    };
    let mut short: String = text.chars().take(MOST).map(escape).collect();
    if text.chars().nth(MOST).is_some() {
        short.push('…');
    }
    short
}

/// Line and column of a byte, from 1.
pub(crate) fn line_column(text: &str, at: usize) -> (u64, u64) {
    let before = &text.as_bytes()[..at.min(text.len())];
    let line = 1 + before.iter().filter(|&&b| b == b'\n').count() as u64;
    let column = before.iter().rev().take_while(|&&b| b != b'\n').count() as u64 + 1;
    (line, column)
}

/// Counts the depth and the elements of a text against the limits, one step at a time.
///
/// Parsers hold a record for every element and go one call deeper for every level, so both are bounded
/// before they see the text.
pub(crate) struct ElementCounter<'a> {
    text: &'a str,
    limits: &'a Limits,
    depth: usize,
    elements: u64,
}

impl<'a> ElementCounter<'a> {
    pub(crate) fn new(text: &'a str, limits: &'a Limits) -> Self {
        Self {
            text,
            limits,
            depth: 0,
            elements: 0,
        }
    }

    /// An element of the file begins.
    pub(crate) fn count(&mut self) -> Result<(), Problem> {
        self.elements += 1;
        if self.elements <= self.limits.elements {
            return Ok(());
        }
        Err(Problem::LimitReached {
            what: "elements in the file",
            limit: self.limits.elements,
            actual: self.elements,
        })
    }

    /// What follows byte `at` is one level deeper.
    pub(crate) fn enter(&mut self, at: usize) -> Result<(), Problem> {
        self.depth += 1;
        if self.depth <= self.limits.depth {
            return Ok(());
        }
        let (line, column) = line_column(self.text, at);
        Err(Problem::TooDeep {
            limit: self.limits.depth as u64,
            line,
            column,
        })
    }

    /// The level ends.
    pub(crate) fn leave(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }
}
