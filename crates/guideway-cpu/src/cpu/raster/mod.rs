//! Raster stage: computes which samples of a tile its lines cover, and resolves the samples to
//! pixels.
//!
//! | module                        | does                                                     |
//! |-------------------------------|----------------------------------------------------------|
//! | `tiles`                       | loops over the tiles of a band, on all threads           |
//! | `solid`                       | one opaque color: samples in any order                   |
//! | `job`                         | data that the tiles of a band share; the tile to draw    |
//! | `cluster_in_tile`             | the lines of one cluster relative to a tile              |
//! | `layered`                     | several colors: strokes by descending draw rank          |
//! | `counted`                     | densities: the samples of each path, counted once        |
//! | `waiting_lines`               | lines that wait until they fill a batch                  |
//! | `line_batch`                  | 16 lines side by side: boxes, slopes, capsules           |
//! | `capsule`, `caps`             | sample spans of one stroke; tables of its round caps     |
//! | `disc`                        | sample spans around the end of a path                    |
//! | `fixed_point`                 | the same three in 16-bit integers                        |
//! | `coverage_mask`, `bits`       | the samples of a tile as bits                            |
//! | `resolve`, `background`       | coverage to RGBA                                         |
//! | `full_pixel_cache`            | pixels known to stay full while the view zooms           |
//! | `resting_coverage`            | samples of the paths that rest while others are dragged  |
//! | `tile_rows`, `thread_scratch` | pixels and buffers of one thread                         |

pub(super) mod background;
pub(super) mod bits;
pub(super) mod caps;
pub(super) mod capsule;
pub(super) mod cluster_in_tile;
pub(super) mod counted;
pub(super) mod coverage_mask;
pub(super) mod disc;
pub(super) mod fixed_point;
pub(super) mod full_pixel_cache;
pub(super) mod job;
pub(super) mod layered;
pub(super) mod line_batch;
pub(super) mod resolve;
pub(super) mod resting_coverage;
pub(super) mod solid;
#[cfg(test)]
mod tests;
pub(super) mod thread_scratch;
pub(super) mod tile_rows;
pub(super) mod tiles;
pub(super) mod waiting_lines;
