//! The plan of a run: methods, datasets, picture size, frames and time limit.

use serde::{Deserialize, Serialize};

use super::names::{
    GRID, GRID_RADIUS, GRID_SCAN, QUADTREE, QUADTREE_TILES, TESSELLATION, TESSELLATION_COMPACT,
    TREE, TREE_TILES,
};
use super::search::Search;
use guideway_bench::Dataset;

/// The methods of the thesis with their variants, its proposals, and the methods of Guideway.
pub const METHODS: [&str; 14] = [
    GRID,
    GRID_SCAN,
    GRID_RADIUS,
    "grid+scan+radius+exit",
    "grid+scan+radius+exit+aa=subpixel",
    TESSELLATION,
    "tessellation+aa=multisample",
    TESSELLATION_COMPACT,
    TREE,
    TREE_TILES,
    QUADTREE,
    QUADTREE_TILES,
    "gpu",
    "cpu",
];

/// All settings of a run; the run file stores them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// True if this is the quick run for slow devices.
    pub is_quick: bool,
    /// Methods with their options.
    pub methods: Vec<String>,
    /// Width and height of the measured pictures.
    pub size_px: [u32; 2],
    /// Memory limit per method.
    pub memory_bytes: u64,
    /// Paths of D1 and of D2 in tables 5.2 and 5.3, in figure 5.3 and of layouts that change.
    pub view_paths: [usize; 2],
    /// Numbers of paths in figures 5.4 and 5.5.
    pub sizes: Vec<usize>,
    /// Measured preparations of a scene for figure 5.5, after an unmeasured one.
    pub repeats: usize,
    /// Search of table 5.1.
    pub search: Search,
    /// Unmeasured frames after the first.
    pub warmup: usize,
    /// Measured frames.
    pub frames: usize,
    /// Drawing time of a view in milliseconds after which one measured frame suffices.
    pub enough_ms: f64,
    /// Time limit of the last session.
    pub minutes: f64,
}

impl Plan {
    /// The measurements of the thesis, for a graphics device.
    pub fn full() -> Self {
        Self {
            is_quick: false,
            methods: METHODS.map(str::to_owned).to_vec(),
            size_px: [1920, 1080],
            memory_bytes: 16_000_000_000,
            // The thesis does not state them; these are the counts of its table 5.1.
            view_paths: [1_020_350, 756_000],
            sizes: vec![90_000, 180_000, 360_000, 540_000, 720_000],
            repeats: 10,
            search: Search {
                target_ms: 1000.0 / 60.0,
                start: 64_000,
                least: 1_000,
                ceiling: 100_000_000,
                tolerance: 0.02,
            },
            warmup: 5,
            frames: 60,
            enough_ms: 2_000.0,
            minutes: 60.0,
        }
    }

    /// Smaller measurements that end within minutes on a software graphics device.
    pub fn quick() -> Self {
        Self {
            is_quick: true,
            // Pixels that search together wait for each other, which takes seconds per frame on a
            // software graphics device.
            methods: METHODS
                .into_iter()
                .filter(|method| !method.contains("tiles"))
                .map(str::to_owned)
                .collect(),
            size_px: [640, 360],
            memory_bytes: 2_000_000_000,
            view_paths: [8_000, 8_000],
            sizes: vec![2_000, 4_000, 8_000, 12_000, 16_000],
            repeats: 4,
            search: Search {
                start: 1_000,
                least: 100,
                ceiling: 20_000,
                ..Self::full().search
            },
            warmup: 1,
            frames: 9,
            enough_ms: 300.0,
            minutes: 9.0,
        }
    }

    /// Number of paths of a dataset in the tables and figures of views.
    pub fn view_paths(&self, dataset: Dataset) -> usize {
        match dataset {
            Dataset::D1 => self.view_paths[0],
            Dataset::D2 => self.view_paths[1],
        }
    }
}
