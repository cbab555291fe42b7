//! The render method `gpu`.

use std::sync::Arc;

use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError, Scene};

use super::options::{NAME, Shared, TilesOptions};
use super::prepared::PreparedTiles;
use crate::device::{DeviceError, Gpu};

/// The method `gpu`: compute shaders through wgpu. It prepares nothing but packed control points.
#[derive(Clone)]
pub struct Tiles(pub(super) Arc<Shared>);

impl Tiles {
    /// Compiles the method's shaders on a device.
    ///
    /// # Errors
    /// [`DeviceError::Shader`] if the driver rejects a shader; any error of the device.
    pub fn new(gpu: Arc<Gpu>, options: TilesOptions) -> Result<Self, DeviceError> {
        Ok(Self(Arc::new(Shared::new(gpu, options)?)))
    }
}

impl Method for Tiles {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "Renders each frame from the control points by compute shaders: 16 px tiles, \
                      64 samples per pixel",
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
