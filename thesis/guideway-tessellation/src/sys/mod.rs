//! Safe wrappers of EGL and OpenGL. No other module calls them, and all public items are safe to
//! use:
//!
//! - A [`Gl`] cannot leave the thread of its context, a thread has at most one [`Gl`] at a time,
//!   and every object holds a reference to its [`Gl`]. So no object is used outside its context or
//!   after it.
//! - Host memory reaches a call only as a slice whose length this module checks against the bytes
//!   that the call reads or writes.
//! - Draws and dispatches access device memory by indices from the plan of this crate, within
//!   buffers of the planned sizes.
#![allow(
    unsafe_code,
    reason = "EGL and OpenGL are C interfaces; the rules above keep the calls within this module"
)]

mod buffer;
mod draw;
mod egl;
mod gl;
mod primitive_counter;
mod program;
#[cfg(test)]
pub(crate) mod reflect;
mod target;
mod timeline;

pub(crate) use buffer::Buffer;
pub(crate) use draw::{dispatch, draw_command, draw_commands};
pub(crate) use egl::{Platform, platforms};
pub(crate) use gl::{Gl, Limits};
pub(crate) use primitive_counter::PrimitiveCounter;
pub(crate) use program::{Program, ShaderStage, VertexArray};
pub(crate) use target::Target;
pub(crate) use timeline::Timeline;
