//! Identifiers of the elements of one kind; the row number is the substitute for a missing one.

use arrow_array::ArrayRef;
use guideway_layout::{Code, Diagnostics, Place, TextColumn};

use super::batch::Batch;
use super::reading::Reading;
use super::schema::Role;
use super::text_array::TextArray;
use super::text_sink::TextSink;
use crate::Problem;

/// Identifiers under construction.
pub(super) struct IdColumn<'a> {
    index: Option<usize>,
    sink: TextSink<'a>,
    unnamed: u64,
}

impl<'a> IdColumn<'a> {
    /// Makes the column with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Self {
        Self {
            index: reading.columns.get(Role::Id),
            sink: TextSink::new(reading.limits, reading.budget, rows),
            unnamed: 0,
        }
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let texts = id_texts(self.index, &batch.columns);
        for rows in batch.drawn.iter().cloned() {
            let unnamed = |row| {
                self.unnamed += 1;
                batch.number(row)
            };
            self.sink.push_rows(texts.as_ref(), rows, unnamed)?;
        }
        Ok(())
    }

    /// Returns the identifiers. `elements` names them in a message.
    pub(super) fn finish(self, elements: &str, diagnostics: &mut Diagnostics) -> TextColumn {
        if self.unnamed > 0 {
            diagnostics.push(
                Code::Attribute,
                || Place::element("column id"),
                || {
                    format!(
                        "{} {elements} have no id; their row numbers are used",
                        self.unnamed
                    )
                },
                "Give every row an id, so that it stays identifiable after changes of the file",
            );
        }
        self.sink.into_column()
    }
}

/// Returns the identifiers of a batch, if the table has a column `index` of them.
pub(super) fn id_texts(index: Option<usize>, columns: &[ArrayRef]) -> Option<TextArray<'_>> {
    index.map(|id| TextArray::from_ids(&columns[id]))
}
