//! Every frame from the control points: curves become lines by an error bound, lines are listed by the tiles
//! that they touch, and each tile finds which of its samples are covered. docs/method-gpu.md has the whole.
//!
//! The folder in the order of the data: `pack` makes of the scene what the device reads, `store` holds it there, its
//! points in `chunk`s, `places` knows where and `edit` changes it; `shot` is a view, `level` the scale and place that its
//! lines are made for, `paint` how its tiles are painted, `window` a part of its picture, `twins` are the exact points of what it comes near to, `room` holds
//! the lines that a frame finds, `canvas` its tiles and pixels, `bound` the work between them, `easel` all that a picture is
//! made with; `draw` does it, in `rounds` where that saves work, `kept` is what it need not draw again, `touched` what it must after an edit; `prepared` answers
//! for all of it, and `work` says what a frame takes.

mod bound;
mod canvas;
mod chunk;
mod draw;
mod easel;
mod edit;
mod kept;
mod kernels;
mod level;
mod pack;
mod paint;
mod params;
mod places;
mod prepared;
mod ranks;
mod room;
mod rounds;
mod shaders;
mod shot;
mod store;
mod touched;
mod twins;
mod window;
mod work;

use std::sync::{Arc, OnceLock};

use guideway_scene::Scene;
use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError};

use crate::device::Gpu;
use kernels::Kernels;
use prepared::PreparedTiles;

const NAME: &str = "gpu";

/// The method `gpu`: compute shaders through wgpu. Nothing is prepared but the control points themselves.
#[derive(Clone)]
pub struct Tiles(Arc<Shared>);

/// What may be done otherwise, for comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TilesOptions {
    /// Whether lines and finished pixels are kept from frame to frame where they are still right.
    pub keeps: bool,
    /// Whether the device's clock tells the stages of a frame apart. The device comes to a stop for that, so frames take longer.
    pub times_stages: bool,
}

impl Default for TilesOptions {
    fn default() -> Self {
        Self {
            keeps: true,
            times_stages: false,
        }
    }
}

/// What all scenes share.
struct Shared {
    gpu: Arc<Gpu>,
    kernels: Arc<Kernels>,
    /// Made when work is first counted.
    counting_kernels: OnceLock<Result<Arc<Kernels>, String>>,
    options: TilesOptions,
}

impl Tiles {
    /// The method on a device.
    ///
    /// # Errors
    /// When the device does not take the shaders: a sentence with its reason.
    pub fn new(gpu: Arc<Gpu>, options: TilesOptions) -> Result<Self, String> {
        Ok(Self(Arc::new(Shared {
            kernels: Arc::new(Kernels::new(&gpu)?),
            counting_kernels: OnceLock::new(),
            gpu,
            options,
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

#[cfg(test)]
mod tests;
