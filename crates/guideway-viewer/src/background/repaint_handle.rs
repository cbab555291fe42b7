//! The handle by which worker threads wake the window.

use std::sync::Arc;

/// Requests a frame from the window; callable from any thread.
pub(crate) type RepaintHandle = Arc<dyn Fn() + Send + Sync>;
