//! The render methods of this build, by name.
//!
//! | module | purpose |
//! |---|---|
//! | `entry` | the description of one method |
//! | `gpu`, `tessellation` | the methods on graphics devices |
//! | `absent` | what stands in for them in builds without |
//! | `registry` | the list of all methods; starts one by its name and options |

#[cfg(not(all(feature = "gl", feature = "gpu")))]
mod absent;
mod entry;
#[cfg(feature = "gpu")]
mod gpu;
mod registry;
#[cfg(feature = "gl")]
mod tessellation;

pub use entry::MethodOption;
#[cfg(feature = "gpu")]
pub use gpu::share_device;
pub use registry::{
    AUTO, Available, MethodError, device_limits, graphics_adapters, live_method, method,
    method_names, methods,
};
