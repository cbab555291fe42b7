//! Path columns: collects all columns except the curves, batch by batch, on several threads.

use guideway_layout::{Diagnostics, Geometry, Paths, Refused};

use super::attribute_table::{AttributeTable, by_name};
use super::batch::Batch;
use super::column_names::PATHS_VERSION;
use super::level_column::{LevelColumn, Levels};
use super::network_columns::NetworkColumns;
use super::numbering::Numbering;
use super::path_ids::PathIds;
use super::reading::Reading;
use super::style_columns::StyleColumns;
use crate::Problem;

/// Identifiers, attributes, style and network of the paths under construction.
pub(super) struct PathColumns<'a> {
    version: u32,
    ids: PathIds<'a>,
    attributes: AttributeTable<'a>,
    levels: Option<LevelColumn<'a>>,
    style: StyleColumns,
    network: NetworkColumns<'a>,
}

impl<'a> PathColumns<'a> {
    /// Makes the columns with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Self {
        Self {
            version: reading.columns.version,
            ids: PathIds::new(reading, rows),
            attributes: AttributeTable::new(reading, rows),
            levels: LevelColumn::new(reading, rows),
            style: StyleColumns::new(reading.columns, rows),
            network: NetworkColumns::new(reading, rows),
        }
    }

    /// Appends the drawn rows of a batch.
    ///
    /// # Errors
    /// The problem of the first column that has one, independent of thread timing.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let (ids, attributes) = (&mut self.ids, &mut self.attributes);
        let (levels, style, network) = (&mut self.levels, &mut self.style, &mut self.network);
        let mut add_style = || {
            if let Some(levels) = levels {
                levels.add(batch)?;
            }
            style.add(batch)
        };
        let ((ids, attributes), (style, network)) = rayon::join(
            || rayon::join(|| ids.add(batch), || attributes.add(batch)),
            || rayon::join(&mut add_style, || network.add(batch)),
        );
        ids.and(attributes).and(style).and(network)
    }

    /// Returns the paths with these curves, and the refused paths.
    pub(super) fn finish(
        self,
        geometry: Geometry,
        levels: &mut Levels,
        nodes: &Numbering,
        diagnostics: &mut Diagnostics,
    ) -> Result<(Paths, Refused), Problem> {
        let keeps_empty = self.version == PATHS_VERSION;
        let attributes = self.attributes.finish(keeps_empty, diagnostics)?;
        let (ids, refused) = self.ids.finish(diagnostics);
        let mut paths = Paths::from_columns(ids, geometry);
        paths.attributes = by_name(attributes, diagnostics);
        if let Some(column) = self.levels {
            paths.set_levels(column.finish(levels, "paths", diagnostics));
        }
        self.style.finish(&mut paths, diagnostics);
        self.network.finish(&mut paths, nodes, diagnostics);
        Ok((paths, refused))
    }
}
