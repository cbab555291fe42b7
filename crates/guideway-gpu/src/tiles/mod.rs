//! Every frame from the control points: curves become lines by an error bound, lines are listed by the tiles
//! that they touch, and each tile finds which of its samples are covered. docs/method-gpu.md has the whole.
//!
//! The folder in the order of the data: `pack` brings the scene to the device, `shot` is a view, `room` holds the
//! lines that a frame finds, `canvas` its tiles and pixels, `passes` the work between them, `prepared` draws.

mod canvas;
mod kernels;
mod pack;
mod params;
mod passes;
mod prepared;
mod room;
mod shot;

use std::sync::Arc;

use guideway_render::{Budget, Method, MethodInfo, Prepared, RenderError};
use guideway_scene::Scene;

use crate::device::Gpu;
use kernels::Kernels;
use prepared::PreparedTiles;

const NAME: &str = "gpu";

/// The method `gpu`: compute shaders through wgpu. Nothing is prepared but the control points themselves.
#[derive(Clone)]
pub struct Tiles(Arc<Shared>);

/// What all scenes share.
struct Shared {
    gpu: Arc<Gpu>,
    kernels: Kernels,
}

impl Tiles {
    /// The method on a device.
    ///
    /// # Errors
    /// When the device does not take the shaders: a sentence with its reason.
    pub fn new(gpu: Arc<Gpu>) -> Result<Self, String> {
        Ok(Self(Arc::new(Shared {
            kernels: Kernels::new(&gpu)?,
            gpu,
        })))
    }
}

impl Method for Tiles {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "Every frame from the control points, by tiles and 64 samples a pixel, with compute shaders",
            device: self.0.gpu.adapter_name(),
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
        Ok(Box::new(PreparedTiles::new(
            Arc::clone(&self.0),
            scene,
            budget,
        )?))
    }
}
