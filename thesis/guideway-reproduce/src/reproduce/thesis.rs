//! Numbers of the thesis, measured on an Intel Core Ultra 7 155H with its integrated Arc graphics
//! at 1920 x 1080 pixels.

use super::names::{GRID, TESSELLATION};
use guideway_bench::Dataset;

/// The machine of the thesis.
pub(crate) const MACHINE: &str = "Core Ultra 7 155H, Intel Arc";

/// Table 5.1: dataset, method, most paths at 60 FPS, megabytes.
pub(crate) const MOST_PATHS: [(Dataset, &str, u64, u64); 4] = [
    (Dataset::D1, TESSELLATION, 225_000, 128),
    (Dataset::D1, GRID, 1_020_350, 1090),
    (Dataset::D2, TESSELLATION, 222_000, 126),
    (Dataset::D2, GRID, 756_000, 893),
];

/// Tables 5.2 and 5.3: dataset, then milliseconds with 0, about 50 and about 100 % of the pixels
/// inside.
pub(crate) const OCCUPANCY_MS: [(Dataset, [f64; 3]); 2] = [
    (Dataset::D1, [1.42, 4.90, 7.50]),
    (Dataset::D2, [1.44, 10.82, 16.92]),
];
