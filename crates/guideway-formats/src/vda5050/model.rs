//! VDA 5050 records: the fields of an order, 1.1 to 3.1, under the names of all versions.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use crate::json::{Field, FromJson, Key, record};
use crate::trajectory::Trajectory;

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

record! { Root<'a> {
    version: Text<'a> = "version",
    nodes: List<Node<'a>> = "nodes",
    edges: List<Edge<'a>> = "edges",
} }

record! {
    Node<'a> {
        id: Text<'a> = "nodeId",
        sequence: f64 = "sequenceId",
        position: Box<Position<'a>> = "nodePosition",
    } with &["released", "nodeDescription", "nodeDescriptor", "actions"]
}

record! {
    Position<'a> {
        x: f64 = "x",
        y: f64 = "y",
        map_id: Text<'a> = "mapId",
    } with &[
        "theta",
        "allowedDeviationXY",
        "allowedDeviationTheta",
        "mapDescription",
        "mapDescriptor",
    ]
}

record! {
    Edge<'a> {
        id: Text<'a> = "edgeId",
        sequence: f64 = "sequenceId",
        start: Text<'a> = "startNodeId",
        end: Text<'a> = "endNodeId",
        trajectory: Box<Trajectory> = "trajectory",
    } with &[
        "released",
        "edgeDescription",
        "edgeDescriptor",
        "maxSpeed",
        "maximumSpeed",
        "maxHeight",
        "maximumHeight",
        "maximumMobileRobotHeight",
        "minHeight",
        "minimumHeight",
        "minimumLoadHandlingDeviceHeight",
        "orientation",
        "orientationType",
        "direction",
        "rotationAllowed",
        "reachOrientationBeforeEntering",
        "maxRotationSpeed",
        "maximumRotationSpeed",
        "length",
        // Spelling of the text of 1.1.
        "lenght",
        "actions",
        "corridor.leftWidth",
        "corridor.rightWidth",
        "corridor.corridorRefPoint",
        "corridor.corridorReferencePoint",
        "corridor.releaseRequired",
        "corridor.releaseLossBehavior",
    ]
}
