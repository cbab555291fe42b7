//! Text sink: collects a column of text within the limits and the budget.

use std::fmt::{self, Display, Write};
use std::ops::Range;

use guideway_layout::{Limits, TextColumn};

use super::budget::Budget;
use super::text_array::TextArray;
use crate::Problem;

/// A column of text under construction.
pub(super) struct TextSink<'a> {
    column: TextColumn,
    limits: &'a Limits,
    budget: &'a Budget,
    bytes: usize,
}

impl<'a> TextSink<'a> {
    /// Makes an empty column with capacity for an estimated number of rows.
    pub(super) fn new(limits: &'a Limits, budget: &'a Budget, rows: usize) -> Self {
        Self {
            column: TextColumn::with_capacity(rows, 0),
            limits,
            budget,
            bytes: 0,
        }
    }

    /// Appends a text.
    pub(super) fn push(&mut self, text: &str) -> Result<(), Problem> {
        self.check(text.len(), text.len())?;
        self.column.push(text);
        Ok(())
    }

    /// Appends a value, formatted as text. Returns whether it can be formatted.
    pub(super) fn push_formatted(&mut self, value: impl Display) -> Result<bool, Problem> {
        let mut text = BoundedString::new(self.limits.text_bytes);
        let written = write!(text, "{value}");
        if text.is_full {
            return Err(too_long(text.limit, text.limit + 1));
        }
        match written {
            Ok(()) => self.push(&text.text).map(|()| true),
            Err(fmt::Error) => Ok(false),
        }
    }

    /// Appends several rows, with the result of `missing` for rows without a text.
    pub(super) fn push_rows(
        &mut self,
        texts: Option<&TextArray>,
        rows: Range<usize>,
        mut missing: impl FnMut(usize) -> String,
    ) -> Result<(), Problem> {
        if let Some(all) = texts.and_then(|texts| texts.contiguous(rows.clone())) {
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

    /// Charges `bytes`, of which the longest text has `longest`.
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

    /// Returns the column.
    pub(super) fn into_column(self) -> TextColumn {
        self.column
    }
}

/// String that fails to grow beyond a limit: a nested value may format to many times its size.
struct BoundedString {
    text: String,
    limit: usize,
    is_full: bool,
}

impl BoundedString {
    fn new(limit: usize) -> Self {
        Self {
            text: String::new(),
            limit,
            is_full: false,
        }
    }
}

impl Write for BoundedString {
    fn write_str(&mut self, more: &str) -> fmt::Result {
        if self.text.len() + more.len() > self.limit {
            self.is_full = true;
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
