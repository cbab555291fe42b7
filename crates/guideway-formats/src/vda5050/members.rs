//! Members of the objects of an order, and the columns of the layout that hold them.
//!
//! A member that several formats share is in the table of fields; the others have columns under
//! their own names.

use guideway_layout::Quantity;

use super::version::Version;
use crate::fields::field;
use crate::json::CellKind;

/// Column of the members of an object that VDA 5050 does not define: a JSON object.
pub(super) const OTHER: &str = "other";
/// Column of the further passes of a node that an order passes several times: a JSON array of nodes
/// without identifier and place.
pub(super) const PASSES: &str = "passes";
/// Column that is true for a node without a position in the file, which lies at the end of a
/// trajectory.
pub(super) const DERIVED: &str = "positionFromTrajectory";
/// Column of the order of a path, if a file has several.
pub(super) const ORDER: &str = "orderId";
/// Column of the place in the order.
pub(super) const SEQUENCE: &str = "sequenceId";

/// Members of the root object, without nodes and edges.
pub(super) const HEADER: &[&str] = &[
    "headerId",
    "timestamp",
    "version",
    "manufacturer",
    "serialNumber",
    "orderId",
    "orderUpdateId",
    "zoneSetId",
    "orderDescription",
];

/// Members of a node, without identifier, `sequenceId` and position.
pub(super) const NODE: &[&str] = &["nodeDescription", "nodeDescriptor", "released", "actions"];

/// Members of the position of a node, without coordinates and map.
pub(super) const POSITION: &[&str] = &[
    "theta",
    "allowedDeviationXY",
    "allowedDeviationTheta",
    "mapDescription",
    "mapDescriptor",
];

/// Members of an edge, without identifier, `sequenceId`, nodes and trajectory.
pub(super) const EDGE: &[&str] = &[
    "edgeDescription",
    "edgeDescriptor",
    "released",
    "maxSpeed",
    "maximumSpeed",
    "maxHeight",
    "maximumMobileRobotHeight",
    // Names in drafts of 3.0.
    "maximumHeight",
    "minHeight",
    "minimumLoadHandlingDeviceHeight",
    "minimumHeight",
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
    "corridor.leftWidth",
    "corridor.rightWidth",
    "corridor.corridorRefPoint",
    "corridor.corridorReferencePoint",
    "corridor.releaseRequired",
    "corridor.releaseLossBehavior",
    "actions",
];

/// Member whose values 3.0 spells differently.
pub(super) const REFERENCE_POINT: &str = "corridor.corridorReferencePoint";
const REFERENCE_POINTS: &[&str] = &["KINEMATIC_CENTER", "CONTOUR"];

/// Members with a column of their own, in the versions that have them: name, column, kind.
type OwnMember = (&'static [Version], &'static str, &'static str, CellKind);

const BOTH: &[Version] = &[Version::V2, Version::V3];
const SECOND: &[Version] = &[Version::V2];
const THIRD: &[Version] = &[Version::V3];

const OWN: &[OwnMember] = &[
    (BOTH, "headerId", "headerId", CellKind::Integer),
    (BOTH, "timestamp", "timestamp", CellKind::Text),
    (BOTH, "version", "version", CellKind::Text),
    (BOTH, "manufacturer", "manufacturer", CellKind::Text),
    (BOTH, "serialNumber", "serialNumber", CellKind::Text),
    (BOTH, "orderId", "orderId", CellKind::Text),
    (BOTH, "orderUpdateId", "orderUpdateId", CellKind::Integer),
    (SECOND, "zoneSetId", "zoneSetId", CellKind::Text),
    (
        THIRD,
        "orderDescription",
        "orderDescription",
        CellKind::Text,
    ),
    (SECOND, "mapDescription", "mapDescription", CellKind::Text),
    (THIRD, "mapDescriptor", "mapDescription", CellKind::Text),
    (
        THIRD,
        "allowedDeviationXY",
        "allowedDeviationXY",
        CellKind::Json,
    ),
    (BOTH, "direction", "direction", CellKind::Text),
    (
        THIRD,
        "corridor.releaseRequired",
        "corridor.releaseRequired",
        CellKind::Flag,
    ),
    (
        THIRD,
        "corridor.releaseLossBehavior",
        "corridor.releaseLossBehavior",
        CellKind::Text,
    ),
];

/// A member with its column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    /// Name in the file; `group.name` lies in a nested object.
    pub(super) name: &'static str,
    pub(super) column: &'static str,
    pub(super) kind: CellKind,
    pub(super) quantity: Option<Quantity>,
}

impl Version {
    /// Returns the column of a member; `None` if the version lacks it.
    pub(super) fn member(self, name: &'static str) -> Option<Member> {
        let mut own = OWN.iter();
        if let Some(&(_, name, column, kind)) =
            own.find(|own| own.1 == name && own.0.contains(&self))
        {
            return Some(Member {
                name,
                column,
                kind,
                quantity: None,
            });
        }
        let property = field(self.vocabulary(), name)?.property()?;
        let kind = match name {
            REFERENCE_POINT => CellKind::Choice(REFERENCE_POINTS),
            _ => CellKind::of(property),
        };
        Some(Member {
            name,
            column: property.name,
            kind,
            quantity: property.quantity(),
        })
    }

    /// Returns the column of a member of this version, or else of the other one: files mix them.
    pub(super) fn member_of_any(self, name: &'static str) -> Option<Member> {
        self.member(name).or_else(|| self.other().member(name))
    }

    /// Returns the members that a writer of this version uses, one per column.
    pub(super) fn members(self, names: &[&'static str]) -> Vec<Member> {
        let mut members: Vec<Member> = Vec::new();
        for member in names.iter().filter_map(|name| self.member(name)) {
            if members.iter().all(|known| known.column != member.column) {
                members.push(member);
            }
        }
        members
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_member_has_a_column() {
        for version in [Version::V2, Version::V3] {
            for name in [HEADER, NODE, POSITION, EDGE].into_iter().flatten() {
                assert!(version.member_of_any(name).is_some(), "{name}");
            }
        }
        assert_eq!(Version::V2.member("maximumSpeed"), None);
    }

    #[test]
    fn writers_use_one_name_per_column() {
        let names = |version: Version| -> Vec<&str> {
            let members = version.members(EDGE).into_iter();
            let lengths = members.filter(|m| matches!(m.column, "length" | "maxHeight"));
            lengths.map(|m| m.name).collect()
        };
        assert_eq!(names(Version::V2), ["maxHeight", "length"]);
        assert_eq!(names(Version::V3), ["maximumMobileRobotHeight", "length"]);
    }
}
