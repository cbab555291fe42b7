//! GeoJSON geometries: finds the kind of a geometry and checks its positions.

use guideway_layout::Code;

use super::coordinates::Coordinates;
use super::extension::Extension;
use super::feature_source::Source;
use super::mapper::Mapper;
use super::model::Geometry;
use crate::ReadError;
use crate::builder::PlaceFn;
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
        source: &Source<'_, '_>,
        geometry: Option<&Geometry<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let id = &source.id;
        let Some(geometry) = geometry else {
            return self.map_without_geometry(source, true, at);
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
                let part = Source {
                    id: format!("{id} [{}]", i + 1),
                    columns: source.columns.clone(),
                    properties: source.properties,
                    extension: Extension::default(),
                };
                self.map_geometry(&part, inner, at_inner)?;
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
            Kind::Points => self.map_points(source, coordinates, at_list),
            _ => self.map_path(source, coordinates, at_list),
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

    /// Maps an edge of a route graph to the straight line between its nodes. Reports other
    /// features: one without a place is legal, one with something else for a geometry is refused.
    pub(super) fn map_without_geometry(
        &mut self,
        source: &Source<'_, '_>,
        is_wrong: bool,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        if self.is_graph && source.properties.get("startid").is_some() {
            return self.map_path(source, None, at);
        }
        if is_wrong {
            let remedy = "Add a geometry, or remove the feature";
            let (code, detail) = (Code::MissingField, "a geometry is missing");
            let builder = &mut self.builder;
            return builder.refuse_at(&source.id, code, detail, at, remedy);
        }
        let message = || format!("`{}` has no geometry, so it has no place", source.id);
        let remedy = "It is left out; add a geometry if it has a place";
        self.builder.report(Code::NotDrawn, at, message, remedy);
        Ok(())
    }

    fn count(&mut self, kind: &str) {
        match self.counts.iter_mut().find(|(name, _)| name == kind) {
            Some((_, count)) => *count += 1,
            None => self.counts.push((kind.to_owned(), 1)),
        }
    }

    pub(super) fn check(
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
}
