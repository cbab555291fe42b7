//! GeoJSON mapping: decides unit and kind of a file, and maps its features to nodes and paths.

use guideway_layout::{Code, Layout, Place};
use guideway_spline::Bounds;

use super::mapper::Mapper;
use super::model::{Feature, Geometry, Root};
use super::properties::{Properties, Property};
use super::unit::Unit;
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::json::{Field, field_place};

impl Mapper<'_> {
    /// Maps the root object to a layout.
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
            self.unit = Unit::detect(&mut self.builder, crs.as_deref(), bounds);
        }
        // All nodes come first: an edge may precede its nodes.
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
        let id = self.id(feature, properties, at)?;
        let at_geometry: PlaceFn<'_> = &|| field_place(at, "geometry");
        self.builder
            .check_type(&feature.geometry, at_geometry, "an object");
        let geometry = feature.geometry.get().map(AsRef::as_ref);
        self.map_geometry(&id, geometry, properties, at_geometry)
    }

    /// Returns the identifier of a feature: its member `id` or the property `id`. Nav2 uses the
    /// property.
    fn id(
        &self,
        feature: &Feature<'_>,
        properties: &Properties<'_>,
        at: PlaceFn<'_>,
    ) -> Result<String, ReadError> {
        let member = feature.id.get();
        let property = properties.get("id");
        let id = match self.is_graph {
            true => property.or(member),
            false => member.or(property),
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
        self.builder.layout
    }
}

fn is_point(feature: &Feature<'_>) -> bool {
    let kind = feature.geometry.get().and_then(|g| g.kind.get());
    kind.is_some_and(|kind| matches!(kind.as_ref(), "Point" | "MultiPoint"))
}

/// Returns the bounding box of all positions, in the unit of the file.
fn bounds(geometry: &Geometry<'_>) -> Option<Bounds<f64>> {
    let coordinates = geometry.coordinates.get();
    let outer = coordinates.and_then(|c| Bounds::of_points(c.points.iter().copied()));
    let inner = geometry.geometries.get().into_iter().flatten();
    let inner = inner.filter_map(|g| bounds(g.get()?));
    outer.into_iter().chain(inner).reduce(Bounds::union)
}
