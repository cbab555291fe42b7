//! Render methods on graphics devices, by compute shaders through wgpu.
//!
//! [`Gpu`] is the device, shared by methods; [`device`] has the buffers, kernels and submissions that a
//! method is made of. [`Tiles`] is method `gpu`.

pub mod device;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
mod tiles;

pub use device::{Gpu, GpuOptions};
pub use tiles::{Tiles, TilesOptions};
