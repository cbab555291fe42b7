//! GeoJSON elements: maps positions to nodes, paths, stations and zones.

use guideway_layout::{Code, Direction, NewPath, OwnStyle, Zone};
use guideway_spline::{Point, Runs, polyline_to_runs};

use super::columns::Named;
use super::coordinates::Coordinates;
use super::curve_check::is_along;
use super::declared::{NODE_TYPES, NODES, Owner, PATH_TYPES, PATHS, STATIONS};
use super::extension::Reference;
use super::feature_source::Source;
use super::mapper::Mapper;
use super::model::Geometry;
use super::properties::Property;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::field_place;

impl Mapper<'_> {
    /// Maps points to nodes.
    pub(super) fn map_points(
        &mut self,
        source: &Source<'_, '_>,
        coordinates: Option<&Coordinates>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let (id, extension) = (&source.id, &source.extension);
        let level = self.level(extension.level.as_ref())?;
        let points = coordinates.map_or(&[][..], |c| &c.points);
        for (i, &point) in points.iter().enumerate() {
            let position = self.unit.to_meters(point);
            if !self.builder.check_point(position, at) {
                continue;
            }
            let types: Vec<&str> = extension.vehicle_types.iter().map(String::as_str).collect();
            let numbered = format!("{id} [{}]", i + 1);
            let id = if points.len() == 1 { id } else { &numbered };
            let row = self
                .builder
                .push_node_for_types(id, position, level, &types)?;
            self.nodes.insert(&self.builder.layout.nodes, row);
            self.set_columns(NODES, row as usize, source.columns.clone(), at)?;
            let entries = self.builder.layout.nodes.vehicle_types();
            let first = entries.entries(row as usize).start;
            self.set_type_columns(NODE_TYPES, first, source, at)?;
        }
        if points.is_empty() {
            let message = || format!("`{id}` has no position");
            let remedy = "The feature is ignored; add a position";
            self.builder.report(Code::MissingField, at, message, remedy);
        }
        Ok(())
    }

    /// Maps lines to a path; without a line, the straight line between the nodes of an edge.
    pub(super) fn map_path(
        &mut self,
        source: &Source<'_, '_>,
        coordinates: Option<&Coordinates>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let (id, extension) = (&source.id, &source.extension);
        let [start, end] = self.ends(source, at)?;
        let mut runs = Runs::default();
        let mut lines = Vec::new();
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
            lines.append(&mut drawn);
        }
        if runs.is_empty() {
            let (Some(from), Some(to)) = (start, end) else {
                let detail = "there is no line of two positions, and no start and end node";
                return self.builder.refuse(id, Code::TooFewPoints, detail);
            };
            let nodes = &self.builder.layout.nodes;
            runs.push_line(nodes.position_m(from), nodes.position_m(to));
        }
        let curve = self.curve(source, &lines, at)?;
        let level = self.level(extension.level.as_ref())?;
        let types: Vec<&str> = extension.vehicle_types.iter().map(String::as_str).collect();
        let row = self.builder.push_path(&NewPath {
            id,
            runs: curve.unwrap_or(&runs),
            start_node: start,
            end_node: end,
            direction: match extension.is_two_way {
                true => Direction::Both,
                false => Direction::Forward,
            },
            level,
            vehicle_types: &types,
        })?;
        let paths = &mut self.builder.layout.paths;
        if let (Some(_), Some(nurbs)) = (curve, &extension.nurbs) {
            paths.set_written_curve(row, nurbs.clone());
        }
        if extension.width_m.is_some() || extension.color_rgba.is_some() {
            let style = OwnStyle {
                width_m: extension.width_m,
                color_rgba: extension.color_rgba,
            };
            paths.set_own_style(row, style);
        }
        self.ranks.push(extension.rank.unwrap_or(0));
        let first = paths.vehicle_types().entries(row).start;
        self.set_columns(PATHS, row, source.columns.clone(), at)?;
        self.set_type_columns(PATH_TYPES, first, source, at)
    }

    /// Returns the exact curve of a path, if its line is still that of the curve.
    fn curve<'s>(
        &mut self,
        source: &'s Source<'_, '_>,
        line: &[Point<f64>],
        at: PlaceFn<'_>,
    ) -> Result<Option<&'s Runs>, ReadError> {
        let Some(curve) = &source.extension.curve else {
            return Ok(None);
        };
        self.builder.check_curve_points(curve.points().len())?;
        let is_sound = self.builder.within_coordinate_limit(curve);
        if is_sound && is_along(line, curve) {
            return Ok(Some(curve));
        }
        let message = || "the line does not lie along `guideway:curve`".to_owned();
        let remedy = "The line was edited, so it is drawn; remove the property";
        self.builder.report(Code::Attribute, at, message, remedy);
        Ok(None)
    }

    /// Returns the nodes of a path.
    fn ends(
        &mut self,
        source: &Source<'_, '_>,
        at: PlaceFn<'_>,
    ) -> Result<[Option<u32>; 2], ReadError> {
        if !self.is_graph {
            let extension = &source.extension;
            let start = self.node(extension.start.as_ref(), "guideway:start", at);
            let end = self.node(extension.end.as_ref(), "guideway:end", at);
            return Ok([start, end]);
        }
        let mut ends = [None; 2];
        for (end, key) in ends.iter_mut().zip(["startid", "endid"]) {
            let Some(name) = source.properties.get(key).and_then(Property::id) else {
                let expected = format!("the property `{key}`");
                self.builder.report_missing(at, &expected);
                continue;
            };
            self.builder.check_text(&name)?;
            *end = self.node(Some(&Reference::Id(name)), key, at);
        }
        Ok(ends)
    }

    /// Sets the columns of the vehicle types of an element, from its entry `first` on.
    fn set_type_columns(
        &mut self,
        table: (Owner, Table),
        first: usize,
        source: &Source<'_, '_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let extension = &source.extension;
        let types = extension.type_properties.iter();
        for (i, properties) in types.take(extension.vehicle_types.len()).enumerate() {
            if let Some(properties) = properties.get() {
                let named = properties.iter().map(|(name, value)| (name.into(), value));
                self.set_columns(table, first + i, named.collect::<Vec<Named<'_>>>(), at)?;
            }
        }
        Ok(())
    }

    /// Maps a feature to a station, with or without a position.
    pub(super) fn map_station(
        &mut self,
        source: &Source<'_, '_>,
        geometry: Option<&Geometry<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let extension = &source.extension;
        let point = geometry.and_then(|geometry| geometry.coordinates.get());
        let point = point.and_then(|coordinates| coordinates.points.first());
        let position_m = point.map(|&point| self.unit.to_meters(point));
        let position_m = position_m.filter(|&point| self.builder.check_point(point, at));
        let level = self.level(extension.level.as_ref())?;
        let nodes = extension.nodes.iter();
        let nodes = nodes.filter_map(|node| self.node(Some(node), "guideway:nodes", at));
        let nodes: Vec<u32> = nodes.collect();
        let row = self
            .builder
            .push_station(&source.id, position_m, nodes, level)?;
        self.rows.stations.push(Some(row));
        self.set_columns(STATIONS, row as usize, source.columns.clone(), at)
    }

    /// Maps a polygon to a zone.
    pub(super) fn map_zone(
        &mut self,
        source: &Source<'_, '_>,
        geometry: Option<&Geometry<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let coordinates = geometry.and_then(|geometry| geometry.coordinates.get());
        if let Some(coordinates) = coordinates {
            self.check(coordinates, 3, &|| field_place(at, "coordinates"))?;
        }
        let mut rings = coordinates.into_iter().flat_map(Coordinates::lines);
        let ring = rings.next().unwrap_or_default();
        // The last position of a ring repeats the first one.
        let corners = match ring {
            [first, inner @ .., last] if first == last => &ring[..=inner.len()],
            ring => ring,
        };
        let corners = corners.iter().map(|&corner| self.unit.to_meters(corner));
        let mut outline_m: Vec<Point<f64>> = corners.collect();
        outline_m.retain(|&corner| self.builder.check_point(corner, at));
        if rings.next().is_some() {
            let message = || format!("the zone `{}` has holes or several parts", source.id);
            let remedy = "Only the first outline is read; write a zone for each part";
            self.builder.report(Code::Attribute, at, message, remedy);
        }
        let level = self.level(source.extension.level.as_ref())?;
        let attributes = self.single_row(Owner::Zones, source.columns.clone(), at)?;
        self.builder.check_text(&source.id)?;
        self.builder.layout.zones.push(Zone {
            id: source.id.clone(),
            outline_m,
            level,
            attributes,
        });
        Ok(())
    }
}
