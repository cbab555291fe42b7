//! Text files: decodes UTF-8, finds lines and columns, and counts elements and nesting against the
//! limits before a parser sees the text.

use guideway_layout::Limits;

use crate::{Problem, ReadError, source::Source};

/// The byte order mark of UTF-8.
pub(crate) const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The bytes of a text without a byte order mark.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// Decodes the bytes of a file as UTF-8, without a byte order mark.
pub(crate) fn decode_utf8<'b>(source: &Source<'_>, bytes: &'b [u8]) -> Result<&'b str, ReadError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to() as u64;
        source.fail(match error.error_len() {
            None => Problem::Truncated {
                at: bytes.len() as u64,
                detail: "its last character is incomplete".into(),
            },
            Some(_) => Problem::NotUtf8 {
                at,
                detail: "invalid byte sequence",
            },
        })
    })?;
    Ok(text.strip_prefix('\u{FEFF}').unwrap_or(text))
}

/// Escapes control characters of a text for a message, and cuts it to 500 characters.
pub(crate) fn printable(text: &str) -> String {
    const MAX_CHARS: usize = 500;
    let escape = |c: char| match c.is_control() {
        true => c.escape_default().collect(),
        false => String::from(c),
    };
    let mut short: String = text.chars().take(MAX_CHARS).map(escape).collect();
    if text.chars().nth(MAX_CHARS).is_some() {
        short.push('…');
    }
    short
}

/// Formats a number, in scientific notation where its digits would fill the line.
pub(crate) fn compact(number: f64) -> String {
    if number.abs() < 1e15 {
        number.to_string()
    } else {
        format!("{number:e}")
    }
}

/// Returns line and column of a byte, from 1.
pub(crate) fn line_column(text: &str, at: usize) -> (u64, u64) {
    let before = &text.as_bytes()[..at.min(text.len())];
    let line = 1 + before.iter().filter(|&&b| b == b'\n').count() as u64;
    let column = before.iter().rev().take_while(|&&b| b != b'\n').count() as u64 + 1;
    (line, column)
}

/// Counts elements and nesting depth of a text against the limits.
///
/// Parsers hold a record per element and recurse per level, so both are bounded before they see the
/// text.
pub(crate) struct ElementCounter<'a> {
    text: &'a str,
    limits: &'a Limits,
    depth: usize,
    elements: u64,
}

impl<'a> ElementCounter<'a> {
    /// Starts a count for a text.
    pub(crate) fn new(text: &'a str, limits: &'a Limits) -> Self {
        Self {
            text,
            limits,
            depth: 0,
            elements: 0,
        }
    }

    /// Counts the start of an element.
    ///
    /// # Errors
    /// When there are more elements than the limit.
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

    /// Enters a nested level at byte `at`.
    ///
    /// # Errors
    /// When the depth exceeds the limit.
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

    /// Leaves a nested level.
    pub(crate) fn leave(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }
}

/// Decodes `%` and the two digits of a byte, as references have them; `None` if the bytes are not
/// UTF-8 or a `%` has no digits.
pub(crate) fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first != b'%' {
            bytes.push(first);
            continue;
        }
        let (digits, after) = rest.split_at_checked(2)?;
        let digits = str::from_utf8(digits).ok()?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = after;
    }
    String::from_utf8(bytes).ok()
}
