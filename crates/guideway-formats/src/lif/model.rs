//! The records of LIF 1.0 and 2.0. Where the two name a thing differently, both names are here.

use std::borrow::Cow;

use serde::de::{IgnoredAny, MapAccess};

use crate::json::{Field, FromJson, Key, Scalar, record};
use crate::trajectory::Trajectory;

type Text<'a> = Cow<'a, str>;
type List<T> = Vec<Field<T>>;

/// The root object of a file.
#[derive(Debug, Default)]
pub(super) struct Root<'a> {
    pub(super) meta: Field<Meta<'a>>,
    /// Of 1.0.
    pub(super) layouts: Field<List<Layout<'a>>>,
    /// Of 2.0.
    pub(super) origins: Field<List<Origin<'a>>>,
    /// The first keys that are none of these: they tell what the file is if it is not LIF.
    pub(super) other_keys: Vec<String>,
    pub(super) repeated: Option<&'static str>,
}

impl<'a> FromJson<'a> for Root<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        const MOST_OTHER_KEYS: usize = 5;
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
                    if root.other_keys.len() < MOST_OTHER_KEYS {
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
    nodes: List<Node<'a>> = "nodes",
    edges: List<Edge<'a>> = "edges",
    stations: List<Station<'a>> = "stations",
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

/// What an edge is for one vehicle type (1.0) or several (2.0).
#[derive(Debug, Default)]
pub(super) struct EdgeProperties<'a> {
    pub(super) vehicle_type: Field<Text<'a>>,
    pub(super) robot_types: Field<List<RobotType<'a>>>,
    pub(super) trajectory: Field<Box<Trajectory>>,
    /// Everything else, under the format's own names.
    pub(super) attributes: Vec<(&'static str, Field<Scalar<'a>>)>,
    pub(super) repeated: Option<&'static str>,
}

/// The attributes of an edge that become columns. Others would let a file make columns without end.
const ATTRIBUTES: &[&str] = &[
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
];

/// Objects whose fields become columns too, each under both names.
const GROUPS: &[&str] = &["loadRestriction", "corridor", "physicalLineGuidedProperty"];

const GROUP_ATTRIBUTES: &[&str] = &[
    "loadRestriction.unloaded",
    "loadRestriction.loaded",
    "loadRestriction.loadSetNames",
    "corridor.maximumLeftWidth",
    "corridor.maximumRightWidth",
    "corridor.corridorReferencePoint",
    "physicalLineGuidedProperty.direction",
    "physicalLineGuidedProperty.length",
];

/// How the attributes begin that tell of a line on the floor, whose shape the file does not have.
pub(super) const PHYSICAL_LINE: &str = "physicalLineGuidedProperty.";

enum PropertyKey {
    VehicleType,
    RobotTypes,
    Trajectory,
    Attribute(&'static str),
    Group,
    Other,
}

impl PropertyKey {
    fn named(key: &str) -> Self {
        match key {
            "vehicleTypeId" => Self::VehicleType,
            "mobileRobotTypes" => Self::RobotTypes,
            "trajectory" => Self::Trajectory,
            _ if GROUPS.contains(&key) => Self::Group,
            _ => match ATTRIBUTES.iter().find(|&&a| a == key) {
                Some(attribute) => Self::Attribute(attribute),
                None => Self::Other,
            },
        }
    }
}

impl<'a> FromJson<'a> for EdgeProperties<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        let mut all = Self::default();
        let mut seen = [false; 3];
        let mut again = |i: usize| std::mem::replace(&mut seen[i], true);
        while let Some(key) = object.next_key_seed(Key(PropertyKey::named))? {
            match key {
                PropertyKey::VehicleType => {
                    all.vehicle_type = object.next_value()?;
                    all.repeated = again(0).then_some("vehicleTypeId").or(all.repeated);
                }
                PropertyKey::RobotTypes => {
                    all.robot_types = object.next_value()?;
                    all.repeated = again(1).then_some("mobileRobotTypes").or(all.repeated);
                }
                PropertyKey::Trajectory => {
                    all.trajectory = object.next_value()?;
                    all.repeated = again(2).then_some("trajectory").or(all.repeated);
                }
                PropertyKey::Attribute(name) => {
                    let value = object.next_value()?;
                    all.put(name, value);
                }
                PropertyKey::Group => {
                    if let Field::Value(Group(fields)) = object.next_value()? {
                        fields
                            .into_iter()
                            .for_each(|(name, value)| all.put(name, value));
                    }
                }
                PropertyKey::Other => {
                    object.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(Field::Value(all))
    }
}

impl<'a> EdgeProperties<'a> {
    fn put(&mut self, name: &'static str, value: Field<Scalar<'a>>) {
        match self.attributes.iter_mut().find(|(n, _)| *n == name) {
            Some((_, old)) => {
                *old = value;
                self.repeated = Some(name);
            }
            None => self.attributes.push((name, value)),
        }
    }
}

/// The fields of an object that become columns.
struct Group<'a>(Vec<(&'static str, Field<Scalar<'a>>)>);

impl<'a> FromJson<'a> for Group<'a> {
    fn from_object<A: MapAccess<'a>>(mut object: A) -> Result<Field<Self>, A::Error> {
        // The fields of the groups have different names, so the field alone tells the column.
        let named = |key: &str| {
            let whole = |a: &&&str| a.split_once('.').is_some_and(|(_, field)| field == key);
            GROUP_ATTRIBUTES.iter().find(whole).copied()
        };
        let mut fields: Vec<(&'static str, Field<Scalar<'a>>)> = Vec::new();
        while let Some(key) = object.next_key_seed(Key(named))? {
            match key {
                Some(name) if fields.iter().all(|(n, _)| *n != name) => {
                    fields.push((name, object.next_value()?));
                }
                _ => {
                    object.next_value::<IgnoredAny>()?;
                }
            }
        }
        Ok(Field::Value(Self(fields)))
    }
}
