//! Method `gpu`: renders paths by compute shaders through wgpu.
//!
//! [`Gpu`] is the open device, shared by methods; [`device`] has the buffers, kernels and
//! submissions that methods are built from. [`Tiles`] is the method.

pub mod device;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod tiles;

pub use device::{DeviceError, Gpu, GpuOptions, adapters};
pub use tiles::{Tiles, TilesOptions};
