//! Method `tessellation`: the thesis' first method (4.2), by OpenGL's tessellation stages and without a
//! window. docs/method-tessellation.md says how it works and what it cannot do.

mod device;
mod options;
mod sys;
mod tessellation;
mod worker;

pub use device::GlDevice;
pub use options::{Antialias, Commands, TessellationOptions};
pub use tessellation::Tessellation;
