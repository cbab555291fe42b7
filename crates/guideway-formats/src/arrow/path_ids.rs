//! Path identifiers of drawn and refused rows; the row number is the substitute for a missing one.

use arrow_array::ArrayRef;
use guideway_layout::{Code, Diagnostics, Limits, Place, Refused, TextColumn, element_place};

use super::batch::Batch;
use super::budget::Budget;
use super::text_array::TextArray;
use super::text_sink::TextSink;
use crate::Problem;

/// Identifiers under construction.
pub(super) struct PathIds<'a> {
    index: Option<usize>,
    limits: &'a Limits,
    budget: &'a Budget,
    sink: TextSink<'a>,
    refused: Refused,
    unnamed: u64,
}

impl<'a> PathIds<'a> {
    /// Makes the identifiers of column `index`, with capacity for an estimated number of rows.
    pub(super) fn new(
        index: Option<usize>,
        rows: usize,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Self {
        Self {
            index,
            limits,
            budget,
            sink: TextSink::new(limits, budget, rows),
            refused: Refused::default(),
            unnamed: 0,
        }
    }

    /// Appends the drawn and refused rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let texts = id_texts(self.index, &batch.columns)?;
        let number = |row: usize| (batch.rows.start + row).to_string();
        for rows in batch.drawn.iter().cloned() {
            let unnamed = |row| {
                self.unnamed += 1;
                number(row)
            };
            self.sink.push_rows(texts.as_ref(), rows, unnamed)?;
        }
        for &(row, fault) in &batch.refused {
            let number = number(row);
            let id = texts.as_ref().and_then(|t| t.get(row)).unwrap_or(&number);
            self.budget.charge(id.len() as u64)?;
            self.refused
                .push(id, fault.code(), &fault.detail(self.limits));
        }
        Ok(())
    }

    /// Returns the identifiers of drawn paths, and the refused paths.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> (TextColumn, Refused) {
        for path in self.refused.iter() {
            let place = || element_place("path", 0, path.id);
            let remedy = "It is left out; correct its control points";
            diagnostics.push_refused(path, place, remedy);
        }
        if self.unnamed > 0 {
            diagnostics.push(
                Code::Attribute,
                || Place::element("column id"),
                || {
                    format!(
                        "{} paths have no id; their row numbers are used",
                        self.unnamed
                    )
                },
                "Give every path an id, so that it stays identifiable after changes of the file",
            );
        }
        (self.sink.into_column(), self.refused)
    }
}

/// Returns the identifiers of a batch, if the table has a column `index` of them.
pub(super) fn id_texts(
    index: Option<usize>,
    columns: &[ArrayRef],
) -> Result<Option<TextArray<'_>>, Problem> {
    index
        .map(|id| TextArray::from_ids(&columns[id]))
        .transpose()
}
