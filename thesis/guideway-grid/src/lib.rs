//! The per-pixel method of the thesis (section 4.3): curves are sampled into lines, lines sorted into the
//! cells of a uniform grid, and every pixel tests all lines of its cell. docs/method-grid.md has the whole.
//!
//! The folder in the order of the data: `local` and `pack` bring the scene to the device, `build` runs the
//! four phases, `shot`, `pass` and `canvas` are a view, its work and its pixels, `prepared` draws.

mod build;
mod canvas;
mod cut;
mod kernels;
mod local;
mod options;
mod pack;
mod params;
mod pass;
mod prepared;
mod shot;
mod table;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use guideway_scene::Scene;
use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError};

use guideway_gpu::Gpu;
use kernels::Kernels;
pub use options::{Antialias, Binning, GridOptions, PrefixSum};
use prepared::PreparedGrid;

const NAME: &str = "grid";

/// The method `grid`: compute shaders through wgpu.
///
/// It draws opaque paths of one color and one width. A path counts as drawn wherever it is, for the method
/// looks at cells and never at paths.
#[derive(Clone)]
pub struct Grid(Arc<Variant>);

/// What all scenes of one variant share.
struct Variant {
    gpu: Arc<Gpu>,
    options: GridOptions,
    kernels: Kernels,
}

impl Grid {
    /// A variant of the method on a device.
    ///
    /// # Errors
    /// When a number of the options is not possible, or the device does not take the shaders: a sentence
    /// with the reason.
    pub fn new(gpu: Arc<Gpu>, options: GridOptions) -> Result<Self, String> {
        options.check()?;
        Ok(Self(Arc::new(Variant {
            kernels: Kernels::new(&gpu, &options)?,
            gpu,
            options,
        })))
    }

    /// Which variant it is.
    pub fn options(&self) -> GridOptions {
        self.0.options
    }
}

impl Method for Grid {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "The thesis' per-pixel tests of lines in a uniform grid, as written or mended by \
                      options; one color",
            device: self.0.gpu.adapter_name(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(PreparedGrid::new(
            Arc::clone(&self.0),
            scene,
            budget,
        )?))
    }
}

/// What the method cannot draw, and a sentence on what to ask for instead.
fn unsupported(what: impl Into<String>, remedy: &str) -> RenderError {
    RenderError::Unsupported {
        method: NAME,
        what: what.into(),
        remedy: remedy.to_owned(),
    }
}
