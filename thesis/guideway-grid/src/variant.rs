//! A variant of the method on a device: the options and compiled shaders that its scenes share.

use std::sync::Arc;

use guideway_gpu::Gpu;

use crate::kernels::Kernels;
use crate::options::GridOptions;

/// Name of the method in reports and errors.
pub(super) const NAME: &str = "grid";

/// The device, options and shaders that all scenes of one variant share.
pub(super) struct Variant {
    pub(super) gpu: Arc<Gpu>,
    pub(super) options: GridOptions,
    pub(super) kernels: Kernels,
}
