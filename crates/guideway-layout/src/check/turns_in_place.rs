//! Rotation edges: paths without length on which a vehicle turns or acts in place.

use crate::{Layout, PathRef};

/// Properties of a path that say how a vehicle turns or acts on it.
const TURNS: [&str; 11] = [
    "vehicleOrientation",
    "vehicleOrientations",
    "orientationType",
    "rotationAllowed",
    "rotationAtStartNodeAllowed",
    "rotationAtEndNodeAllowed",
    "reachOrientationBeforeEntering",
    "maxRotationSpeed",
    "actions",
    "requiredActions",
    "feasibleActions",
];

/// Orientation of the vehicle at a node.
const NODE_ORIENTATION: &str = "theta";

/// Returns `true` if a path without length is meant: it leads from a node to the same node, or to
/// another one and it states rotation, orientation or actions, or the orientation changes.
pub(super) fn turns_in_place(layout: &Layout, path: PathRef<'_>) -> bool {
    let (Some(start), Some(end)) = (path.start_node(), path.end_node()) else {
        return false;
    };
    let states = |name: &&str| layout.paths.value(path.row(), name).is_some();
    let nodes = &layout.nodes;
    let orientation = |node: u32| {
        let own = nodes.attributes.value(node as usize, NODE_ORIENTATION);
        let per_type = nodes.vehicle_types();
        own.or_else(|| per_type.first_value(node as usize, NODE_ORIENTATION))
    };
    start == end || TURNS.iter().any(states) || orientation(start) != orientation(end)
}
