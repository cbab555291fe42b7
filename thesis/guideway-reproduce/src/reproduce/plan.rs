use serde::{Deserialize, Serialize};

use super::Search;
use super::names::{GRID, GRID_MENDED, GRID_SCAN, TESSELLATION, TESSELLATION_COMPACT};
use guideway_bench::Dataset;

/// The thesis' methods and their variants, and beside them the methods that are not the thesis'.
pub const METHODS: [&str; 10] = [
    GRID,
    GRID_SCAN,
    GRID_MENDED,
    "grid+scan+radius+exit",
    "grid+scan+radius+exit+aa=subpixel",
    TESSELLATION,
    "tessellation+aa=multisample",
    TESSELLATION_COMPACT,
    "gpu",
    "cpu",
];

/// Everything that decides what is measured, so that a run says of itself what it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Whether this is the short run for slow devices.
    pub is_quick: bool,
    /// Methods with their options.
    pub methods: Vec<String>,
    /// Width and height of the measured pictures.
    pub size_px: [u32; 2],
    /// Memory that each method may use.
    pub memory_bytes: u64,
    /// Paths of D1 and of D2 in tables 5.2 and 5.3 and in figure 5.3.
    pub view_paths: [usize; 2],
    /// Numbers of paths in figures 5.4 and 5.5.
    pub sizes: Vec<usize>,
    /// Times that a scene is made ready for figure 5.5, after a first time that does not count.
    pub repeats: usize,
    /// Table 5.1.
    pub search: Search,
    /// Frames after the first that do not count.
    pub warmup: usize,
    /// Frames that count.
    pub frames: usize,
    /// Once a method has drawn a view for so long, one frame that counts is enough.
    pub enough_ms: f64,
    /// Time for one sitting, of the last one where they differ.
    pub minutes: f64,
}

impl Plan {
    /// What the thesis measured, for a graphics device.
    pub fn full() -> Self {
        Self {
            is_quick: false,
            methods: METHODS.map(str::to_owned).to_vec(),
            size_px: [1920, 1080],
            memory_bytes: 16_000_000_000,
            // The thesis does not say; these are the counts of its table 5.1.
            view_paths: [1_020_350, 756_000],
            sizes: vec![90_000, 180_000, 360_000, 540_000, 720_000],
            repeats: 10,
            search: Search {
                target_ms: 1000.0 / 60.0,
                start: 64_000,
                least: 1_000,
                ceiling: 4_000_000,
                tolerance: 0.02,
            },
            warmup: 5,
            frames: 60,
            enough_ms: 2_000.0,
            minutes: 60.0,
        }
    }

    /// The same in small, so that it ends in minutes on a processor that plays the graphics device.
    pub fn quick() -> Self {
        Self {
            is_quick: true,
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
            ..Self::full()
        }
    }

    /// Paths of a dataset in the tables of views.
    pub fn view_paths(&self, dataset: Dataset) -> usize {
        match dataset {
            Dataset::D1 => self.view_paths[0],
            Dataset::D2 => self.view_paths[1],
        }
    }
}
