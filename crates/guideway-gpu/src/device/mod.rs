//! The graphics device: opened once, shared by methods, with typed errors for every operation.
//!
//! | file | content |
//! |---|---|
//! | `adapter`, `options` | the adapters and their rank; opens one, with artificial limits for tests |
//! | `choice` | the best adapter that passes a trial |
//! | `gpu` | [`Gpu`]: the open device, its limits and its error scopes |
//! | `kernel` | [`Source`], [`Kernel`], [`Bindings`]: compute pipelines |
//! | `memory` | [`Memory`], [`DeviceBuffer`]: buffers charged to the memory budget of a method |
//! | `runner`, `readback` | [`Runner`]: submits dispatches, times stages, reads buffers back |
//! | `writer` | copies lists to the device by all threads |
//! | `patch`, `patcher` | collects many small changes of a buffer; sends them in few submissions |
//! | `error` | [`DeviceError`] |

mod adapter;
mod choice;
mod error;
mod gpu;
mod kernel;
mod memory;
mod options;
mod patch;
mod patcher;
mod readback;
mod runner;
mod writer;

pub use adapter::adapters;
pub use error::DeviceError;
pub use gpu::Gpu;
pub use kernel::{Bindings, Kernel, Source};
pub use memory::{DeviceBuffer, Memory, Reservation};
pub use options::GpuOptions;
pub(crate) use patch::Patch;
pub(crate) use patcher::{PatchTarget, Patcher, SET_BIT, patch_kernel};
pub use readback::READBACK_USAGE;
pub use runner::{Dispatch, Runner};

#[cfg(test)]
pub(crate) use kernel::tests::kernels_beyond;

#[cfg(test)]
mod tests;

/// Opens an adapter as a caller does that shares its device.
#[cfg(test)]
pub(crate) fn open_for_tests() -> Result<(wgpu::Adapter, wgpu::Device, wgpu::Queue), DeviceError> {
    adapter::with_adapters(|mut adapters| {
        adapters.sort_by_key(|adapter| adapter::preference(&adapter.get_info()));
        let adapter = adapters.into_iter().next().ok_or(DeviceError::NoAdapter)?;
        match adapter::open(&adapter, GpuOptions::default()) {
            Ok((device, queue)) => Ok((adapter, device, queue)),
            Err(reasons) => Err(DeviceError::NotOpened { reasons }),
        }
    })
}
