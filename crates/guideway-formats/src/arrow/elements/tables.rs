//! Element tables: all elements other than paths, in the order in which they refer to each other.

use guideway_layout::{Diagnostics, Layout};

use super::element_rows::ElementRows;
use super::faults::Faults;
use super::groups::{self, BlockRows, ZoneRows};
use super::nodes::NodeRows;
use super::stations::StationRows;
use super::type_rows::TypeRows;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::element::Element;
use crate::arrow::level_column::Levels;
use crate::arrow::numbering::Numbering;
use crate::arrow::path_columns::PathColumns;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;

/// Elements other than paths under construction.
pub(in crate::arrow) struct ElementTables<'a> {
    reading: Reading<'a>,
    path_types: TypeRows<'a>,
    nodes: NodeRows<'a>,
    node_types: TypeRows<'a>,
    stations: StationRows<'a>,
    levels: ElementRows<'a>,
    vehicle_types: ElementRows<'a>,
    blocks: BlockRows<'a>,
    zones: ZoneRows<'a>,
    layout: ElementRows<'a>,
    refused: ElementRows<'a>,
}

impl<'a> ElementTables<'a> {
    pub(in crate::arrow) fn new(reading: Reading<'a>) -> Self {
        let rows = |kind, roles: &[Role]| ElementRows::new(kind, reading, roles);
        Self {
            reading,
            path_types: TypeRows::new(Element::PathType, reading),
            nodes: NodeRows::new(reading),
            node_types: TypeRows::new(Element::NodeType, reading),
            stations: StationRows::new(reading),
            levels: rows(Element::Level, &[Role::LevelName, Role::Elevation]),
            vehicle_types: rows(Element::VehicleType, &[]),
            blocks: BlockRows::new(reading),
            zones: ZoneRows::new(reading),
            layout: rows(Element::Layout, &[]),
            refused: rows(
                Element::RefusedPath,
                &[Role::RefusalCode, Role::RefusalDetail],
            ),
        }
    }

    /// Appends the rows of a kind, which are the drawn rows of `batch`.
    pub(in crate::arrow) fn add(&mut self, kind: Element, batch: &Batch) -> Result<(), Problem> {
        match kind {
            Element::Path => Ok(()),
            Element::PathType => self.path_types.add(batch),
            Element::Node => self.nodes.add(batch),
            Element::NodeType => self.node_types.add(batch),
            Element::Station => self.stations.add(batch),
            Element::Level => self.levels.add(batch),
            Element::VehicleType => self.vehicle_types.add(batch),
            Element::Block => self.blocks.add(batch),
            Element::Zone => self.zones.add(batch),
            Element::Layout => self.layout.add(batch),
            Element::RefusedPath => self.refused.add(batch),
        }
    }

    /// Counts nodes that are not read.
    pub(in crate::arrow) fn skip_nodes(&mut self, count: u32) {
        self.nodes.skip(count);
    }

    /// Returns a layout of all elements: the paths of `columns`, with the curves and the rows by
    /// their numbers that `assembled` has, and the elements of this.
    pub(in crate::arrow) fn into_layout(
        self,
        columns: PathColumns<'_>,
        assembled: (guideway_layout::Geometry, Numbering),
        diagnostics: &mut Diagnostics,
    ) -> Result<Layout, Problem> {
        let mut layout = Layout::default();
        let faults = &mut Faults {
            limits: self.reading.limits,
            diagnostics,
        };
        let (geometry, paths) = assembled;
        let mut levels = Levels::new(groups::levels(self.levels, faults)?);
        let (mut nodes, of_nodes) = self.nodes.finish(&mut levels, faults)?;
        self.node_types
            .finish(nodes.vehicle_types_mut(), &of_nodes, faults)?;
        layout.nodes = nodes;
        (layout.paths, layout.refused) =
            columns.finish(geometry, &mut levels, &of_nodes, faults.diagnostics)?;
        let entries = layout.paths.vehicle_types_mut();
        self.path_types.finish(entries, &paths, faults)?;
        layout.stations = self.stations.finish(&of_nodes, &mut levels, faults)?;
        layout.vehicle_types = groups::vehicle_types(self.vehicle_types, faults)?;
        let numberings = (&paths, &of_nodes, layout.stations.len());
        layout.blocks = self.blocks.finish(numberings, faults)?;
        layout.zones = self.zones.finish(&mut levels, faults)?;
        layout.attributes = groups::layout_attributes(self.layout, faults)?;
        groups::refused(self.refused, &mut layout.refused, faults)?;
        layout.levels = levels.into_vec();
        Ok(layout)
    }
}
