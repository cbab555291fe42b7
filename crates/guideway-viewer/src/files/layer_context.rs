//! The connections of an open file to the program: services and the window.

use std::sync::Arc;

use crate::background::RepaintHandle;
use crate::services::AppServices;

/// Files, render methods and the handle that wakes the window.
#[derive(Clone)]
pub(crate) struct LayerContext {
    pub(crate) services: Arc<dyn AppServices>,
    pub(crate) repaint: RepaintHandle,
}
