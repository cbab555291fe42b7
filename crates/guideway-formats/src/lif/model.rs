//! LIF records: the objects of 1.0 and 2.0, under the names of both versions.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use super::members::{
    EDGE, EDGE_TYPE, LAYOUT, META, NODE, NODE_TYPE, ORIGIN, STATION, STATION_POSITION,
};
use crate::json::{Field, FromJson, Key, LazyArray, record};
use crate::trajectory::Trajectory;

/// Keys of the long arrays of a layout.
const ARRAYS: [&str; 3] = ["nodes", "edges", "stations"];

/// Returns `true` if the array below these keys is a long one.
pub(super) fn is_long_array(keys: &[&str]) -> bool {
    match keys {
        ["layouts", "[]", key] | ["origins", "[]", "layouts", "[]", key] => ARRAYS.contains(key),
        _ => false,
    }
}

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

record! {
    /// The root object of a file: `layouts` in 1.0, `origins` in 2.0.
    Root<'a> {
        meta: Meta<'a> = "metaInformation",
        layouts: List<Layout<'a>> = "layouts",
        origins: List<Origin<'a>> = "origins",
    } with &[]
}

record! { Meta<'a> {} with META }

record! {
    Origin<'a> {
        layouts: List<Layout<'a>> = "layouts",
    } with ORIGIN
}

record! {
    Layout<'a> {
        id: Text<'a> = "layoutId",
        name: Text<'a> = "layoutName",
        nodes: LazyArray<'a> = "nodes",
        edges: LazyArray<'a> = "edges",
        stations: LazyArray<'a> = "stations",
    } with LAYOUT
}

record! {
    Node<'a> {
        id: Text<'a> = "nodeId",
        position: Position<'a> = "nodePosition",
        types_1: List<NodeProperties<'a>> = "vehicleTypeNodeProperties",
        types_2: List<NodeProperties<'a>> = "mobileRobotTypeNodeProperties",
    } with NODE
}

record! {
    Position<'a> {
        x: f64 = "x",
        y: f64 = "y",
    } with &[]
}

record! {
    RobotType<'a> {
        manufacturer: Text<'a> = "manufacturer",
        series: Text<'a> = "seriesName",
    } with &[]
}

record! {
    Edge<'a> {
        id: Text<'a> = "edgeId",
        start: Text<'a> = "startNodeId",
        end: Text<'a> = "endNodeId",
        types_1: List<EdgeProperties<'a>> = "vehicleTypeEdgeProperties",
        types_2: List<EdgeProperties<'a>> = "mobileRobotTypeEdgeProperties",
    } with EDGE
}

record! {
    Station<'a> {
        id: Text<'a> = "stationId",
        nodes: List<Text<'a>> = "interactionNodeIds",
        position: StationPosition<'a> = "stationPosition",
    } with STATION
}

record! {
    StationPosition<'a> {
        x: f64 = "x",
        y: f64 = "y",
    } with STATION_POSITION
}

/// Keys of the properties of an edge per vehicle type, in 1.0 and 2.0.
pub(super) const EDGE_PROPERTIES: [&str; 2] =
    ["vehicleTypeEdgeProperties", "mobileRobotTypeEdgeProperties"];
/// Keys of the properties of a node per vehicle type, in 1.0 and 2.0.
pub(super) const NODE_PROPERTIES: [&str; 2] =
    ["vehicleTypeNodeProperties", "mobileRobotTypeNodeProperties"];

/// Placeholder for all vehicle types: LIF requires at least one name.
pub(super) const ANY_TYPE: &str = "any";

/// Composes the name of a vehicle type of 2.0; `None` if both parts are missing or empty.
pub(super) fn robot_name(manufacturer: Option<&str>, series: Option<&str>) -> Option<String> {
    let parts = [manufacturer, series].into_iter().flatten();
    let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    (!parts.is_empty()).then(|| parts.join(" "))
}

/// Prefix of the attributes of a physical guide line, whose shape a file does not contain.
pub(super) const PHYSICAL_LINE: &str = "physicalLineGuidedProperty.";

record! {
    /// Properties of a node for one vehicle type (1.0) or several (2.0).
    NodeProperties<'a> {
        vehicle_type: Text<'a> = "vehicleTypeId",
        robot_types: List<RobotType<'a>> = "mobileRobotTypes",
    } with NODE_TYPE
}

record! {
    /// Properties of an edge for one vehicle type (1.0) or several (2.0).
    EdgeProperties<'a> {
        vehicle_type: Text<'a> = "vehicleTypeId",
        robot_types: List<RobotType<'a>> = "mobileRobotTypes",
        trajectory: Box<Trajectory> = "trajectory",
    } with EDGE_TYPE
}
