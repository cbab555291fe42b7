//! Names by which the thesis' methods and their stages are told apart.

/// Per-pixel intersection as the thesis writes it.
pub(crate) const GRID: &str = "grid";
/// The same with a work-efficient prefix sum.
pub(crate) const GRID_SCAN: &str = "grid+scan";
/// The same with every line in all cells that it reaches.
pub(crate) const GRID_MENDED: &str = "grid+scan+radius";
/// As the thesis writes it, but with edges that do not fade.
pub(crate) const GRID_HARD: &str = "grid+aa=none";
/// Tessellation as the thesis writes it: one indirect command a path.
pub(crate) const TESSELLATION: &str = "tessellation";
/// The same with one draw for all patches.
pub(crate) const TESSELLATION_COMPACT: &str = "tessellation-compact";
/// The judge of all methods.
pub(crate) const ORACLE: &str = "oracle";

/// Phases of building the grid.
pub(crate) const SAMPLE: &str = "sample";
pub(crate) const COUNT: &str = "count";
pub(crate) const PREFIX_SUM: &str = "prefix sum";
pub(crate) const BIN: &str = "bin";

/// Stages of a frame by tessellation.
pub(crate) const CULL: &str = "cull";
pub(crate) const TESSELLATE_AND_DRAW: &str = "tessellate and draw";
