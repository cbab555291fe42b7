//! Method `cpu`: flattens curves to lines, bins them into 32 px tiles, and resolves the coverage of
//! each tile, on all cores.
//!
//! | stage   | input                      | output                              | folder         |
//! |---------|----------------------------|-------------------------------------|----------------|
//! | sort    | hulls of the paths         | clusters of 64 neighbors, once      | `frame`        |
//! | cull    | cluster bounds, view       | visible clusters; damaged pixels    | `bin`, `frame` |
//! | flatten | curves of visible clusters | polylines, cached per scale         | `flatten`      |
//! | bin     | polylines, cluster boxes   | clusters and line ranges per tile   | `bin`          |
//! | cover   | lists and lines of a tile  | covered samples, resolved to pixels | `raster`       |
//! | keep    | the picture                | the picture cache of the next frame | `frame`        |
//!
//! `ground` holds what the stages share. Imports run from `frame` over `raster`, `bin` and
//! `flatten` to `ground`. The sort is that of `guideway_scene::cluster`.
//!
//! ```text
//!   picture, in tiles        tile: 32 x 32 px               pixel: 16 rows of samples
//!
//!   +----+----+----+----+    +--+--+--+--+--+--+--+--+
//!   |    |    |    |    |    |  |  |  |  |  |  |  |  | row 0    x . x . x . x .   solid:
//!   +----+----+----+----+    |  |  |  |  |  |  |  |  | ...      . x . x . x . x   8 per row,
//!   |    |    |    |    |    |  |  |  |  |  |  |  |  | row 31   x . x . x . x .   checkered
//!   +----+----+----+----+    +--+--+--+--+--+--+--+--+          ...
//!                             8 windows of 4 px (solid)
//!                            16 windows of 2 px (layered)       x x x x x x ...   layered:
//!                                                               x x x x x x ...   16 per row
//!   block: one row of pixels of a window, 16 words of 32 bits:  ...
//!   one word per row of samples, one bit per sample
//! ```
//!
//! Solid masks serve opaque paths of one color: their strokes cover samples in any order. Layered
//! masks serve all else, by descending draw rank.
//!
//! Coverage is an OR of bits, and sums are of integers or in draw order: the picture has the same
//! bits in every run, with any number of threads, vector instructions and bands.

mod bin;
mod flatten;
mod frame;
mod ground;
mod raster;
#[cfg(test)]
mod testing;

use std::sync::Arc;

use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError, Scene};

use frame::memory::NAME;
use frame::state::CpuPrepared;

/// The fast render method without a GPU.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

impl Method for Cpu {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "CPU rasterizer: bins error-bounded lines into tiles, 128 or 256 samples per \
                      pixel, on all cores",
            device: "CPU".to_owned(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(CpuPrepared::new(scene, budget)?))
    }
}
