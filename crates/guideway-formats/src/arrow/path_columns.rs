//! Path columns: collects all columns except the curves, batch by batch, on several threads.

use arrow_schema::Schema;
use guideway_layout::{Diagnostics, Geometry, Level, Limits, Paths, Refused};
use rayon::prelude::*;

use super::attribute_columns::AttributeColumn;
use super::batch::Batch;
use super::budget::Budget;
use super::path_ids::PathIds;
use super::schema::ColumnRoles;
use super::style_columns::StyleColumns;
use crate::Problem;

/// Identifiers, attributes and style of the paths under construction.
pub(super) struct PathColumns<'a> {
    ids: PathIds<'a>,
    attributes: Vec<AttributeColumn<'a>>,
    style: StyleColumns<'a>,
}

impl<'a> PathColumns<'a> {
    /// Makes the columns with capacity for an estimated number of rows.
    pub(super) fn new(
        schema: &'a Schema,
        columns: &ColumnRoles,
        rows: usize,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Self {
        let attributes = columns.attributes.iter();
        let attribute =
            |&index| AttributeColumn::new(index, schema.field(index), rows, limits, budget);
        Self {
            ids: PathIds::new(columns.id, rows, limits, budget),
            attributes: attributes.map(attribute).collect(),
            style: StyleColumns::new(columns, rows, budget),
        }
    }

    /// Appends the drawn rows of a batch.
    ///
    /// # Errors
    /// The problem of the first column that has one, independent of thread timing.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let (ids, (attributes, style)) = rayon::join(
            || self.ids.add(batch),
            || {
                rayon::join(
                    || -> Vec<Result<(), Problem>> {
                        let columns = self.attributes.par_iter_mut();
                        columns.map(|column| column.add(batch)).collect()
                    },
                    || self.style.add(batch),
                )
            },
        );
        ids?;
        attributes.into_iter().collect::<Result<(), Problem>>()?;
        style
    }

    /// Returns the paths with these curves, the refused paths, and the levels.
    pub(super) fn finish(
        self,
        geometry: Geometry,
        diagnostics: &mut Diagnostics,
    ) -> (Paths, Refused, Vec<Level>) {
        let attributes = self.attributes.into_iter();
        let attributes: Vec<_> = attributes.filter_map(|a| a.finish(diagnostics)).collect();
        let (ids, refused) = self.ids.finish(diagnostics);
        let mut paths = Paths::from_columns(ids, geometry);
        for attribute in attributes {
            paths.attributes.insert(attribute);
        }
        let levels = self.style.finish(&mut paths, diagnostics);
        (paths, refused, levels)
    }
}
