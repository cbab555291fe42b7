//! The window's handle of one render thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError};
use std::thread::JoinHandle;

use guideway_scene::{Coloring, Gesture, Scene};

use super::queue::{RenderQueue, SceneUpdate};
use super::request::RenderRequest;
use super::window_device::WindowDevice;
use super::worker::{RenderEvent, spawn};
use crate::background::RepaintHandle;
use crate::services::AppServices;

/// Renders one scene: always the newest request, and that again after every change of the scene.
pub(crate) struct Renderer {
    queue: RenderQueue,
    events: Receiver<RenderEvent>,
    thread: Option<JoinHandle<()>>,
}

impl Renderer {
    /// Starts a render thread, which waits for a scene.
    pub(crate) fn start(
        services: Arc<dyn AppServices>,
        method: &str,
        repaint: RepaintHandle,
        device: WindowDevice,
    ) -> Self {
        let queue = RenderQueue::default();
        let (events, thread) = spawn(&queue, services, method, repaint, device);
        Self {
            queue,
            events,
            thread,
        }
    }

    /// Replaces a thread that panicked; the new one has no scene yet.
    pub(super) fn restart(
        &mut self,
        services: Arc<dyn AppServices>,
        method: &str,
        repaint: RepaintHandle,
        device: WindowDevice,
    ) {
        self.queue.reset();
        let (events, thread) = spawn(&self.queue, services, method, repaint, device);
        (self.events, self.thread) = (events, thread);
    }

    /// A queue that accepts edits from any thread.
    pub(super) fn queue(&self) -> RenderQueue {
        self.queue.clone()
    }

    /// Replaces the scene.
    pub(crate) fn set_scene(&self, scene: Arc<Scene>) {
        self.queue.update(SceneUpdate::Scene(scene));
    }

    /// Gives the scene other colors.
    pub(super) fn recolor(&self, coloring: Arc<Coloring>) {
        self.queue.update(SceneUpdate::Coloring(coloring));
    }

    /// Shows a gesture, or the scene without one.
    pub(super) fn show_gesture(&self, gesture: Option<Gesture>) {
        self.queue.show_gesture(gesture);
    }

    /// Replaces the render method.
    pub(super) fn set_method(&self, name: &str) {
        self.queue.update(SceneUpdate::Method(name.to_owned()));
    }

    /// Requests a picture, in place of a waiting request.
    pub(crate) fn request(&self, request: RenderRequest) {
        self.queue.request(request);
    }

    /// Returns `true` if updates or requests are pending or in progress.
    pub(super) fn is_busy(&self) -> bool {
        self.queue.is_busy()
    }

    /// The next event.
    ///
    /// # Errors
    /// `Empty` when there is none, `Disconnected` when the thread panicked.
    pub(crate) fn try_event(&self) -> Result<RenderEvent, TryRecvError> {
        self.events.try_recv()
    }
}

impl Drop for Renderer {
    fn drop(&mut self) {
        self.queue.close();
        if let Some(thread) = self.thread.take() {
            // A graphics driver must finish before the process ends. A panic was reported already.
            let _ = thread.join();
        }
    }
}
