//! Names of methods, of their stages, and of the parts of a run.

/// Per-pixel intersection as in the thesis.
pub(crate) const GRID: &str = "grid";
/// `grid` with a work-efficient prefix sum.
pub(crate) const GRID_SCAN: &str = "grid+scan";
/// `grid+scan` with each line in all cells that its radius reaches.
pub(crate) const GRID_RADIUS: &str = "grid+scan+radius";
/// The AABB tree that the thesis proposes, each pixel for itself.
pub(crate) const TREE: &str = "tree";
/// `tree` with pixels that search together.
pub(crate) const TREE_TILES: &str = "tree+tiles+exit";
/// The linear quadtree that the thesis proposes, each pixel for itself.
pub(crate) const QUADTREE: &str = "quadtree";
/// `quadtree` with pixels that search together.
pub(crate) const QUADTREE_TILES: &str = "quadtree+tiles+exit";
/// `grid` without anti-aliasing.
pub(crate) const GRID_HARD: &str = "grid+aa=none";
/// Tessellation as in the thesis: one indirect draw per path.
pub(crate) const TESSELLATION: &str = "tessellation";
/// Tessellation with one draw for all patches.
pub(crate) const TESSELLATION_COMPACT: &str = "tessellation-compact";
/// The reference of all methods.
pub(crate) const ORACLE: &str = "oracle";

/// Phases of building the grid.
pub(crate) const SAMPLE: &str = "sample";
pub(crate) const COUNT: &str = "count";
pub(crate) const PREFIX_SUM: &str = "prefix sum";
pub(crate) const BIN: &str = "bin";

/// Stages of a frame by a quadtree: its build, and the tests of pixels as by all per-pixel methods.
pub(crate) const KEYS: &str = "keys";
pub(crate) const SORT: &str = "sort";
pub(crate) const TEST_PIXELS: &str = "test pixels";

/// Stages of a frame by tessellation.
pub(crate) const CULL: &str = "cull";
pub(crate) const TESSELLATE_AND_DRAW: &str = "tessellate and draw";

/// Parts of a run. The run file stores these names.
pub(crate) const PICTURES: &str = "pictures";
pub(crate) const BORDERS: &str = "coverage at the borders of cells";
pub(crate) const OCCUPANCY: &str = "frame time against pixels inside the grid";
pub(crate) const MAGNIFICATION: &str = "frame time against magnification";
pub(crate) const MOST_PATHS: &str = "most paths at 60 frames a second";
pub(crate) const CHANGES: &str = "layouts that change";
pub(crate) const GROWTH: &str = "time against number of paths";
/// All parts of a whole run, in the order of their measurement.
pub(crate) const PARTS: [&str; 7] = [
    PICTURES,
    BORDERS,
    OCCUPANCY,
    MAGNIFICATION,
    CHANGES,
    MOST_PATHS,
    GROWTH,
];
