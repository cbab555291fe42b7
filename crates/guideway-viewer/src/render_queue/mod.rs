//! Renders pictures on other threads, so that the window never waits for one.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | request | view, style | the newest [`RenderRequest`] | `queue` |
//! | update | scene, edit, method | state of the worker | `queue`, `worker` |
//! | render | request | [`Picture`] or another [`RenderEvent`] | `worker` |
//! | display | picture | texture and report | `layer_picture`, `background_picture` |

mod background_picture;
mod layer_picture;
mod method_selection;
mod queue;
mod renderer;
mod request;
mod worker;

pub(crate) use background_picture::{BackgroundPicture, color_image};
pub(crate) use layer_picture::{LayerPicture, PictureEvent};
pub(crate) use method_selection::{FALLBACK_METHOD, MethodSelection};
#[cfg(test)]
pub(crate) use renderer::Renderer;
pub(crate) use request::RenderRequest;
#[cfg(test)]
pub(crate) use worker::RenderEvent;
