//! [`Refused`]: the paths of the input that cannot be drawn, with their reasons.

use crate::{Code, Severity, TextColumn};

/// Paths of the input that cannot be drawn.
#[derive(Clone, Debug, Default)]
pub struct Refused {
    ids: TextColumn,
    codes: Vec<Code>,
    details: TextColumn,
}

/// One refused path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefusedPath<'a> {
    /// Identifier in the file.
    pub id: &'a str,
    /// Reason, for programs.
    pub code: Code,
    /// Reason, for people.
    pub detail: &'a str,
}

impl RefusedPath<'_> {
    /// Severity of the refusal: an error whatever its code, unless the file is right. It may hide
    /// a path, and a lift leads to another level.
    pub fn severity(&self) -> Severity {
        match self.code {
            Code::NotDrawn | Code::CrossLevel => Severity::Info,
            _ => Severity::Error,
        }
    }
}

impl Refused {
    /// Records a path that cannot be drawn.
    pub fn push(&mut self, id: &str, code: Code, detail: &str) {
        self.ids.push(id);
        self.codes.push(code);
        self.details.push(detail);
    }

    /// Number of refused paths.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Returns `true` if no path was refused.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// One refused path.
    ///
    /// # Panics
    /// When `row` is not below [`Self::len`].
    pub fn get(&self, row: usize) -> RefusedPath<'_> {
        RefusedPath {
            id: self.ids.get(row),
            code: self.codes[row],
            detail: self.details.get(row),
        }
    }

    /// All refused paths, in file order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = RefusedPath<'_>> {
        (0..self.len()).map(|row| self.get(row))
    }

    /// Heap bytes in use.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes() + self.details.heap_bytes() + self.codes.capacity()
    }
}
