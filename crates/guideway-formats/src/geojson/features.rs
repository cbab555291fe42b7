//! GeoJSON mapping: decides unit and kind of a file, and maps its features to elements.

use std::borrow::Cow;

use guideway_layout::{Code, Layout, Place};
use guideway_spline::Point;

use super::columns::Named;
use super::crs::System;
use super::extension::Extension;
use super::feature_source::Source;
use super::mapper::Mapper;
use super::model::{Crs, Feature, Geometry, Member, Root};
use super::names;
use super::properties::{Properties, Property};
use super::unit::{Statement, Unit};
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::json::{Field, field_place};

impl Mapper<'_> {
    /// Maps the root object to a layout; `starts` are the first bytes of its features.
    pub(super) fn map(
        mut self,
        mut root: Root<'_>,
        starts: &[usize],
        file_bytes: usize,
    ) -> Result<Layout, ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element("the root");
        self.builder.check_repeated(root.repeated, at_root);
        let crs = self.crs(&root)?;
        let features = root.take_features();
        // Other programs may use the same name for a member of their own.
        let member = std::mem::take(&mut root.guideway);
        let member = member.get();
        // A graph without edges does not show that it is one.
        let format = member.and_then(|member| member.format.get());
        let is_named_graph = format.is_some_and(|format| format == names::ROUTE_GRAPH);
        let member = member.filter(|member| !member.version.is_absent());
        let mut all = features.iter().filter_map(|f| f.get()?.properties.get());
        let mut has_edge = || all.any(|p| p.get("startid").is_some() && p.get("endid").is_some());
        self.is_graph = member.is_none() && (is_named_graph || has_edge());
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::GeoJson
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version = match (self.is_graph, &crs) {
            (true, _) => names::ROUTE_GRAPH,
            (false, Some(_)) => "2008",
            (false, None) => "RFC 7946",
        }
        .to_owned();
        self.choose_unit(crs.as_deref(), member.map(AsRef::as_ref), &features)?;
        if let Some(member) = member {
            self.column_limit = Self::column_limit(file_bytes, features.len());
            self.map_member(member)?;
        }
        // All nodes come first: an edge or a station may precede its nodes.
        for nodes in [true, false] {
            for (i, feature) in features.iter().enumerate() {
                if feature.get().is_some_and(is_node) == nodes {
                    self.builder.element_byte = starts.get(i).copied();
                    self.map_feature(feature, &|| Place::element(format!("features[{i}]")))?;
                }
            }
        }
        self.builder.element_byte = None;
        if let Some(member) = member {
            self.map_blocks(member)?;
        }
        Ok(self.finish(features.len()))
    }

    /// Returns the name or the code of the coordinate reference system: `coordRefSys` of JSON-FG,
    /// or `crs` of 2008, which some applications write as a text.
    fn crs(&mut self, root: &Root<'_>) -> Result<Option<String>, ReadError> {
        let at: PlaceFn<'_> = &|| Place::element("crs");
        let found = root.coord_ref_sys.get().or(root.crs.get()).copied();
        if let Some(name) = found.and_then(Property::text) {
            self.builder.check_text(&name)?;
            return Ok(Some(name.into_owned()));
        }
        let crs: Field<Crs<'_>> = found.and_then(Property::parse).unwrap_or_default();
        self.builder.check_type(&crs, at, "an object");
        let Some(properties) = crs.get().and_then(|crs| crs.properties.get()) else {
            return Ok(None);
        };
        if let Some(code) = properties.code.get().copied().and_then(Property::id) {
            // The draft of 2008 before the names: {"type": "EPSG", "properties": {"code": 4326}}.
            return Ok(Some(code));
        }
        let name = self.builder.text(&properties.name, at)?;
        Ok(name.map(str::to_owned))
    }

    fn choose_unit(
        &mut self,
        crs: Option<&str>,
        member: Option<&Member<'_>>,
        features: &[Field<Feature<'_>>],
    ) -> Result<(), ReadError> {
        if self.is_graph {
            if crs.is_some_and(|crs| matches!(System::of_name(crs), System::Degrees(_))) {
                let message = || {
                    "the `crs` states degrees, but the route server of Nav2 reads positions as \
                     meters of its map"
                        .to_owned()
                };
                let remedy = "Positions are read as meters; correct the `crs`, or project them";
                let at = || Place::element("crs");
                self.builder.report(Code::AssumedUnit, &at, message, remedy);
            }
            return Ok(());
        }
        if member.is_some_and(|member| !member.unit.is_absent()) {
            return Ok(());
        }
        let geometries = || features.iter().filter_map(|f| f.get()?.geometry.get());
        let positions = || geometries().flat_map(|geometry| positions(geometry));
        let mut properties = features.iter().filter_map(|f| f.get()?.properties.get());
        let statement = Statement {
            crs,
            is_plane: properties.any(|p| p.get(names::ELEMENT).is_some()),
        };
        let unit = Unit::detect(&mut self.builder, &statement, positions);
        self.set_unit(unit);
        Ok(())
    }

    fn map_feature(
        &mut self,
        feature: &Field<Feature<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(feature) = self.builder.record(feature, at) else {
            let detail = "the feature is not an object";
            return self.builder.refuse(&at().element, Code::WrongType, detail);
        };
        self.builder.check_repeated(feature.repeated, at);
        self.builder.check_type(
            &feature.properties,
            &|| field_place(at, "properties"),
            "an object",
        );
        let none = Properties::default();
        let properties = feature.properties.get().unwrap_or(&none);
        let (id, number) = self.id(feature, properties, at)?;
        let mut source = Source {
            columns: self.named(feature, properties, &id),
            id,
            properties,
            extension: Extension::default(),
        };
        if !self.is_graph {
            source.extension = Extension::read(&mut self.builder, properties, at);
        }
        let at_geometry: PlaceFn<'_> = &|| field_place(at, "geometry");
        self.builder
            .check_type(&feature.geometry, at_geometry, "an object");
        let geometry = feature.geometry.get().map(AsRef::as_ref);
        let layout = &self.builder.layout;
        let before = [layout.nodes.len(), layout.paths.len()];
        match source.extension.element.as_deref() {
            Some("station") => return self.map_station(&source, geometry, at_geometry),
            Some("zone") => return self.map_zone(&source, geometry, at_geometry),
            _ if geometry.is_none() => {
                let is_wrong = feature.geometry.wrong_type().is_some();
                self.map_without_geometry(&source, is_wrong, at_geometry)?;
            }
            _ => self.map_geometry(&source, geometry, at_geometry)?,
        }
        let layout = &self.builder.layout;
        let row = |before: usize, now: usize| (now > before).then_some(before as u32);
        let rows = [
            row(before[0], layout.nodes.len()),
            row(before[1], layout.paths.len()),
        ];
        if let (Some(number), Some(node)) = (number, rows[0]) {
            self.numbered.insert(number, node);
        }
        match is_node(feature) {
            true => self.rows.nodes.push(rows[0]),
            false => self.rows.paths.push(rows[1]),
        }
        Ok(())
    }

    /// Returns the identifier of a feature: its member `id` or the property `id`. Nav2 uses the
    /// property; a number that stands for another identifier is returned too.
    fn id(
        &self,
        feature: &Feature<'_>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(String, Option<String>), ReadError> {
        let member = feature.id.get().copied().and_then(Property::id);
        let property = properties.get("id").and_then(Property::id);
        let original = properties.get("metadata").filter(|_| self.is_graph);
        let original = original.and_then(|metadata| {
            let metadata: Field<Properties<'_>> = metadata.parse()?;
            let original = metadata.get()?.get(names::ORIGINAL_ID)?.text()?;
            Some(original.into_owned())
        });
        let id = match self.is_graph {
            true => property.or(member),
            false => member.or(property),
        };
        let (id, number) = match original {
            Some(original) => (Some(original), id),
            None => (id, None),
        };
        let id = id.unwrap_or_else(|| at().element);
        self.builder.check_text(&id)?;
        Ok((id, number))
    }

    /// Returns the properties of a feature that become columns. Metadata of a route graph are
    /// properties too.
    fn named<'f>(
        &self,
        feature: &Feature<'_>,
        properties: &'f Properties<'_>,
        id: &str,
    ) -> Vec<Named<'f>> {
        let is_id = |property: Property<'_>| {
            self.is_graph || feature.id.is_absent() || property.id().as_deref() == Some(id)
        };
        let is_end = |name: &str| self.is_graph && matches!(name, "startid" | "endid");
        let mut named = Vec::new();
        for (name, property) in properties.iter() {
            let is_modeled = name == "id" && is_id(property)
                || is_end(name)
                || !self.is_graph && Extension::has(name);
            if is_modeled {
                continue;
            }
            let is_metadata = self.is_graph && name == "metadata";
            let metadata = match is_metadata {
                true => property.parse::<Field<Properties<'f>>>(),
                false => None,
            };
            let Some(Field::Value(metadata)) = metadata else {
                named.push((Cow::Borrowed(name), property));
                continue;
            };
            let metadata = metadata.iter();
            let metadata = metadata.filter(|(name, _)| *name != names::ORIGINAL_ID);
            named.extend(metadata.map(|(name, value)| {
                let name = match properties.get(name) {
                    Some(_) => format!("metadata.{name}"),
                    None => name.to_owned(),
                };
                (Cow::Owned(name), value)
            }));
        }
        named
    }

    fn finish(mut self, features: usize) -> Layout {
        let heights = self.heights;
        if heights > 0 {
            let message = || format!("positions with a height: {heights}");
            let remedy = "The heights are ignored: the model is two-dimensional";
            let at = || Place::element("coordinates");
            self.builder.report(Code::Attribute, &at, message, remedy);
        }
        let mut counts = vec![("features".to_owned(), features as u64)];
        counts.append(&mut self.counts);
        counts.push(("lineVertices".to_owned(), self.line_vertices));
        self.builder.layout.provenance.counts = counts;
        self.into_layout()
    }
}

/// Returns whether a feature becomes nodes: it has points, and is no station.
fn is_node(feature: &Feature<'_>) -> bool {
    let kind = feature.geometry.get().and_then(|g| g.kind.get());
    let is_point = kind.is_some_and(|kind| matches!(kind.as_ref(), "Point" | "MultiPoint"));
    let element = || feature.properties.get()?.get(names::ELEMENT)?.text();
    is_point && element().is_none_or(|element| !matches!(element.as_ref(), "station" | "zone"))
}

/// Iterates over all positions of a geometry, in the unit of the file.
fn positions<'g>(geometry: &'g Geometry<'_>) -> Box<dyn Iterator<Item = Point<f64>> + 'g> {
    let outer = geometry.coordinates.get().into_iter();
    let outer = outer.flat_map(|c| c.points.iter().copied());
    let inner = geometry.geometries.get().into_iter().flatten();
    let inner = inner.filter_map(|g| g.get()).flat_map(positions);
    Box::new(outer.chain(inner))
}
