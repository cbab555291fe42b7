//! Method `tessellation` (thesis 4.2): draws curves with the tessellation stages of OpenGL, without
//! a window.
//!
//! | module | content |
//! |---|---|
//! | `options` | the options after the method's name |
//! | `device` | the search for an OpenGL device |
//! | `worker` | a thread that owns an OpenGL context |
//! | `sys` | safe wrappers of EGL and OpenGL |
//! | `tessellation` | the method: plan, cull, tessellate, read back |
//!
//! The user documentation is in docs/methods.md.

mod device;
mod error;
mod options;
mod sys;
mod tessellation;
mod worker;

pub use device::GlDevice;
pub use error::GlError;
pub use options::{Antialias, Commands, TessellationOptions, UnknownOption};
pub use tessellation::Tessellation;
