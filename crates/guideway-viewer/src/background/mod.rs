//! Work on other threads: one task with one result, and the handle that wakes the window.

mod repaint_handle;
mod task;

pub(crate) use repaint_handle::RepaintHandle;
pub(crate) use task::BackgroundTask;
