//! Names of the columns with a meaning, and the version of the table.

/// Column of identifiers.
pub(super) const ID: &str = "id";
/// Column of control polygons.
pub(super) const CONTROL_POINTS: &str = "control_points";
/// Column that joins several rows to one path.
pub(super) const PART: &str = "guideway.part";
/// Column of levels.
pub(super) const LEVEL: &str = "level";
/// Column of stroke widths.
pub(super) const WIDTH: &str = "width_m";
/// Column of colors.
pub(super) const COLOR: &str = "color";
/// Column of draw ranks.
pub(super) const RANK: &str = "rank";
/// Metadata key of the schema that holds the version of the table.
pub(super) const VERSION_KEY: &str = "guideway.version";
/// Newest supported version of the table.
pub(super) const VERSION: u32 = 1;
