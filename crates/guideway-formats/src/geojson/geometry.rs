//! GeoJSON geometries: maps a geometry to nodes or to a path.

use guideway_layout::{Code, NewPath};
use guideway_spline::{Point, Runs, polyline_to_runs};

use super::coordinates::Coordinates;
use super::mapper::Mapper;
use super::model::Geometry;
use super::properties::{Properties, Property};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{field_place, items};

/// Type name, kind, and nesting depth of the positions of each geometry.
const KINDS: &[(&str, Kind, usize)] = &[
    ("Point", Kind::Points, 1),
    ("MultiPoint", Kind::Points, 2),
    ("LineString", Kind::Lines, 2),
    ("MultiLineString", Kind::Lines, 3),
    ("Polygon", Kind::Outlines, 3),
    ("MultiPolygon", Kind::Outlines, 4),
    ("GeometryCollection", Kind::Collection, 0),
];

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Points,
    Lines,
    /// Rings of areas, drawn as lines.
    Outlines,
    Collection,
}

impl Mapper<'_> {
    /// Maps a geometry, with nested ones, to nodes, paths or refused paths.
    pub(super) fn map_geometry(
        &mut self,
        id: &str,
        geometry: Option<&Geometry<'_>>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(geometry) = geometry else {
            return self.map_without_geometry(id, properties, at);
        };
        self.builder.check_repeated(geometry.repeated, at);
        let Some((name, kind, depth)) = self.kind(geometry, &|| field_place(at, "type"))? else {
            let detail = "the type of the geometry is missing or unknown";
            return self.builder.refuse(id, Code::UnknownValue, detail);
        };
        self.count(name);
        if kind == Kind::Collection {
            self.builder
                .check_array(&geometry.geometries, at, "geometries");
            for (i, inner) in items(&geometry.geometries) {
                let at_inner: PlaceFn<'_> = &|| field_place(at, &format!("geometries[{i}]"));
                let inner = self.builder.record(inner, at_inner);
                self.map_geometry(&format!("{id} [{}]", i + 1), inner, properties, at_inner)?;
            }
            return Ok(());
        }
        let at_list: PlaceFn<'_> = &|| field_place(at, "coordinates");
        self.builder
            .check_type(&geometry.coordinates, at_list, "an array");
        if geometry.coordinates.is_absent() {
            self.builder
                .report_missing(at_list, "an array of positions");
        }
        let coordinates = geometry.coordinates.get();
        if let Some(coordinates) = coordinates {
            self.check(coordinates, depth, at_list)?;
            if kind == Kind::Lines {
                self.line_vertices += coordinates.points.len() as u64;
            }
        }
        match kind {
            Kind::Points => self.map_points(id, coordinates, properties, at_list),
            _ => self.map_path(id, coordinates, properties, at_list),
        }
    }

    fn kind(
        &mut self,
        geometry: &Geometry<'_>,
        at: PlaceFn<'_>,
    ) -> Result<Option<(&'static str, Kind, usize)>, ReadError> {
        let Some(name) = self.builder.text(&geometry.kind, at)? else {
            if geometry.kind.is_absent() {
                self.builder.report_missing(at, "the type of the geometry");
            }
            return Ok(None);
        };
        let known = KINDS.iter().find(|(n, ..)| *n == name).copied();
        if known.is_none() {
            let message = || format!("unknown type of geometry `{name}`");
            let remedy = "Use one of the seven types of RFC 7946";
            self.builder.report(Code::UnknownValue, at, message, remedy);
        }
        Ok(known)
    }

    /// Maps an edge of a route graph to the straight line between its nodes, and refuses other
    /// features.
    fn map_without_geometry(
        &mut self,
        id: &str,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        if self.is_graph && properties.get("startid").is_some() {
            return self.map_path(id, None, properties, at);
        }
        let remedy = "Add a geometry, or remove the feature";
        let (code, detail) = (Code::MissingField, "a geometry is missing");
        self.builder.refuse_at(id, code, detail, at, remedy)
    }

    fn count(&mut self, kind: &str) {
        match self.counts.iter_mut().find(|(name, _)| name == kind) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((kind.to_owned(), 1)),
        }
    }

    fn check(
        &mut self,
        found: &Coordinates,
        depth: usize,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        self.builder.check_curve_points(found.points.len())?;
        self.heights += found.heights;
        if found.invalid > 0 {
            let message = || format!("{} values are not positions of two numbers", found.invalid);
            let remedy = "They are ignored; correct the application that wrote the file";
            self.builder.report(Code::WrongType, at, message, remedy);
        }
        if !found.points.is_empty() && found.depth != depth {
            let message = || {
                let nested = found.depth;
                format!("positions are nested {nested} deep; this type requires a depth of {depth}")
            };
            let remedy = "They are drawn; correct the type or the nesting";
            self.builder.report(Code::WrongType, at, message, remedy);
        }
        Ok(())
    }

    fn map_points(
        &mut self,
        id: &str,
        coordinates: Option<&Coordinates>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let points = coordinates.map_or(&[][..], |c| &c.points);
        for (i, &point) in points.iter().enumerate() {
            let position = self.unit.to_meters(point);
            if !self.builder.check_point(position, at) {
                continue;
            }
            let row = match points.len() {
                1 => self.builder.push_node(id, position, None)?,
                _ => self
                    .builder
                    .push_node(&format!("{id} [{}]", i + 1), position, None)?,
            };
            if self.is_graph {
                self.nodes.insert(&self.builder.layout.nodes, row);
            }
            self.set_properties(Table::Nodes, row as usize, properties, at)?;
        }
        if points.is_empty() {
            let message = || format!("`{id}` has no position");
            let remedy = "The feature is ignored; add a position";
            self.builder.report(Code::MissingField, at, message, remedy);
        }
        Ok(())
    }

    fn map_path(
        &mut self,
        id: &str,
        coordinates: Option<&Coordinates>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let start = self.node("startid", properties, at)?;
        let end = self.node("endid", properties, at)?;
        let mut runs = Runs::default();
        for line in coordinates.into_iter().flat_map(Coordinates::lines) {
            let meters: Vec<Point<f64>> = line.iter().map(|&p| self.unit.to_meters(p)).collect();
            let mut drawn = meters;
            drawn.retain(|&point| self.builder.check_point(point, at));
            if drawn.len() < 2 {
                let message = || format!("{} positions; a line needs 2", drawn.len());
                let remedy = "The line is not drawn; add positions";
                self.builder.report(Code::TooFewPoints, at, message, remedy);
            }
            polyline_to_runs(&drawn, &mut runs);
        }
        if runs.is_empty() {
            let (Some(from), Some(to)) = (start, end) else {
                let detail = "there is no line of two positions, and no start and end node";
                return self.builder.refuse(id, Code::TooFewPoints, detail);
            };
            let nodes = &self.builder.layout.nodes;
            runs.push_line(nodes.position_m(from), nodes.position_m(to));
        }
        let row = self.builder.push_path(&NewPath {
            id,
            runs: &runs,
            start_node: start,
            end_node: end,
            ..NewPath::default()
        })?;
        self.set_properties(Table::Paths, row, properties, at)
    }

    /// Returns the node of a route graph that a property refers to.
    fn node(
        &mut self,
        key: &str,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<Option<u32>, ReadError> {
        if !self.is_graph {
            return Ok(None);
        }
        let Some(value) = properties.get(key).and_then(Property::value) else {
            self.builder
                .report_missing(at, &format!("the property `{key}`"));
            return Ok(None);
        };
        let name = value.to_string();
        self.builder.check_text(&name)?;
        let row = self.nodes.get(&self.builder.layout.nodes, &name);
        if row.is_none() {
            self.builder.report_unknown_node(&name, key, at);
        }
        Ok(row)
    }
}
