//! Row kinds: the element that each row of a record batch holds, as runs of rows.

use std::ops::Range;

use arrow_array::RecordBatch;

use super::element::Element;
use super::schema::{ColumnRoles, Role};
use super::text_array::TextArray;
use crate::Problem;

/// Kinds of the rows of a batch: runs of adjacent rows of one kind, `None` if it is unknown.
pub(super) struct RowKinds(Vec<(Option<Element>, Range<usize>)>);

impl RowKinds {
    /// Finds the kinds of the rows of a batch: paths, unless the table has a column of kinds.
    pub(super) fn of(batch: &RecordBatch, columns: &ColumnRoles) -> Result<Self, Problem> {
        let rows = 0..batch.num_rows();
        let Some(index) = columns.get(Role::Element) else {
            return Ok(Self(vec![(Some(Element::Path), rows)]));
        };
        let names = TextArray::new(batch.column(index))?;
        let mut runs: Vec<(Option<Element>, Range<usize>)> = Vec::new();
        // Most rows have the name of the row before.
        let mut last = ("", None);
        for row in rows {
            let name = names.get(row).unwrap_or(Element::Path.name());
            if runs.is_empty() || name != last.0 {
                last = (name, Element::named(name));
            }
            match runs.last_mut().filter(|run| run.0 == last.1) {
                Some(run) => run.1.end = row + 1,
                None => runs.push((last.1, row..row + 1)),
            }
        }
        Ok(Self(runs))
    }

    /// Iterates over the runs of all kinds.
    pub(super) fn runs(&self) -> impl Iterator<Item = (Option<Element>, Range<usize>)> {
        self.0.iter().cloned()
    }

    /// Returns the rows of a kind: ascending, disjoint ranges.
    pub(super) fn rows(&self, kind: Element) -> impl Iterator<Item = Range<usize>> {
        let of_kind = self.0.iter().filter(move |run| run.0 == Some(kind));
        of_kind.map(|run| run.1.clone())
    }

    /// Returns the number of rows of unknown kinds.
    pub(super) fn unknown(&self) -> usize {
        let unknown = self.0.iter().filter(|run| run.0.is_none());
        unknown.map(|run| run.1.len()).sum()
    }

    /// Returns whether any row holds an element of this kind.
    pub(super) fn has(&self, kind: Element) -> bool {
        self.rows(kind).next().is_some()
    }
}
