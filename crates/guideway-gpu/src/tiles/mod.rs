//! GPU rasterizer: flattens curves to lines, bins them into 16 px tiles, and resolves 64 samples
//! per pixel, every frame from the control points. docs/pipeline.md describes the method.
//!
//! | stage | input | output | Rust, shaders |
//! |---|---|---|---|
//! | upload | scene, edits | clusters of strokes, control points, styles | `upload` |
//! | cull | clusters, view | visible clusters | `frame`, `shaders/flatten` |
//! | flatten | visible strokes | lines; number of lines per tile | `frame`, `shaders/flatten` |
//! | bin | lines, counts | list of lines per tile, sorted or split | `frame`, `shaders/bin` |
//! | cover | tile lists of one opaque color | pixels | `frame`, `shaders/cover` |
//! | composite | tile lists of many colors | pixels | `frame`, `shaders/composite` |
//! | cache | lines, pixels of the last frame | lines, pixels to reuse | `cache`, `shaders/cache` |
//!
//! `device_context` has the device handles of a scene, `prepared` routes renders and edits to these
//! stages, `method` is the entry.
//!
//! # Clusters
//!
//! Paths are cut into strokes of at most 32 segments, sorted along the Hilbert curve, and grouped
//! by 64. A cluster stores its points relative to an origin, quantized to 16 bits per axis if it is
//! small beside the scene:
//!
//! ```text
//!   high_m ...... +----------------------------+      point = origin + step_m * (x, y)
//!                 |   ,-- stroke 0             |      x, y in -32768 ..= 32767
//!                 |  o--o---o---o              |
//!                 |          + origin   ,-o-o  |      The origin is split into two floats: the
//!                 |       o--o--o------o  stroke 63   shader subtracts the view's center from it
//!   low_m ....... +----------------------------+      without loss.
//! ```
//!
//! Views so near that half a step would exceed 1/128 px draw exact points instead (`exact_points`).
//!
//! # Tiles and line blocks
//!
//! ```text
//!   tile_lists[tile] = start..end          references             lines (3 words each)
//!   +----+----+----+                      +---+---+---+---+      +------+-----+-----+------+-----+
//!   | 0  | 1  | 2  |  tile 1: 2..4  --->  | 5 | 9 | 1 | 5 | ---> | head | l 1 | l 2 | head | ... |
//!   +----+----+----+                      +---+---+---+---+      +------+-----+-----+------+-----+
//!   | 3  | 4  | 5  |                                               |  block of one cluster    ^
//!   +----+----+----+                      previous block <---------+--------------------------+
//! ```
//!
//! Cached lines lie in blocks, one per cluster and workgroup. The head of a block links to the
//! cluster's previous block, so that an edit finds and invalidates all lines of the cluster.

mod cache;
mod constants;
mod device_context;
mod frame;
mod kernels;
mod layouts;
mod list_limits;
mod method;
mod options;
mod paint_mode;
mod prepared;
mod shaders;
mod upload;
mod work;

pub use method::Tiles;
pub use options::TilesOptions;

#[cfg(test)]
mod layout_tests;
#[cfg(test)]
mod rounding_tests;
#[cfg(test)]
mod tests;
