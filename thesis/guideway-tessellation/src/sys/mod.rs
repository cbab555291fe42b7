//! The only module that calls EGL and OpenGL. Everything that it hands out is safe to use:
//!
//! - A [`Gl`] cannot leave the thread on which its context was made current, no second one can be made on
//!   that thread meanwhile, and every object holds on to its [`Gl`]. So a name is never used in another
//!   context than its own, nor after it.
//! - Host memory reaches a call only as a slice whose length is checked here against what the call reads
//!   or writes.
//! - A draw or a dispatch reads and writes device memory by indices that this crate's own planning made,
//!   out of buffers of the sizes that it planned.
#![allow(
    unsafe_code,
    reason = "EGL and OpenGL are C interfaces; the rules above keep their use within this module"
)]

mod buffer;
mod egl;
mod gl;
mod program;
#[cfg(test)]
pub(crate) mod reflect;
mod target;
mod time;

pub(crate) use buffer::Buffer;
pub(crate) use egl::{Platform, platforms};
pub(crate) use gl::{Gl, Limits, Primitives};
pub(crate) use program::{Program, ShaderStage, Vertices};
pub(crate) use target::Target;
pub(crate) use time::Timeline;
