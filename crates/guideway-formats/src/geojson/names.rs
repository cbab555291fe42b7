//! Property names of parts of a layout that GeoJSON has no word for.

/// Beginning of all names. A column of a layout whose name begins like this is not written.
pub(super) const PREFIX: &str = "guideway:";

/// Kind of the element: `node`, `path`, `station` or `zone`.
pub(super) const ELEMENT: &str = "guideway:element";
/// Level of the element.
pub(super) const LEVEL: &str = "guideway:level";
/// Nodes of a path.
pub(super) const START: &str = "guideway:start";
pub(super) const END: &str = "guideway:end";
/// `both` for a two-way path.
pub(super) const DIRECTION: &str = "guideway:direction";
/// Vehicle types of a path or a node, and their properties in the same order.
pub(super) const VEHICLE_TYPES: &str = "guideway:vehicleTypes";
pub(super) const TYPE_PROPERTIES: &str = "guideway:typeProperties";
/// Nodes of a station.
pub(super) const NODES: &str = "guideway:nodes";
/// Style of a path: width in meters, color as `#rrggbbaa`, draw rank.
pub(super) const WIDTH: &str = "guideway:width";
pub(super) const COLOR: &str = "guideway:color";
pub(super) const RANK: &str = "guideway:rank";
/// Runs of control points of uniform cubic B-splines, in meters.
pub(super) const CURVE: &str = "guideway:curve";
/// The NURBS curve as its file wrote it, in meters.
pub(super) const NURBS: &str = "guideway:nurbs";

/// Property of a route graph of Nav2 with the identifier in the layout, where it is not a number.
pub(super) const ORIGINAL_ID: &str = "original_id";

/// Version of the format of a route graph, as the provenance of its layout states it.
pub(crate) const ROUTE_GRAPH: &str = "Nav2 route graph";

/// Version of these names, as the member `guideway` of a collection states it.
pub(super) const VERSION: u32 = 1;

/// Returns whether a column has a name of the extension, and so cannot be written.
pub(super) fn is_reserved(column: &str) -> bool {
    column.starts_with(PREFIX)
}
