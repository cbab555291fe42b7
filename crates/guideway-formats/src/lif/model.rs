//! LIF records: the fields of 1.0 and 2.0 that the model holds, under the names of both versions.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use crate::json::{Field, FromJson, Key, LazyArray, record};
use crate::trajectory::Trajectory;

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

/// The root object of a file.
#[derive(Debug, Default)]
pub(super) struct Root<'a> {
    pub(super) meta: Field<Meta<'a>>,
    /// LIF 1.0.
    pub(super) layouts: Field<List<Layout<'a>>>,
    /// LIF 2.0.
    pub(super) origins: Field<List<Origin<'a>>>,
    /// The first unknown keys, for the error of a file that is not LIF.
    pub(super) other_keys: Vec<String>,
    pub(super) repeated: Option<&'static str>,
}

impl<'a> FromJson<'a> for Root<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        const MAX_OTHER_KEYS: usize = 5;
        let mut root = Self::default();
        let mut seen = Vec::new();
        while let Some(key) = object.next_key::<Cow<'a, str>>()? {
            let known = match key.as_ref() {
                "metaInformation" => {
                    root.meta = object.next_value()?;
                    "metaInformation"
                }
                "layouts" => {
                    root.layouts = object.next_value()?;
                    "layouts"
                }
                "origins" => {
                    root.origins = object.next_value()?;
                    "origins"
                }
                other => {
                    if root.other_keys.len() < MAX_OTHER_KEYS {
                        root.other_keys.push(other.chars().take(40).collect());
                    }
                    object.next_value::<IgnoredAny>()?;
                    continue;
                }
            };
            if seen.contains(&known) {
                root.repeated = Some(known);
            }
            seen.push(known);
        }
        Ok(Field::Value(root))
    }
}

record! { Meta<'a> {
    lif_version: Text<'a> = "lifVersion",
} }

record! { Origin<'a> {
    layouts: List<Layout<'a>> = "layouts",
} }

record! { Layout<'a> {
    id: Text<'a> = "layoutId",
    name: Text<'a> = "layoutName",
    nodes: LazyArray<'a, Node<'a>> = "nodes",
    edges: LazyArray<'a, Edge<'a>> = "edges",
    stations: LazyArray<'a, Station<'a>> = "stations",
} }

record! { Node<'a> {
    id: Text<'a> = "nodeId",
    name: Text<'a> = "nodeName",
    map_id: Text<'a> = "mapId",
    position: Position = "nodePosition",
} }

record! { Position {
    x: f64 = "x",
    y: f64 = "y",
} }

record! { RobotType<'a> {
    manufacturer: Text<'a> = "manufacturer",
    series: Text<'a> = "seriesName",
} }

record! { Edge<'a> {
    id: Text<'a> = "edgeId",
    start: Text<'a> = "startNodeId",
    end: Text<'a> = "endNodeId",
    types_1: List<EdgeProperties<'a>> = "vehicleTypeEdgeProperties",
    types_2: List<EdgeProperties<'a>> = "mobileRobotTypeEdgeProperties",
} }

record! { Station<'a> {
    id: Text<'a> = "stationId",
    nodes: List<Text<'a>> = "interactionNodeIds",
    name: Text<'a> = "stationName",
    kind: Text<'a> = "stationType",
    height: f64 = "stationHeight",
    position: Position = "stationPosition",
} }

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
    /// Properties of an edge for one vehicle type (1.0) or several (2.0).
    EdgeProperties<'a> {
        vehicle_type: Text<'a> = "vehicleTypeId",
        robot_types: List<RobotType<'a>> = "mobileRobotTypes",
        trajectory: Box<Trajectory> = "trajectory",
    } with &[
        "vehicleOrientation",
        "orientationType",
        "rotationAllowed",
        "rotationAtStartNodeAllowed",
        "rotationAtEndNodeAllowed",
        "maxSpeed",
        "maxRotationSpeed",
        "minHeight",
        "maxHeight",
        "reentryAllowed",
        "actions",
        "reachOrientationBeforeEntering",
        "mobileRobotOrientations",
        "maximumSpeed",
        "maximumRotationSpeed",
        "minimumLoadHandlingDeviceHeight",
        "maximumMobileRobotHeight",
        "requiredActions",
        "feasibleActions",
        "forbiddenActionTypes",
        "loadRestriction.unloaded",
        "loadRestriction.loaded",
        "loadRestriction.loadSetNames",
        "corridor.maximumLeftWidth",
        "corridor.maximumRightWidth",
        "corridor.corridorReferencePoint",
        "physicalLineGuidedProperty.direction",
        "physicalLineGuidedProperty.length",
    ]
}
