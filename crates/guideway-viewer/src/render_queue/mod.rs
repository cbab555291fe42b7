//! Renders pictures on other threads, so that the window never waits for one.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | request | view, style | the newest [`RenderRequest`] | `queue` |
//! | update | scene, edit, method | state of the worker | `queue`, `worker` |
//! | render | request | [`Picture`] or another [`RenderEvent`] | `worker` |
//! | display | picture | texture and report | `layer_picture`, `background_picture` |
//!
//! A method that draws on the device of the window leaves its pictures there (`window_device`).

mod background_picture;
mod layer_picture;
mod method_selection;
mod queue;
mod renderer;
mod request;
mod window_device;
mod worker;

pub(crate) use background_picture::{BackgroundPicture, color_image};
pub(crate) use layer_picture::{LayerPicture, PictureEvent};
pub(crate) use method_selection::{FALLBACK_METHOD, MethodSelection};
#[cfg(test)]
pub(crate) use renderer::Renderer;
pub(crate) use request::RenderRequest;
pub(crate) use window_device::WindowDevice;
#[cfg(test)]
pub(crate) use worker::{Pixels, RenderEvent};
