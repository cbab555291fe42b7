//! Render methods on graphics devices, by compute shaders through wgpu.
//!
//! [`Gpu`] is the device, to be shared by methods. [`Tiles`] is method `gpu`, [`Grid`] the per-pixel method of the thesis
//! (section 4.3), with the improvements that it names as options.

mod device;
mod grid;
#[cfg(test)]
mod reflection;
#[cfg(test)]
mod testing;
mod tiles;

pub use device::{Gpu, GpuOptions};
pub use grid::{Antialias, Binning, Grid, GridOptions, PrefixSum};
pub use tiles::{Tiles, TilesOptions};
