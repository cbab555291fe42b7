//! The entry of the method: opens a variant on a device and prepares scenes for it.

use std::sync::Arc;

use guideway_gpu::Gpu;
use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError, Scene};

use crate::error::GridError;
use crate::kernels::Kernels;
use crate::options::GridOptions;
use crate::prepared::PreparedGrid;
use crate::variant::{NAME, Variant};

/// The method `grid`: compute shaders through wgpu.
///
/// It draws opaque paths of one color and one width. Reports count every path as drawn, even one
/// outside the view, because the method culls cells and never paths.
#[derive(Clone)]
pub struct Grid(Arc<Variant>);

impl Grid {
    /// Compiles the shaders of a variant on a device.
    ///
    /// # Errors
    /// When an option is out of range, or the device rejects a shader.
    pub fn new(gpu: Arc<Gpu>, options: GridOptions) -> Result<Self, GridError> {
        options.check()?;
        Ok(Self(Arc::new(Variant {
            kernels: Kernels::new(&gpu, &options)?,
            gpu,
            options,
        })))
    }

    /// The options of the variant.
    pub fn options(&self) -> GridOptions {
        self.0.options
    }
}

impl Method for Grid {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "Thesis 4.3: tests each pixel against the lines of its grid cell; one color",
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
