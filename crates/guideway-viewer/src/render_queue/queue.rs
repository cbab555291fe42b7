//! The queue between the window and a render thread.
//!
//! Scene updates are applied in order and never dropped; only the newest request is kept. An
//! update cancels the picture in progress, as it would show an outdated scene.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use guideway_document::SceneChange;
use guideway_scene::{Cancel, Coloring, Edit, Gesture, Scene};

use super::RenderRequest;

/// Sends updates and requests to a render thread, from any thread.
#[derive(Clone, Default)]
pub(crate) struct RenderQueue(Arc<Shared>);

#[derive(Default)]
struct Shared {
    mailbox: Mutex<Mailbox>,
    condvar: Condvar,
}

#[derive(Default)]
struct Mailbox {
    updates: Vec<SceneUpdate>,
    next: Option<RenderRequest>,
    /// The last request, which repeats after every update.
    last: Option<RenderRequest>,
    /// The request in progress and its cancel flag.
    current: Option<(RenderRequest, Cancel)>,
    is_closed: bool,
}

/// A change of what or how the worker renders.
pub(super) enum SceneUpdate {
    Scene(Arc<Scene>),
    Edit(Edit),
    Coloring(Arc<Coloring>),
    /// A gesture to show, or its end. Only the newest of several in a row counts.
    Gesture(Option<Gesture>),
    Method(String),
}

/// The next work of the render thread.
pub(super) struct RenderJob {
    pub(super) updates: Vec<SceneUpdate>,
    pub(super) request: Option<(RenderRequest, Cancel)>,
}

impl RenderQueue {
    /// Requests a picture in place of a waiting request. The picture in progress continues if it
    /// covers enough of the new one.
    pub(super) fn request(&self, request: RenderRequest) {
        let mut mailbox = self.lock();
        if let Some((current, cancel)) = &mailbox.current
            && !current.covers_half_of(&request)
        {
            cancel.set();
        }
        (mailbox.next, mailbox.last) = (Some(request), Some(request));
        drop(mailbox);
        self.0.condvar.notify_one();
    }

    /// Applies a change of a document to the worker's scene.
    pub(crate) fn change(&self, change: SceneChange<'_>) {
        self.update(match change {
            SceneChange::Edit(edit) => SceneUpdate::Edit(edit.clone()),
            SceneChange::Replaced(scene) => SceneUpdate::Scene(Arc::new(scene.clone())),
        });
    }

    /// Shows a gesture, or the scene without one, and repeats the last request. The picture in
    /// progress continues: while a drag goes on, each would be canceled.
    pub(super) fn show_gesture(&self, gesture: Option<Gesture>) {
        let mut mailbox = self.lock();
        let gesture = SceneUpdate::Gesture(gesture);
        match mailbox.updates.last_mut() {
            Some(last @ SceneUpdate::Gesture(_)) => *last = gesture,
            _ => mailbox.updates.push(gesture),
        }
        mailbox.next = mailbox.last;
        drop(mailbox);
        self.0.condvar.notify_one();
    }

    /// Applies an update and repeats the last request.
    pub(super) fn update(&self, update: SceneUpdate) {
        let mut mailbox = self.lock();
        if let Some((_, cancel)) = &mailbox.current {
            cancel.set();
        }
        mailbox.updates.push(update);
        mailbox.next = mailbox.last;
        drop(mailbox);
        self.0.condvar.notify_one();
    }

    /// Returns `true` if updates or requests are pending or in progress.
    pub(super) fn is_busy(&self) -> bool {
        let mailbox = self.lock();
        mailbox.next.is_some() || mailbox.current.is_some() || !mailbox.updates.is_empty()
    }

    /// Drops all updates and repeats the last request, for a new worker without a scene.
    pub(super) fn reset(&self) {
        let mut mailbox = self.lock();
        mailbox.updates.clear();
        mailbox.current = None;
        mailbox.next = mailbox.last;
    }

    /// Ends the worker: cancels the picture in progress and lets [`Self::next_job`] return `None`.
    pub(super) fn close(&self) {
        let mut mailbox = self.lock();
        mailbox.is_closed = true;
        if let Some((_, cancel)) = &mailbox.current {
            cancel.set();
        }
        drop(mailbox);
        self.0.condvar.notify_one();
    }

    /// Blocks until there is work; `None` once the queue is closed.
    pub(super) fn next_job(&self) -> Option<RenderJob> {
        let mut mailbox = self.lock();
        mailbox.current = None;
        while !mailbox.is_closed && mailbox.updates.is_empty() && mailbox.next.is_none() {
            let wait = self.0.condvar.wait(mailbox);
            mailbox = wait.unwrap_or_else(PoisonError::into_inner);
        }
        if mailbox.is_closed {
            return None;
        }
        let request = mailbox.next.take();
        mailbox.current = request.map(|request| (request, Cancel::default()));
        Some(RenderJob {
            updates: std::mem::take(&mut mailbox.updates),
            request: mailbox.current.clone(),
        })
    }

    fn lock(&self) -> MutexGuard<'_, Mailbox> {
        // Every method leaves the mailbox consistent, so a poisoned lock is usable.
        self.0
            .mailbox
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::{FrameSize, Style, View};
    use guideway_spline::{Affine, Point};

    use super::*;

    fn request(x_m: f64) -> RenderRequest {
        let size = FrameSize::new(100, 100).unwrap();
        let view = View::new(size, Point::new(x_m, 0.0), 10.0).unwrap();
        let style = Style::default();
        RenderRequest { view, style }
    }

    #[test]
    fn keeps_the_newest_request_only() {
        let queue = RenderQueue::default();
        queue.request(request(0.0));
        queue.request(request(1.0));
        let job = queue.next_job().unwrap();
        assert_eq!(job.request.map(|(request, _)| request), Some(request(1.0)));
        assert!(queue.is_busy(), "the request is in progress");
    }

    #[test]
    fn cancels_a_picture_that_covers_less_than_half_of_the_next() {
        let queue = RenderQueue::default();
        queue.request(request(0.0));
        let (_, cancel) = queue.next_job().unwrap().request.unwrap();
        queue.request(request(4.0));
        assert!(cancel.check().is_ok());
        queue.request(request(6.0));
        assert!(cancel.check().is_err());
    }

    #[test]
    fn update_cancels_the_picture_and_repeats_the_request() {
        let queue = RenderQueue::default();
        queue.request(request(0.0));
        let (_, cancel) = queue.next_job().unwrap().request.unwrap();
        queue.update(SceneUpdate::Method("cpu".into()));
        assert!(cancel.check().is_err());
        let job = queue.next_job().unwrap();
        assert_eq!((job.updates.len(), job.request.is_some()), (1, true));
    }

    #[test]
    fn keeps_the_newest_map_of_a_gesture_and_cancels_nothing() {
        let queue = RenderQueue::default();
        queue.request(request(0.0));
        let (_, cancel) = queue.next_job().unwrap().request.unwrap();
        let gesture = |x_m: f64| Gesture {
            paths: [1].into(),
            by: Affine::translation(Point::new(x_m, 0.0)),
        };
        queue.show_gesture(Some(gesture(1.0)));
        queue.show_gesture(Some(gesture(2.0)));
        assert!(cancel.check().is_ok());
        let job = queue.next_job().unwrap();
        let [SceneUpdate::Gesture(shown)] = &job.updates[..] else {
            panic!("{} updates", job.updates.len());
        };
        assert_eq!((shown, job.request.is_some()), (&Some(gesture(2.0)), true));
    }

    #[test]
    fn closed_queue_has_no_job() {
        let queue = RenderQueue::default();
        queue.request(request(0.0));
        queue.close();
        assert!(queue.next_job().is_none());
    }
}
