//! From the features of a file to a layout: nodes, paths and their columns.

use std::collections::HashSet;

use guideway_layout::{Code, Layout, Place};
use guideway_spline::Bounds;

use super::model::{Feature, Geometry, Root};
use super::properties::{Properties, Property};
use super::unit::Unit;
use crate::ReadError;
use crate::builder::{Builder, PlaceFn, Table};
use crate::json::{Field, within};
use crate::node_rows::NodeRows;
use crate::source::Source;

/// Most columns of one table; a file could else make columns without end.
const MOST_COLUMNS: usize = 64;

/// Fills a layout from the features of a file.
pub(super) struct Mapper<'a> {
    pub(super) builder: Builder<'a>,
    pub(super) unit: Unit,
    /// Whether it is a route graph of Nav2, and the nodes of it.
    pub(super) is_graph: bool,
    pub(super) nodes: NodeRows,
    /// How many geometries there are of each type, and how many positions in lines.
    pub(super) counts: Vec<(String, u64)>,
    pub(super) line_vertices: u64,
    pub(super) heights: u64,
    columns: [HashSet<String>; 2],
}

impl<'a> Mapper<'a> {
    pub(super) fn new(source: Source<'a>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            unit: Unit::Meters,
            is_graph: false,
            nodes: NodeRows::default(),
            counts: Vec::new(),
            line_vertices: 0,
            heights: 0,
            columns: [HashSet::new(), HashSet::new()],
        }
    }

    pub(super) fn map(mut self, mut root: Root<'_>) -> Result<Layout, ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        let crs = self.crs(&root)?;
        let features = root.take_features();
        self.is_graph = features
            .iter()
            .filter_map(|f| f.get()?.properties.get())
            .any(|p| p.get("startid").is_some() && p.get("endid").is_some());
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::GeoJson
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version = match (self.is_graph, &crs) {
            (true, _) => "Nav2 route graph",
            (false, Some(_)) => "2008",
            (false, None) => "RFC 7946",
        }
        .to_owned();
        if !self.is_graph {
            let geometries = features.iter().filter_map(|f| f.get()?.geometry.get());
            let boxes = geometries.filter_map(|geometry| bounds(geometry));
            let bounds = boxes.reduce(Bounds::union);
            self.unit = Unit::of(&mut self.builder, crs.as_deref(), bounds);
        }
        // All nodes come first, for an edge may come before its nodes.
        for points in [true, false] {
            for (i, feature) in features.iter().enumerate() {
                let is_point = feature.get().is_some_and(is_point);
                if is_point == points {
                    self.map_feature(feature, &|| Place::element(format!("features[{i}]")))?;
                }
            }
        }
        Ok(self.finish(features.len()))
    }

    fn crs(&mut self, root: &Root<'_>) -> Result<Option<String>, ReadError> {
        let at: PlaceFn<'_> = &|| Place::element("crs");
        self.builder.check_type(&root.crs, at, "an object");
        let properties = root.crs.get().and_then(|crs| crs.properties.get());
        let Some(properties) = properties else {
            return Ok(None);
        };
        let name = self.builder.text(&properties.name, at)?;
        Ok(name.map(str::to_owned))
    }

    fn map_feature(
        &mut self,
        feature: &Field<Feature<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(feature) = self.builder.record(feature, at) else {
            let detail = "this is not an object, so there is nothing to draw";
            return self.builder.refuse(&at().element, Code::WrongType, detail);
        };
        self.builder.check_repeated(feature.repeated, at);
        self.builder.check_type(
            &feature.properties,
            &|| within(at, "properties"),
            "an object",
        );
        let none = Properties::default();
        let properties = feature.properties.get().unwrap_or(&none);
        let id = self.id(feature, properties, at)?;
        let at_geometry: PlaceFn<'_> = &|| within(at, "geometry");
        self.builder
            .check_type(&feature.geometry, at_geometry, "an object");
        let geometry = feature.geometry.get().map(AsRef::as_ref);
        self.map_geometry(&id, geometry, properties, at_geometry)
    }

    /// The identifier of a feature: its own, or the one among its properties, which is that of Nav2.
    fn id(
        &self,
        feature: &Feature<'_>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<String, ReadError> {
        let own = feature.id.get();
        let property = properties.get("id");
        let id = match self.is_graph {
            true => property.or(own),
            false => own.or(property),
        };
        match id.and_then(Property::value) {
            Some(value) => {
                let id = value.to_string();
                self.builder.check_text(&id)?;
                Ok(id)
            }
            None => Ok(at().element),
        }
    }

    /// Sets a column for each property that has no other place in the layout.
    pub(super) fn set_properties(
        &mut self,
        table: Table,
        row: usize,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let mut left_out = properties.left_out;
        for (name, property) in properties.iter() {
            let kept_elsewhere =
                name == "id" || self.is_graph && matches!(name, "startid" | "endid");
            let Some(value) = property.value().filter(|_| !kept_elsewhere) else {
                continue;
            };
            let columns = &mut self.columns[usize::from(matches!(table, Table::Nodes))];
            if !columns.contains(name) {
                if columns.len() == MOST_COLUMNS {
                    left_out += 1;
                    continue;
                }
                columns.insert(name.to_owned());
            }
            if let Property::Text(text) = property {
                self.builder.check_text(text)?;
            }
            self.builder.set(table, row, name, value)?;
        }
        if left_out > 0 {
            let message = || {
                format!("{left_out} properties are too many, or have too long a name, for columns")
            };
            let remedy = "They are left out; nothing else changes by that";
            self.builder.report(Code::Attribute, at, message, remedy);
        }
        Ok(())
    }

    fn finish(mut self, features: usize) -> Layout {
        let heights = self.heights;
        if heights > 0 {
            let message = || format!("positions with a height: {heights}");
            let remedy = "The heights are left out: the picture is flat";
            let at = || Place::element("coordinates");
            self.builder.report(Code::Attribute, &at, message, remedy);
        }
        let mut counts = vec![("features".to_owned(), features as u64)];
        counts.append(&mut self.counts);
        counts.push(("lineVertices".to_owned(), self.line_vertices));
        self.builder.layout.provenance.counts = counts;
        self.builder.layout
    }
}

fn is_point(feature: &Feature<'_>) -> bool {
    let kind = feature.geometry.get().and_then(|g| g.kind.get());
    kind.is_some_and(|kind| matches!(kind.as_ref(), "Point" | "MultiPoint"))
}

/// The box of all positions, in the file's unit.
fn bounds(geometry: &Geometry<'_>) -> Option<Bounds<f64>> {
    let own = geometry.coordinates.get();
    let own = own.and_then(|c| Bounds::of_points(c.points.iter().copied()));
    let inner = geometry.geometries.get().into_iter().flatten();
    let inner = inner.filter_map(|g| bounds(g.get()?));
    own.into_iter().chain(inner).reduce(Bounds::union)
}
