use std::fmt::{self, Display, Write};
use std::ops::Range;

use guideway_layout::{Limits, TextColumn};

use super::budget::Budget;
use super::guard::damaged;
use super::text::Texts;
use crate::Problem;

/// Collects a column of text within the limits.
pub(super) struct TextSink<'a> {
    column: TextColumn,
    limits: &'a Limits,
    budget: &'a Budget,
    bytes: usize,
}

impl<'a> TextSink<'a> {
    pub(super) fn new(limits: &'a Limits, budget: &'a Budget, rows: usize) -> Self {
        Self {
            column: TextColumn::with_capacity(rows, 0),
            limits,
            budget,
            bytes: 0,
        }
    }

    pub(super) fn push(&mut self, text: &str) -> Result<(), Problem> {
        self.check(text.len(), text.len())?;
        self.column.push(text);
        Ok(())
    }

    /// Appends what a value is written as.
    pub(super) fn push_written(&mut self, value: impl Display) -> Result<(), Problem> {
        let mut text = Bounded::new(self.limits.text_bytes);
        if write!(text, "{value}").is_err() {
            return Err(text.problem("the value cannot be written as text"));
        }
        self.push(&text.text)
    }

    /// Appends some rows, and what `missing` says in place of those that have no text.
    pub(super) fn push_rows(
        &mut self,
        texts: Option<&Texts>,
        rows: Range<usize>,
        mut missing: impl FnMut(usize) -> String,
    ) -> Result<(), Problem> {
        if let Some(all) = texts.and_then(|texts| texts.side_by_side(rows.clone())) {
            let longest = all.lengths().max().unwrap_or_default();
            self.check(all.text.len(), longest)?;
            self.column.push_all(all.text, all.ends());
            return Ok(());
        }
        for row in rows {
            match texts.and_then(|texts| texts.get(row)) {
                Some(text) => self.push(text)?,
                None => self.push(&missing(row))?,
            }
        }
        Ok(())
    }

    /// Whether so many bytes more may be held, of which so many are one text.
    fn check(&mut self, bytes: usize, longest: usize) -> Result<(), Problem> {
        if longest > self.limits.text_bytes {
            return Err(too_long(self.limits.text_bytes, longest));
        }
        self.budget.charge(bytes as u64)?;
        self.bytes += bytes;
        if self.bytes > TextColumn::MAX_BYTES {
            return Err(Problem::LimitReached {
                what: "bytes in a column of text",
                limit: TextColumn::MAX_BYTES as u64,
                actual: self.bytes as u64,
            });
        }
        Ok(())
    }

    pub(super) fn into_column(self) -> TextColumn {
        self.column
    }
}

/// Text that stops growing at a limit: nested values can be written out far larger than they are stored.
struct Bounded {
    text: String,
    limit: usize,
    full: bool,
}

impl Bounded {
    fn new(limit: usize) -> Self {
        Self {
            text: String::new(),
            limit,
            full: false,
        }
    }

    fn problem(&self, otherwise: &str) -> Problem {
        if self.full {
            return too_long(self.limit, self.limit + 1);
        }
        damaged("attribute", otherwise)
    }
}

impl Write for Bounded {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if self.text.len() + more.len() > self.limit {
            self.full = true;
            return Err(fmt::Error);
        }
        self.text.push_str(more);
        Ok(())
    }
}

fn too_long(limit: usize, actual: usize) -> Problem {
    Problem::LimitReached {
        what: "bytes in one text",
        limit: limit as u64,
        actual: actual as u64,
    }
}
