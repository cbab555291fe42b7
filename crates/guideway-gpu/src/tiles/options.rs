//! Options of method `gpu`, and the state that all of its scenes share.

use std::sync::{Arc, OnceLock};

use super::kernels::Kernels;
use crate::device::{DeviceError, Gpu, Kernel};

/// Name of the method.
pub(crate) const NAME: &str = "gpu";

/// Variants of the method, for comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TilesOptions {
    /// Reuses lines and finished pixels of earlier frames where they are still valid.
    pub reuses_frames: bool,
    /// Times each stage of a frame by the device's clock. The device stops between stages, so
    /// frames take longer.
    pub times_stages: bool,
}

impl Default for TilesOptions {
    fn default() -> Self {
        Self {
            reuses_frames: true,
            times_stages: false,
        }
    }
}

/// State that all prepared scenes share.
pub(crate) struct Shared {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) kernels: Arc<Kernels>,
    /// Compiled when work is first counted.
    counting_kernels: OnceLock<Result<Arc<Kernels>, DeviceError>>,
    /// Compiled when a gesture first turns, mirrors or scales paths.
    mapping_kernels: OnceLock<Result<Arc<Kernels>, DeviceError>>,
    /// Compiled when a picture first stays on the device.
    presenting_kernel: OnceLock<Result<Kernel, DeviceError>>,
    pub(crate) options: TilesOptions,
}

impl Shared {
    pub(crate) fn new(gpu: Arc<Gpu>, options: TilesOptions) -> Result<Self, DeviceError> {
        Ok(Self {
            kernels: Arc::new(Kernels::new(&gpu)?),
            counting_kernels: OnceLock::new(),
            mapping_kernels: OnceLock::new(),
            presenting_kernel: OnceLock::new(),
            gpu,
            options,
        })
    }

    /// Kernels that count their work.
    pub(crate) fn counting_kernels(&self) -> Result<Arc<Kernels>, DeviceError> {
        let kernels = self
            .counting_kernels
            .get_or_init(|| self.kernels.counting(&self.gpu).map(Arc::new));
        kernels.clone()
    }

    /// Kernels for gestures that turn, mirror or scale paths.
    pub(crate) fn mapping_kernels(&self) -> Result<Arc<Kernels>, DeviceError> {
        let kernels = self
            .mapping_kernels
            .get_or_init(|| self.kernels.mapping(&self.gpu).map(Arc::new));
        kernels.clone()
    }

    /// The kernel that writes a picture to a texture.
    pub(crate) fn presenting_kernel(&self) -> Result<Kernel, DeviceError> {
        let kernel = self
            .presenting_kernel
            .get_or_init(|| Kernels::presenting(&self.gpu));
        kernel.clone()
    }
}
