//! Attribute table: all attributes of the elements of one kind, batch by batch on several threads.

use guideway_layout::{Attribute, Attributes, Code, Diagnostics, Place};
use rayon::prelude::*;

use super::attribute_columns::AttributeColumn;
use super::batch::Batch;
use super::reading::Reading;
use crate::Problem;
use crate::text::printable;

/// Attributes of one kind of element under construction.
pub(super) struct AttributeTable<'a>(Vec<AttributeColumn<'a>>);

impl<'a> AttributeTable<'a> {
    /// Makes the columns with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Self {
        let columns = reading.columns.attributes.iter();
        let column = |&index| AttributeColumn::new(reading, index, rows);
        Self(columns.map(column).collect())
    }

    /// Appends the drawn rows of a batch.
    ///
    /// # Errors
    /// The problem of the first column that has one, independent of thread timing.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let columns = self.0.par_iter_mut();
        let results: Vec<_> = columns.map(|column| column.add(batch)).collect();
        results.into_iter().collect()
    }

    /// Returns the attributes that have values, or all if it `keeps_empty` ones.
    pub(super) fn finish(
        self,
        keeps_empty: bool,
        diagnostics: &mut Diagnostics,
    ) -> Result<Vec<Attribute>, Problem> {
        let columns = self.0.into_iter();
        let attributes = columns.map(|column| column.finish(keeps_empty, diagnostics));
        attributes.filter_map(Result::transpose).collect()
    }
}

/// Returns attributes by their names, and reports those of several columns.
pub(super) fn by_name(
    columns: impl IntoIterator<Item = Attribute>,
    diagnostics: &mut Diagnostics,
) -> Attributes {
    let mut attributes = Attributes::default();
    for attribute in columns {
        if attributes.get(&attribute.name).is_some() {
            diagnostics.push(
                Code::Attribute,
                || Place::element(format!("attribute {}", printable(&attribute.name))),
                || "two columns hold values of this attribute; the last one counts".into(),
                "Write the values of an attribute in one column",
            );
        }
        attributes.insert(attribute);
    }
    attributes
}
