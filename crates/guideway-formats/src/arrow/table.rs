use arrow_schema::Schema;
use guideway_layout::{Diagnostics, Geometry, Level, Limits, Paths, Refused};
use rayon::prelude::*;

use super::attributes::Growing;
use super::batch::Batch;
use super::budget::Budget;
use super::ids::Ids;
use super::look::Look;
use super::schema::Columns;
use crate::Problem;

/// All columns but the curves, made batch by batch.
pub(super) struct Table<'a> {
    ids: Ids<'a>,
    attributes: Vec<Growing<'a>>,
    look: Look<'a>,
}

impl<'a> Table<'a> {
    /// With room for about so many rows.
    pub(super) fn new(
        schema: &'a Schema,
        columns: &Columns,
        rows: usize,
        limits: &'a Limits,
        budget: &'a Budget,
    ) -> Self {
        let attributes = columns.attributes.iter();
        let attribute = |&index| Growing::new(index, schema.field(index), rows, limits, budget);
        Self {
            ids: Ids::new(columns.id, rows, limits, budget),
            attributes: attributes.map(attribute).collect(),
            look: Look::new(columns, rows, budget),
        }
    }

    /// Appends the rows of a batch. Of several problems the first column's is told, whichever thread finds one first.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let (ids, (attributes, look)) = rayon::join(
            || self.ids.add(batch),
            || {
                rayon::join(
                    || -> Vec<Result<(), Problem>> {
                        let columns = self.attributes.par_iter_mut();
                        columns.map(|column| column.add(batch)).collect()
                    },
                    || self.look.add(batch),
                )
            },
        );
        ids?;
        attributes.into_iter().collect::<Result<(), Problem>>()?;
        look
    }

    /// The paths with these curves, those that are refused, and the levels.
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
        let levels = self.look.finish(&mut paths, diagnostics);
        (paths, refused, levels)
    }
}
