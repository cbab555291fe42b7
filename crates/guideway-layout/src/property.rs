//! Known properties: names, kinds and units of the columns that several formats share.

use crate::Quantity;

/// Kind of the values of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PropertyKind {
    /// Numbers of a quantity, in its SI unit.
    Number(Quantity),
    /// Whole numbers.
    Integer,
    /// Yes or no.
    Flag,
    /// Any text.
    Text,
    /// One of these texts.
    Choice(&'static [&'static str]),
    /// A JSON array of texts or numbers.
    List,
    /// A JSON value that the layout does not interpret.
    Json,
}

/// Table whose elements have a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Paths, for all or for single vehicle types.
    Path,
    /// Nodes, for all or for single vehicle types.
    Node,
    /// Stations.
    Station,
    /// Levels.
    Level,
    /// Vehicle types.
    VehicleType,
    /// Blocks.
    Block,
    /// Zones.
    Zone,
}

impl ElementKind {
    /// Name of one such element, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Path => "path",
            Self::Node => "node",
            Self::Station => "station",
            Self::Level => "level",
            Self::VehicleType => "vehicle type",
            Self::Block => "block",
            Self::Zone => "zone",
        }
    }
}

/// A property that has one name and unit in the layout, whatever its formats call it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Property {
    /// Name of the column: that of LIF 1.0 and VDA 5050 where they have one.
    pub name: &'static str,
    /// Kind of its values.
    pub kind: PropertyKind,
    /// Elements that have it.
    pub of: &'static [ElementKind],
    /// Meaning, in one sentence.
    pub meaning: &'static str,
}

impl Property {
    /// The property of this name, if it is known.
    pub fn named(name: &str) -> Option<&'static Self> {
        PROPERTIES.iter().find(|property| property.name == name)
    }

    /// Quantity of its numbers, if it has one.
    pub fn quantity(&self) -> Option<Quantity> {
        match self.kind {
            PropertyKind::Number(quantity) => Some(quantity),
            _ => None,
        }
    }
}

const fn property(
    name: &'static str,
    kind: PropertyKind,
    of: &'static [ElementKind],
    meaning: &'static str,
) -> Property {
    Property {
        name,
        kind,
        of,
        meaning,
    }
}

const PATH: &[ElementKind] = &[ElementKind::Path];
const NODE: &[ElementKind] = &[ElementKind::Node];
const STATION: &[ElementKind] = &[ElementKind::Station];
const NAMED: &[ElementKind] = &[ElementKind::Path, ElementKind::Node, ElementKind::Station];
const WITH_ACTIONS: &[ElementKind] = &[ElementKind::Path, ElementKind::Node];
const DRIVEN: &[ElementKind] = &[ElementKind::Path, ElementKind::VehicleType];

const LENGTH: PropertyKind = PropertyKind::Number(Quantity::Length);
const ANGLE: PropertyKind = PropertyKind::Number(Quantity::Angle);
const SPEED: PropertyKind = PropertyKind::Number(Quantity::Speed);
const ROTATION_SPEED: PropertyKind = PropertyKind::Number(Quantity::RotationSpeed);
const FLAG: PropertyKind = PropertyKind::Flag;
const TEXT: PropertyKind = PropertyKind::Text;
const LIST: PropertyKind = PropertyKind::List;
const JSON: PropertyKind = PropertyKind::Json;
const ROTATION: PropertyKind = PropertyKind::Choice(&["NONE", "CCW", "CW", "BOTH"]);
const ORIENTATION: PropertyKind = PropertyKind::Choice(&["GLOBAL", "TANGENTIAL"]);
const REFERENCE: PropertyKind = PropertyKind::Choice(&["KINEMATICCENTER", "CONTOUR"]);
const POINT_TYPE: PropertyKind = PropertyKind::Choice(&["HALT_POSITION", "PARK_POSITION"]);

/// All known properties.
pub const PROPERTIES: &[Property] = &[
    property("name", TEXT, NAMED, "Name for people."),
    property("description", TEXT, NAMED, "Remark for people."),
    property("mapId", TEXT, NODE, "Map that the position refers to."),
    property("layer", TEXT, NAMED, "Layer of the drawing."),
    property("maxSpeed", SPEED, DRIVEN, "Greatest permitted speed."),
    property(
        "maxReverseSpeed",
        SPEED,
        DRIVEN,
        "Greatest permitted speed against the direction, if it is not `maxSpeed`.",
    ),
    property(
        "maxRotationSpeed",
        ROTATION_SPEED,
        PATH,
        "Greatest permitted rotation speed.",
    ),
    property("length", LENGTH, PATH, "Length as driven."),
    property(
        "minHeight",
        LENGTH,
        PATH,
        "Least height of the load handling device.",
    ),
    property(
        "maxHeight",
        LENGTH,
        PATH,
        "Greatest height of vehicle and load.",
    ),
    property(
        "vehicleOrientation",
        ANGLE,
        PATH,
        "Orientation of the vehicle.",
    ),
    property(
        "vehicleOrientations",
        LIST,
        PATH,
        "Permitted orientations, in radians.",
    ),
    property(
        "orientationType",
        ORIENTATION,
        PATH,
        "Frame of the orientation.",
    ),
    property(
        "rotationAllowed",
        FLAG,
        PATH,
        "The vehicle may turn on the path.",
    ),
    property(
        "rotationAtStartNodeAllowed",
        ROTATION,
        PATH,
        "Permitted turns at the start.",
    ),
    property(
        "rotationAtEndNodeAllowed",
        ROTATION,
        PATH,
        "Permitted turns at the end.",
    ),
    property(
        "reachOrientationBeforeEntering",
        FLAG,
        PATH,
        "The vehicle turns before it enters.",
    ),
    property(
        "reentryAllowed",
        FLAG,
        PATH,
        "A vehicle that left the path may enter it again.",
    ),
    property(
        "loadRestriction.unloaded",
        FLAG,
        PATH,
        "Open to vehicles without load.",
    ),
    property(
        "loadRestriction.loaded",
        FLAG,
        PATH,
        "Open to vehicles with load.",
    ),
    property(
        "loadRestriction.loadSetNames",
        LIST,
        PATH,
        "Load sets that may pass.",
    ),
    property(
        "corridor.leftWidth",
        LENGTH,
        PATH,
        "Width left of the path that vehicles may use.",
    ),
    property(
        "corridor.rightWidth",
        LENGTH,
        PATH,
        "Width right of the path that vehicles may use.",
    ),
    property(
        "corridor.referencePoint",
        REFERENCE,
        PATH,
        "Part of the vehicle in the corridor.",
    ),
    property(
        "actions",
        JSON,
        WITH_ACTIONS,
        "Actions that a vehicle performs.",
    ),
    property(
        "requiredActions",
        JSON,
        WITH_ACTIONS,
        "Actions that a vehicle must perform.",
    ),
    property(
        "feasibleActions",
        JSON,
        WITH_ACTIONS,
        "Actions that a vehicle can perform.",
    ),
    property(
        "forbiddenActionTypes",
        LIST,
        WITH_ACTIONS,
        "Actions that are forbidden.",
    ),
    property(
        "released",
        FLAG,
        WITH_ACTIONS,
        "Part of the base of an order.",
    ),
    property(
        "sequenceId",
        PropertyKind::Integer,
        WITH_ACTIONS,
        "Place in an order.",
    ),
    property("locked", FLAG, PATH, "Closed to all vehicles."),
    property("type", POINT_TYPE, NODE, "Use of the node."),
    property(
        "theta",
        ANGLE,
        &[ElementKind::Node, ElementKind::Station],
        "Orientation there.",
    ),
    property(
        "allowedDeviationXY",
        LENGTH,
        NODE,
        "Radius in which a vehicle has arrived.",
    ),
    property(
        "allowedDeviationTheta",
        ANGLE,
        NODE,
        "Deviation of the orientation there.",
    ),
    property("kind", TEXT, STATION, "Use of the station."),
    property("height", LENGTH, STATION, "Height of the load transfer."),
];

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        let names: HashSet<&str> = PROPERTIES.iter().map(|p| p.name).collect();
        assert_eq!(names.len(), PROPERTIES.len());
        let speed = Property::named("maxSpeed").unwrap();
        assert_eq!(speed.quantity(), Some(Quantity::Speed));
        assert_eq!(Property::named("maximumSpeed"), None);
    }
}
