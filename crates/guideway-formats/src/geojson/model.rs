//! GeoJSON records: the members of a file that the layout holds.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use super::coordinates::Coordinates;
use super::properties::{Properties, Property};
use crate::json::{Field, FromJson, Key, record};

type Text<'a> = Cow<'a, str>;
pub(super) type List<T> = Vec<Field<T>>;

record! {
    /// The root object: a collection, one feature, or one geometry.
    Root<'a> {
        crs: Property<'a> = "crs",
        coord_ref_sys: Property<'a> = "coordRefSys",
        guideway: Box<Member<'a>> = "guideway",
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
    code: Property<'a> = "code",
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

record! {
    /// The member `guideway` of a collection: the parts of a layout that are no features.
    Member<'a> {
        format: Text<'a> = "format",
        version: f64 = "version",
        unit: Text<'a> = "unit",
        origin: Origin = "origin",
        columns: Columns<'a> = "columns",
        properties: Properties<'a> = "properties",
        levels: List<LevelRecord<'a>> = "levels",
        vehicle_types: List<TypeRecord<'a>> = "vehicleTypes",
        blocks: List<BlockRecord<'a>> = "blocks",
    }
}

record! { Origin {
    longitude: f64 = "longitude",
    latitude: f64 = "latitude",
} }

record! {
    /// Type and unit of columns, by table and name.
    Columns<'a> {
        paths: Properties<'a> = "paths",
        path_types: Properties<'a> = "pathTypes",
        nodes: Properties<'a> = "nodes",
        node_types: Properties<'a> = "nodeTypes",
        stations: Properties<'a> = "stations",
        levels: Properties<'a> = "levels",
        vehicle_types: Properties<'a> = "vehicleTypes",
        blocks: Properties<'a> = "blocks",
        zones: Properties<'a> = "zones",
        layout: Properties<'a> = "layout",
    }
}

record! { LevelRecord<'a> {
    id: Text<'a> = "id",
    name: Text<'a> = "name",
    elevation: f64 = "elevation",
    properties: Properties<'a> = "properties",
} }

record! { TypeRecord<'a> {
    id: Text<'a> = "id",
    properties: Properties<'a> = "properties",
} }

record! { BlockRecord<'a> {
    id: Text<'a> = "id",
    members: Property<'a> = "members",
    properties: Properties<'a> = "properties",
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
