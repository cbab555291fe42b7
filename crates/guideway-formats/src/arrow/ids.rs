use arrow_array::ArrayRef;
use guideway_layout::{Code, Diagnostics, Limits, Place, Refused, TextColumn};

use super::batch::Batch;
use super::budget::Budget;
use super::text::Texts;
use super::text_sink::TextSink;
use crate::Problem;

/// What drawn and refused paths are called: by the number of their row where they have no identifier.
pub(super) struct Ids<'a> {
    index: Option<usize>,
    limits: &'a Limits,
    budget: &'a Budget,
    sink: TextSink<'a>,
    refused: Refused,
    unnamed: u64,
}

impl<'a> Ids<'a> {
    /// The identifiers in column `index`, with room for about so many rows.
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

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let texts = texts(self.index, &batch.columns)?;
        let number = |row: usize| (batch.rows.start + row).to_string();
        for rows in batch.kept.iter().cloned() {
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

    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> (TextColumn, Refused) {
        if self.unnamed > 0 {
            diagnostics.push(
                Code::Attribute,
                || Place::element("column id"),
                || {
                    format!(
                        "{} paths have no id; the number of their row is used",
                        self.unnamed
                    )
                },
                "Give every path an id, so that it is found again after the file has changed",
            );
        }
        (self.sink.into_column(), self.refused)
    }
}

/// The identifiers of a batch, if column `index` holds them.
pub(super) fn texts(
    index: Option<usize>,
    columns: &[ArrayRef],
) -> Result<Option<Texts<'_>>, Problem> {
    index.map(|id| Texts::of_id(&columns[id])).transpose()
}
