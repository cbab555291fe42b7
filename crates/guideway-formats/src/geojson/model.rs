//! GeoJSON records: the members of a file that the model holds.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use super::coordinates::Coordinates;
use super::properties::{Properties, Property};
use crate::json::{Field, FromJson, Key, record};

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

record! {
    /// The root object: a collection, one feature, or one geometry.
    Root<'a> {
        crs: Box<Crs<'a>> = "crs",
        features: List<Feature<'a>> = "features",
        id: Property<'a> = "id",
        properties: Properties<'a> = "properties",
        geometry: Box<Geometry<'a>> = "geometry",
        kind: Text<'a> = "type",
        coordinates: Coordinates = "coordinates",
        geometries: List<Geometry<'a>> = "geometries",
    }
}

record! { Crs<'a> {
    properties: CrsProperties<'a> = "properties",
} }

record! { CrsProperties<'a> {
    name: Text<'a> = "name",
} }

record! { Feature<'a> {
    id: Property<'a> = "id",
    properties: Properties<'a> = "properties",
    geometry: Box<Geometry<'a>> = "geometry",
} }

record! { Geometry<'a> {
    kind: Text<'a> = "type",
    coordinates: Coordinates = "coordinates",
    geometries: List<Geometry<'a>> = "geometries",
} }

impl<'a> Root<'a> {
    /// Takes the features of a collection; a file of one feature or geometry has one.
    pub(super) fn take_features(&mut self) -> List<Feature<'a>> {
        if let Field::Value(features) = std::mem::take(&mut self.features) {
            return features;
        }
        let is_geometry = !self.coordinates.is_absent() || !self.geometries.is_absent();
        let geometry = match is_geometry {
            true => Field::Value(Box::new(Geometry {
                kind: std::mem::take(&mut self.kind),
                coordinates: std::mem::take(&mut self.coordinates),
                geometries: std::mem::take(&mut self.geometries),
                repeated: None,
                has_other: false,
            })),
            false => std::mem::take(&mut self.geometry),
        };
        vec![Field::Value(Feature {
            id: std::mem::take(&mut self.id),
            properties: std::mem::take(&mut self.properties),
            geometry,
            repeated: None,
            has_other: false,
        })]
    }
}
