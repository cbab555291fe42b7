//! Method `cpu`: lines by tile, covered from the top down, in parallel.
//!
//! A frame goes through four stages. `cull` leaves out clusters of paths that are out of sight; `flatten`
//! turns the rest into lines; `bin` lists the lines of each tile of 16 x 16 pixels in draw order; `cover`
//! finds for each tile which of its 65,536 samples, those of the oracle, each path covers. All that is
//! added up is a whole number or added in draw order, so the picture is the same on every run, with any
//! number of threads and in any number of bands.

mod bin;
mod canvas;
mod cover;
mod cull;
mod flatten;
mod lines;
mod prepared;
mod span;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use guideway_render::{Budget, Method, MethodInfo, Prepared, RenderError};
use guideway_scene::Scene;

/// Draws on all cores, without a GPU.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

const NAME: &str = "cpu";

impl Method for Cpu {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "error-bounded lines by tile, 256 samples a pixel, on all cores",
            device: "CPU".to_owned(),
        }
    }

    fn plan_bytes(&self, scene: &Scene, budget: &Budget) -> u64 {
        prepared::plan_bytes(scene, budget)
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(prepared::CpuPrepared::new(scene, budget)?))
    }
}
