//! LIF objects of nodes and edges, with the serialization of both versions.

use guideway_spline::Point;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

use super::model::{EDGE_PROPERTIES, NODE_PROPERTIES};
use super::version::Version;
use crate::clamped::{ClampedCurve, rounded};

/// A node as written.
pub(super) struct NodeObject<'a> {
    pub(super) id: &'a str,
    pub(super) name: Option<Value>,
    pub(super) map: Value,
    pub(super) position: Position,
    pub(super) properties: TypeProperties<'a>,
}

impl Serialize for NodeObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let version = self.properties.version;
        let mut members = serializer.serialize_map(None)?;
        members.serialize_entry("nodeId", self.id)?;
        if let Some(name) = &self.name {
            members.serialize_entry(version.pick("nodeName", "nodeDescriptor"), name)?;
        }
        members.serialize_entry("mapId", &self.map)?;
        members.serialize_entry("nodePosition", &self.position)?;
        members.serialize_entry(version.select(NODE_PROPERTIES), &self.properties)?;
        members.end()
    }
}

/// An edge as written.
pub(super) struct EdgeObject<'a> {
    pub(super) id: &'a str,
    /// Start and end node.
    pub(super) ends: [&'a str; 2],
    pub(super) properties: TypeProperties<'a>,
}

impl Serialize for EdgeObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let version = self.properties.version;
        let mut members = serializer.serialize_map(None)?;
        members.serialize_entry("edgeId", self.id)?;
        members.serialize_entry("startNodeId", self.ends[0])?;
        members.serialize_entry("endNodeId", self.ends[1])?;
        members.serialize_entry(version.select(EDGE_PROPERTIES), &self.properties)?;
        members.end()
    }
}

/// Properties of some vehicle types: one entry per type in 1.0, one for all in 2.0.
pub(super) struct TypeProperties<'a> {
    pub(super) version: Version,
    pub(super) types: Vec<&'a str>,
    pub(super) columns: Map<String, Value>,
    pub(super) trajectory: Option<Trajectory>,
}

impl Serialize for TypeProperties<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let entry = |vehicle_type, robot_types| Entry {
            vehicle_type,
            robot_types,
            columns: &self.columns,
            trajectory: self.trajectory.as_ref(),
        };
        match self.version {
            Version::V1 => {
                serializer.collect_seq(self.types.iter().map(|&name| entry(Some(name), None)))
            }
            Version::V2 => {
                let robots = self.types.iter().map(|name| RobotType::named(name));
                serializer.collect_seq([entry(None, Some(robots.collect()))])
            }
        }
    }
}

#[derive(Serialize)]
struct Entry<'a> {
    #[serde(rename = "vehicleTypeId", skip_serializing_if = "Option::is_none")]
    vehicle_type: Option<&'a str>,
    #[serde(rename = "mobileRobotTypes", skip_serializing_if = "Option::is_none")]
    robot_types: Option<Vec<RobotType<'a>>>,
    #[serde(flatten)]
    columns: &'a Map<String, Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    trajectory: Option<&'a Trajectory>,
}

#[derive(Serialize)]
struct RobotType<'a> {
    manufacturer: &'a str,
    #[serde(rename = "seriesName")]
    series: &'a str,
}

impl<'a> RobotType<'a> {
    fn named(name: &'a str) -> Self {
        let (manufacturer, series) = name.split_once(' ').unwrap_or(("", name));
        Self {
            manufacturer,
            series,
        }
    }
}

/// A position in meters.
#[derive(Serialize)]
pub(super) struct Position {
    x: f64,
    y: f64,
}

impl From<Point<f64>> for Position {
    fn from(position: Point<f64>) -> Self {
        Self {
            x: rounded(position.x),
            y: rounded(position.y),
        }
    }
}

/// A clamped B-spline as written.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Trajectory {
    degree: usize,
    knot_vector: Vec<f64>,
    control_points: Vec<Position>,
}

impl From<ClampedCurve> for Trajectory {
    /// Scales the knots to the range from 0 to 1.
    fn from(curve: ClampedCurve) -> Self {
        let last = curve.knots.last().copied().unwrap_or(1.0);
        Self {
            degree: curve.degree,
            knot_vector: curve.knots.iter().map(|knot| knot / last).collect(),
            control_points: curve.points.into_iter().map(Position::from).collect(),
        }
    }
}
