//! [`Place`]: the position of a finding in its source, and [`Origin`], from which its line follows.

use std::fmt;

use crate::{Member, TextPosition};

/// Position of a finding in its source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Element of the file, such as `layouts[0].edges[3].trajectory` or `path "A --- B"`.
    pub element: String,
    /// Line in a text file, counted from 1.
    pub line: Option<u32>,
    /// Character in the line, counted from 1.
    pub column: Option<u32>,
    /// Row in a table, counted from 1; of a file that is no text.
    pub row: Option<u32>,
    /// The element or byte from which the line follows.
    pub origin: Option<Origin>,
}

/// The element or byte from which the line of a place follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// An element of the layout.
    Member(Member),
    /// A byte of the text that is read.
    Byte(usize),
}

impl Place {
    /// An element without a line.
    pub fn element(element: impl Into<String>) -> Self {
        Self {
            element: element.into(),
            ..Self::default()
        }
    }

    /// An element on a line.
    pub fn on_line(element: impl Into<String>, line: u32) -> Self {
        Self::element(element).at(TextPosition::line(line))
    }

    /// The same place with its line and column.
    #[must_use]
    pub fn at(mut self, position: TextPosition) -> Self {
        self.line = (position.line > 0).then_some(position.line);
        self.column = (position.column > 0).then_some(position.column);
        self
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.element)?;
        match (self.line, self.row) {
            (Some(line), _) => write!(f, " (line {line})"),
            (None, Some(row)) => write!(f, " (row {row})"),
            (None, None) => Ok(()),
        }
    }
}
