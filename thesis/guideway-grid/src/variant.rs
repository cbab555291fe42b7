//! A variant of the method on a device: the options and compiled shaders that its scenes share.

use std::sync::Arc;

use guideway_gpu::Gpu;
use guideway_scene::RenderError;

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

/// The error for input that the method cannot draw, with a sentence that says what to do instead.
pub(super) fn unsupported(what: impl Into<String>, remedy: &str) -> RenderError {
    RenderError::Unsupported {
        method: NAME,
        what: what.into(),
        remedy: remedy.to_owned(),
    }
}
