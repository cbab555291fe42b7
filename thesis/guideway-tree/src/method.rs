//! The entry of the methods: compiles a variant on a device and prepares scenes for it.

use std::sync::Arc;

use guideway_gpu::{DeviceError, Gpu};
use guideway_scene::{Budget, Method, MethodInfo, Prepared, RenderError, Scene};

use crate::options::{OptionsError, Structure, TreeOptions};
use crate::params::{Kernels, Variant};
use crate::prepared::PreparedTrees;

/// The reason why [`Trees::new`] failed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// An option is out of range.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The device failed, or rejected a shader.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// The methods `tree` and `quadtree`: compute shaders through wgpu.
///
/// They draw opaque paths of one width; of several colors with 32 samples per pixel. Reports count
/// every path as drawn, because the methods cull segments per pixel and never paths.
#[derive(Clone)]
pub struct Trees(Arc<Variant>);

impl Trees {
    /// Compiles the shaders of a variant on a device.
    ///
    /// # Errors
    /// When an option is out of range, or the device rejects a shader.
    pub fn new(
        gpu: Arc<Gpu>,
        structure: Structure,
        options: TreeOptions,
    ) -> Result<Self, TreeError> {
        options.check()?;
        Ok(Self(Arc::new(Variant {
            kernels: Kernels::new(&gpu, structure, &options)?,
            gpu,
            structure,
            options,
        })))
    }
}

impl Method for Trees {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: self.0.structure.name(),
            summary: match self.0.structure {
                Structure::Tree => {
                    "Thesis 6.1.1: tests each pixel against the lines of an AABB tree"
                }
                Structure::Quadtree => {
                    "Thesis 6.3: as `tree`, by a linear quadtree that each frame builds"
                }
            },
            device: self.0.gpu.adapter_name(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let variant = Arc::clone(&self.0);
        Ok(Box::new(PreparedTrees::new(variant, scene, budget)?))
    }
}
