//! Names of the columns and of the metadata with a meaning, and the versions of the table.

/// Column of identifiers.
pub(super) const ID: &str = "id";
/// Column of control polygons.
pub(super) const CONTROL_POINTS: &str = "control_points";
/// Column that joins several rows to one path.
pub(super) const PART: &str = "guideway.part";
/// Column of the kind of element in each row; it marks a table of version 2.
pub(super) const ELEMENT: &str = "guideway.element";
/// Column of levels.
pub(super) const LEVEL: &str = "level";
/// Column of stroke widths.
pub(super) const WIDTH: &str = "width_m";
/// Column of colors.
pub(super) const COLOR: &str = "color";
/// Column of draw ranks.
pub(super) const RANK: &str = "rank";
/// Column of the first nodes of paths.
pub(super) const START_NODE: &str = "start_node";
/// Column of the last nodes of paths.
pub(super) const END_NODE: &str = "end_node";
/// Column of the directions of paths.
pub(super) const DIRECTION: &str = "direction";
/// Column of the vehicle types of paths and nodes.
pub(super) const VEHICLE_TYPES: &str = "vehicle_types";
/// Column of curves as their file wrote them.
pub(super) const CURVE: &str = "curve";
/// Columns of positions.
pub(super) const X: &str = "x_m";
pub(super) const Y: &str = "y_m";
/// Column of the nodes of stations.
pub(super) const NODES: &str = "nodes";
/// Column of the path or node that a row per vehicle type belongs to.
pub(super) const OF: &str = "of";
/// Columns of levels.
pub(super) const LEVEL_NAME: &str = "level_name";
pub(super) const ELEVATION: &str = "elevation_m";
/// Column of the members of blocks, with the names of its fields.
pub(super) const MEMBERS: &str = "members";
pub(super) const MEMBER_ELEMENT: &str = "element";
pub(super) const MEMBER_INDEX: &str = "index";
/// Column of the outlines of zones.
pub(super) const OUTLINE: &str = "outline_m";
/// Columns of the reasons of refused paths.
pub(super) const REFUSAL_CODE: &str = "refusal_code";
pub(super) const REFUSAL_DETAIL: &str = "refusal_detail";
/// Fields of [`CURVE`].
pub(super) const DEGREE: &str = "degree";
pub(super) const KNOTS: &str = "knots";
pub(super) const WEIGHTS: &str = "weights";
pub(super) const POINTS: &str = "points";

/// Directions in [`DIRECTION`].
pub(super) const FORWARD: &str = "forward";
pub(super) const BOTH: &str = "both";

/// Metadata key of the schema that holds the version of the table.
pub(super) const VERSION_KEY: &str = "guideway.version";
/// Version of a table of paths without a network.
pub(super) const PATHS_VERSION: u32 = 1;
/// Version of a table of all elements, the newest one.
pub(super) const NETWORK_VERSION: u32 = 2;
/// Metadata keys of the schema that hold the place on earth of the origin.
pub(super) const LONGITUDE_KEY: &str = "guideway.longitude_deg";
pub(super) const LATITUDE_KEY: &str = "guideway.latitude_deg";
/// Metadata key of the footer that holds the order of the paths, and its value for a Hilbert curve.
pub(super) const ORDER_KEY: &str = "guideway.order";
pub(super) const HILBERT_ORDER: &str = "hilbert";
/// Metadata key of a field that holds the unit of its numbers.
pub(super) const UNIT_KEY: &str = "unit";
/// Metadata of a field of JSON texts: the canonical extension type of Arrow, which polars keeps and
/// DuckDB reads as its own type of JSON.
pub(super) const EXTENSION_KEY: &str = "ARROW:extension:name";
pub(super) const EXTENSION_METADATA_KEY: &str = "ARROW:extension:metadata";
pub(super) const JSON_EXTENSION: &str = "arrow.json";
