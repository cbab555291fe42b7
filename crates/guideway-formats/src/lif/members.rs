//! Members of LIF objects, and the columns of the layout that hold them.
//!
//! A member that several formats share is in the table of fields; the others have columns under
//! their own names.

use guideway_layout::{Property, Quantity};

use super::version::Version;
use crate::fields::{Vocabulary, field};
use crate::json::CellKind;

/// Column of the members of an object that LIF does not define: a JSON object.
pub(super) const OTHER: &str = "other";
/// Column of the members of a property of a vehicle type that LIF does not define.
pub(super) const TYPE_OTHER: &str = "vehicleTypeOther";
/// Column of the members of the origin of a level that LIF does not define.
pub(super) const ORIGIN_OTHER: &str = "originOther";
/// Column of the identifier of an edge whose vehicle types have different curves, so that it is
/// several paths.
pub(super) const EDGE_ID: &str = "edgeId";

/// Members of a node.
pub(super) const NODE: &[&str] = &["nodeName", "nodeDescription", "nodeDescriptor", "mapId"];

/// Members of a node for a vehicle type.
pub(super) const NODE_TYPE: &[&str] = &[
    "theta",
    "allowedDeviationXY",
    "loadRestriction.unloaded",
    "loadRestriction.loaded",
    "loadRestriction.loadSetNames",
    "actions",
    "requiredActions",
    "feasibleActions",
    "forbiddenActionTypes",
];

/// Members of an edge.
pub(super) const EDGE: &[&str] = &["edgeName", "edgeDescription", "edgeDescriptor"];

/// Members of an edge for a vehicle type, in the order of the format.
pub(super) const EDGE_TYPE: &[&str] = &[
    "vehicleOrientation",
    "orientationType",
    "rotationAllowed",
    "reachOrientationBeforeEntering",
    "mobileRobotOrientations",
    "rotationAtStartNodeAllowed",
    "rotationAtEndNodeAllowed",
    "maxSpeed",
    "maxRotationSpeed",
    "minHeight",
    "maxHeight",
    "maximumSpeed",
    "maximumRotationSpeed",
    "minimumLoadHandlingDeviceHeight",
    "maximumMobileRobotHeight",
    "loadRestriction.unloaded",
    "loadRestriction.loaded",
    "loadRestriction.loadSetNames",
    "actions",
    "requiredActions",
    "feasibleActions",
    "forbiddenActionTypes",
    "physicalLineGuidedProperty.direction",
    "physicalLineGuidedProperty.length",
    "reentryAllowed",
    "corridor.maximumLeftWidth",
    "corridor.maximumRightWidth",
    "corridor.corridorReferencePoint",
];

/// Member whose values LIF spells differently from VDA 5050.
pub(super) const REFERENCE_POINT: &str = "corridor.corridorReferencePoint";
const REFERENCE_POINTS: &[&str] = &["KINEMATIC_CENTER", "CONTOUR"];

/// Members of a station; `theta` is that of its position.
pub(super) const STATION: &[&str] = &[
    "stationName",
    "stationType",
    "stationDescription",
    "stationHeight",
];

/// Members of the position of a station.
pub(super) const STATION_POSITION: &[&str] = &["theta"];

/// Members of a layout.
pub(super) const LAYOUT: &[&str] = &[
    "layoutVersion",
    "layoutLevelId",
    "layoutDescription",
    "layoutDescriptor",
];

/// Members of an origin; each of its levels has them.
pub(super) const ORIGIN: &[&str] = &["originId", "originDescription", "originDescriptor"];

/// Members of the meta information.
pub(super) const META: &[&str] = &[
    "projectIdentification",
    "lifId",
    "creator",
    "exportTimestamp",
    "lifVersion",
];

/// Names of one member in 1.0 and 2.0. Files use either, because the text of 2.0 and its examples
/// differ.
pub(super) const ALIASES: &[[&str; 2]] = &[
    ["nodeDescription", "nodeDescriptor"],
    ["edgeDescription", "edgeDescriptor"],
    ["layoutDescription", "layoutDescriptor"],
    ["originDescription", "originDescriptor"],
    ["projectIdentification", "lifId"],
];

/// Members with a column of their own, in the versions that have them: name, column, kind,
/// quantity.
type OwnMember = (
    &'static [Version],
    &'static str,
    &'static str,
    CellKind,
    Option<Quantity>,
);

const BOTH: &[Version] = &[Version::V1, Version::V2];
const SECOND: &[Version] = &[Version::V2];

const fn text(name: &'static str, column: &'static str) -> OwnMember {
    (BOTH, name, column, CellKind::Text, None)
}

const OWN: &[OwnMember] = &[
    text("layoutVersion", "layoutVersion"),
    text("layoutLevelId", "layoutLevelId"),
    text("originId", "originId"),
    text("originDescription", "originDescription"),
    text("originDescriptor", "originDescription"),
    text("projectIdentification", "projectIdentification"),
    text("lifId", "projectIdentification"),
    text("creator", "creator"),
    text("exportTimestamp", "exportTimestamp"),
    text("lifVersion", "lifVersion"),
    (
        SECOND,
        "allowedDeviationXY",
        "allowedDeviationXY",
        CellKind::Json,
        None,
    ),
    (
        SECOND,
        "physicalLineGuidedProperty.direction",
        "physicalLineGuidedProperty.direction",
        CellKind::Text,
        None,
    ),
    (
        SECOND,
        "physicalLineGuidedProperty.length",
        "physicalLineGuidedProperty.length",
        CellKind::Number,
        Some(Quantity::Length),
    ),
];

/// The column that holds a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Column {
    /// Name of the member; `group.name` lies in a nested object.
    pub(super) member: &'static str,
    pub(super) name: &'static str,
    pub(super) kind: CellKind,
    pub(super) quantity: Option<Quantity>,
}

impl Version {
    fn vocabulary(self) -> Vocabulary {
        self.pick(Vocabulary::Lif1, Vocabulary::Lif2)
    }

    /// Returns the column of a member; `None` if the version lacks it.
    pub(super) fn column(self, member: &'static str) -> Option<Column> {
        if let Some(field) = field(self.vocabulary(), member) {
            let property = Property::named(field.property)?;
            let kind = match member {
                REFERENCE_POINT => CellKind::Choice(REFERENCE_POINTS),
                _ => CellKind::of(property),
            };
            return Some(Column {
                member,
                name: property.name,
                kind,
                quantity: property.quantity(),
            });
        }
        let own = OWN
            .iter()
            .find(|own| own.1 == member && own.0.contains(&self));
        own.map(|&(_, member, name, kind, quantity)| Column {
            member,
            name,
            kind,
            quantity,
        })
    }

    /// Returns the columns of members; `None` for those that the version lacks.
    pub(super) fn columns(self, members: &[&'static str]) -> Vec<Option<Column>> {
        members.iter().map(|member| self.column(member)).collect()
    }
}

/// Returns the columns of members of either version.
pub(super) fn columns_of_any_version(members: &[&'static str]) -> Vec<Option<Column>> {
    let of_any = |member| Version::V1.column(member).or(Version::V2.column(member));
    members.iter().map(|&member| of_any(member)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_member_has_a_column_in_a_version() {
        let all = [
            NODE,
            NODE_TYPE,
            EDGE,
            EDGE_TYPE,
            STATION,
            STATION_POSITION,
            LAYOUT,
            ORIGIN,
            META,
        ];
        for member in all.into_iter().flatten() {
            let columns = columns_of_any_version(&[member]);
            assert!(columns[0].is_some(), "{member}");
        }
        assert_eq!(Version::V1.column("maximumSpeed"), None);
        let speed = Version::V2.column("maximumSpeed").unwrap();
        assert_eq!(
            (speed.name, speed.quantity),
            ("maxSpeed", Some(Quantity::Speed))
        );
    }

    #[test]
    fn aliases_have_the_same_column() {
        for pair in ALIASES {
            let columns = columns_of_any_version(pair);
            assert_eq!(columns[0].unwrap().name, columns[1].unwrap().name);
        }
    }
}
