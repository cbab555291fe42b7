//! Method `cpu`: lines by tile, covered until nothing is left to be covered, in parallel.
//!
//! Paths that are near each other (`order`) form clusters, once (`index`). A frame (`frame`) goes through five stages: `cull`
//! finds the clusters in sight (`sight`), and what of the picture has to be drawn (`kept`); `flatten` turns their
//! curves into lines (`cluster`, `simplify`), unless those of an earlier frame will do; `bin` lists the clusters of
//! each tile of 32 x 32 pixels (`bins`), or of wide ones the lines that cross it (`crossings`); `cover` finds which
//! samples of each tile the lines cover (`paint`, then `seen` for one color or `layers` for several, `fixed` or
//! `stroke` and `span`, `canvas`); `keep` keeps the picture.
//! Of one color, pixels that are full for certain in the views to come are found beside that, and not covered again
//! (`filled`).
//! Coverage is an OR of bits, and all that is added up is a whole number or added in draw order, so the picture
//! is the same on every run, with any number of threads, any vector instructions and in any number of bands.

mod backdrop;
mod bins;
mod canvas;
mod cluster;
mod crossings;
mod disc;
mod extent;
mod filled;
mod fixed;
mod flatten;
mod frame;
mod index;
mod joins;
mod joints;
mod kept;
mod layers;
mod order;
mod paint;
mod painter;
mod place;
mod polylines;
mod prepared;
mod seen;
mod shot;
mod sight;
mod simplify;
mod span;
mod stretch;
mod stroke;
#[cfg(test)]
mod tests;
mod threads;
mod tiles;
mod vectors;

use std::sync::Arc;

use guideway_scene::Scene;
use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError};

/// Lanes that work beside each other: rows of samples of a pixel, or lines. One vector of AVX-512, two of
/// AVX2, four of SSE and NEON.
const LANES: usize = 16;

/// Draws on all cores, without a GPU.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

const NAME: &str = "cpu";

impl Method for Cpu {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "error-bounded lines by tile, 128 or 256 samples a pixel, on all cores",
            device: "CPU".to_owned(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(prepared::CpuPrepared::new(scene, budget)?))
    }
}
