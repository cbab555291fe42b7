//! [`Splices`]: the replaced parts of a text; all other bytes stay.

use std::io::{self, Write};
use std::ops::Range;

use super::style::Style;

/// A replaced part of a text.
#[derive(Debug)]
pub(crate) struct Splice {
    range: Range<usize>,
    text: String,
}

/// The replaced parts of a text.
pub(crate) struct Splices<'t> {
    text: &'t str,
    style: Style,
    /// Two names of one member each; a text may use either.
    pub(super) aliases: &'static [[&'static str; 2]],
    all: Vec<Splice>,
}

impl<'t> Splices<'t> {
    /// No splices of a text.
    pub(crate) fn new(text: &'t str, aliases: &'static [[&'static str; 2]]) -> Self {
        Self {
            text,
            style: Style::of(text),
            aliases,
            all: Vec::new(),
        }
    }

    pub(crate) fn text(&self) -> &'t str {
        self.text
    }

    pub(super) fn style(&self) -> &Style {
        &self.style
    }

    /// Replaces a part of the text. Parts must not overlap.
    pub(crate) fn replace(&mut self, range: Range<usize>, text: String) {
        self.all.push(Splice { range, text });
    }

    /// Writes the text with all parts replaced.
    ///
    /// # Errors
    /// When `out` fails.
    pub(crate) fn write(mut self, out: &mut impl Write) -> io::Result<()> {
        // Stable: an insertion at the end of a removed part comes after it.
        self.all.sort_by_key(|splice| splice.range.start);
        let mut from = 0;
        for splice in &self.all {
            out.write_all(&self.text.as_bytes()[from..splice.range.start.max(from)])?;
            out.write_all(splice.text.as_bytes())?;
            from = from.max(splice.range.end);
        }
        out.write_all(&self.text.as_bytes()[from..])
    }
}
