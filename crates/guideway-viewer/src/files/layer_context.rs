//! The connections of an open file to the program: services and the window.

use std::sync::Arc;

use crate::background::RepaintHandle;
use crate::render_queue::WindowDevice;
use crate::services::AppServices;

/// Files, render methods, the handle that wakes the window, and its graphics device.
#[derive(Clone)]
pub(crate) struct LayerContext {
    pub(crate) services: Arc<dyn AppServices>,
    pub(crate) repaint: RepaintHandle,
    pub(crate) device: WindowDevice,
}

impl LayerContext {
    /// The connections before the window is open.
    pub(crate) fn new(services: Arc<dyn AppServices>, repaint: RepaintHandle) -> Self {
        Self {
            services,
            repaint,
            device: WindowDevice::default(),
        }
    }
}
