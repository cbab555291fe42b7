//! The render thread: applies updates to its scene and renders the newest request.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread::JoinHandle;
use std::time::Instant;

use eframe::egui::ColorImage;
use guideway_compose::is_crowd;
use guideway_layout::UserError;
use guideway_scene::{
    Budget, Cancel, DevicePicture, EditOutcome, Frame, Method, Prepared, RenderError, Report, Rgba,
    Scene, Shading, elapsed_ms,
};

use super::background_picture::color_image;
use super::method_selection::FALLBACK_METHOD;
use super::queue::{RenderJob, RenderQueue, SceneUpdate};
use super::request::RenderRequest;
use super::window_device::WindowDevice;
use crate::background::RepaintHandle;
use crate::language::{say, start_thread};
use crate::services::AppServices;

/// A message from the render thread to the window.
pub(crate) enum RenderEvent {
    Picture(Box<Picture>),
    /// The worker lost its scene and needs the current one.
    NeedsScene,
    /// The method failed and [`FALLBACK_METHOD`] replaces it; the reason as a sentence.
    FellBack(String),
    /// The request has no picture; the reason.
    Failed(String),
    /// The first picture of all paths is a crowd, whose density says more than their colors.
    Crowded,
}

/// A finished picture.
pub(crate) struct Picture {
    pub(crate) request: RenderRequest,
    pub(crate) pixels: Pixels,
    pub(crate) report: Report,
    /// Milliseconds from the start of the request to the finished picture.
    pub(crate) wall_ms: f64,
}

/// The pixels of a picture.
pub(crate) enum Pixels {
    InMemory(ColorImage),
    /// A texture of the window's device.
    OnDevice(DevicePicture),
}

/// Starts a render thread without a scene.
pub(super) fn spawn(
    queue: &RenderQueue,
    services: Arc<dyn AppServices>,
    method: &str,
    repaint: RepaintHandle,
    device: WindowDevice,
) -> (Receiver<RenderEvent>, Option<JoinHandle<()>>) {
    let (sender, events) = mpsc::channel();
    let mut worker = Worker {
        services,
        queue: queue.clone(),
        events: sender,
        repaint,
        device,
        method_name: method.to_owned(),
        method: None,
        scene: None,
        prepared: None,
        // The window sends the first scene without a request.
        has_requested_scene: true,
        frame: None,
        last_picture: None,
        is_judged: false,
    };
    // Without a thread the sender is dropped, which the window reports.
    let thread = start_thread(move || worker.run());
    (events, thread.ok())
}

struct Worker {
    services: Arc<dyn AppServices>,
    queue: RenderQueue,
    events: Sender<RenderEvent>,
    repaint: RepaintHandle,
    device: WindowDevice,
    method_name: String,
    method: Option<Box<dyn Method>>,
    /// The scene until it is prepared. Afterwards the method owns it and edits it without a copy.
    scene: Option<Arc<Scene>>,
    prepared: Option<Box<dyn Prepared>>,
    /// True if a [`RenderEvent::NeedsScene`] is unanswered.
    has_requested_scene: bool,
    frame: Option<Frame>,
    /// The request of the last picture, if it was finished.
    last_picture: Option<RenderRequest>,
    /// True once a picture of all paths was examined for a crowd.
    is_judged: bool,
}

impl Worker {
    fn run(&mut self) {
        while let Some(RenderJob { updates, request }) = self.queue.next_job() {
            let mut is_changed = updates.is_empty();
            for update in updates {
                is_changed |= self.apply(update);
            }
            // A method that shows no gestures need not draw the same picture again.
            let is_new = |(request, _): &(RenderRequest, _)| {
                is_changed || self.last_picture != Some(*request)
            };
            if let Some((request, cancel)) = request.filter(is_new) {
                self.render(request, &cancel);
            }
        }
    }

    /// Returns `true` if the picture may have changed.
    fn apply(&mut self, update: SceneUpdate) -> bool {
        match update {
            SceneUpdate::Gesture(gesture) => {
                // The window shows an outline if the method shows no gesture, or refuses it; the
                // edit at its end tells why.
                let shown = self
                    .prepared
                    .as_mut()
                    .map(|p| p.show_gesture(gesture.as_ref()));
                return !matches!(shown, None | Some(Ok(EditOutcome::NotInPlace)));
            }
            SceneUpdate::Scene(scene) => {
                self.scene = Some(scene);
                self.prepared = None;
                self.has_requested_scene = false;
            }
            SceneUpdate::Edit(edit) => {
                let is_applied = match (&mut self.prepared, &mut self.scene) {
                    (Some(prepared), _) => {
                        matches!(prepared.edit(&edit), Ok(EditOutcome::InPlace { .. }))
                    }
                    (None, Some(scene)) => Arc::make_mut(scene).edit(&edit).is_ok(),
                    (None, None) => false,
                };
                self.forget_unless(is_applied);
            }
            SceneUpdate::Coloring(coloring) => {
                let is_applied = match (&mut self.prepared, &mut self.scene) {
                    (Some(prepared), _) => {
                        matches!(prepared.recolor(&coloring), Ok(EditOutcome::InPlace { .. }))
                    }
                    (None, Some(scene)) if scene.accepts(&coloring) => {
                        Arc::make_mut(scene).recolor(&coloring);
                        true
                    }
                    _ => false,
                };
                self.forget_unless(is_applied);
            }
            SceneUpdate::Method(name) => {
                self.method_name = name;
                self.method = None;
                self.prepared = None;
            }
        }
        true
    }

    /// Forgets a scene that has not taken a change: the next request asks the window for the
    /// current one.
    fn forget_unless(&mut self, is_applied: bool) {
        if !is_applied {
            self.prepared = None;
            self.scene = None;
        }
    }

    fn render(&mut self, request: RenderRequest, cancel: &Cancel) {
        let started = Instant::now();
        match self.picture(&request, cancel, started) {
            Ok(picture) => {
                let (culled, drawn) = (picture.report.culled, picture.report.drawn);
                let has_pixels = matches!(picture.pixels, Pixels::InMemory(_));
                self.send(RenderEvent::Picture(Box::new(picture)));
                if culled == 0 && has_pixels && request.style.shading == Shading::Color {
                    self.judge(request.style.background, drawn);
                }
            }
            Err(Stop::NoScene) if self.has_requested_scene => {}
            Err(Stop::NoScene) => {
                self.has_requested_scene = true;
                self.send(RenderEvent::NeedsScene);
            }
            Err(Stop::Render(RenderError::Cancelled)) => {}
            Err(Stop::Method(error)) => self.fall_back(&request, cancel, &error.to_string()),
            Err(Stop::Render(error @ RenderError::Device { .. })) => {
                self.fall_back(&request, cancel, &error.to_string());
            }
            Err(Stop::Render(error)) => self.send(RenderEvent::Failed(error.to_string())),
        }
    }

    /// Reports a crowd in the first picture of all paths, once the window has it.
    fn judge(&mut self, background: Rgba, drawn: u64) {
        if std::mem::replace(&mut self.is_judged, true) {
            return;
        }
        let mut frame = self.frame.iter();
        if frame.any(|frame| is_crowd(frame, background, drawn)) {
            self.send(RenderEvent::Crowded);
        }
    }

    /// Switches to the method that runs on every computer and renders again.
    fn fall_back(&mut self, request: &RenderRequest, cancel: &Cancel, why: &str) {
        if self.method_name == FALLBACK_METHOD {
            self.send(RenderEvent::Failed(why.to_owned()));
            return;
        }
        let name = &self.method_name;
        let notice = say!(
            "method `{name}` failed: {why}. Switched to `{other}`",
            name,
            why,
            other = FALLBACK_METHOD
        );
        self.send(RenderEvent::FellBack(notice));
        self.apply(SceneUpdate::Method(FALLBACK_METHOD.to_owned()));
        self.render(*request, cancel);
    }

    fn picture(
        &mut self,
        request: &RenderRequest,
        cancel: &Cancel,
        started: Instant,
    ) -> Result<Picture, Stop> {
        let prepared = match &mut self.prepared {
            Some(prepared) => prepared,
            none => {
                let method = match &self.method {
                    Some(method) => method,
                    None => {
                        let method = self.services.start_method(&self.method_name)?;
                        self.method.insert(method)
                    }
                };
                let scene = self.scene.take().ok_or(Stop::NoScene)?;
                none.insert(method.prepare(scene, &Budget::default())?)
            }
        };
        let (view, style) = (&request.view, &request.style);
        self.last_picture = None;
        let on_device = if self.device.is_of(&**prepared) {
            prepared.render_on_device(view, style, cancel)?
        } else {
            None
        };
        let (pixels, report) = match on_device {
            Some((picture, report)) => (Pixels::OnDevice(picture), report),
            None => {
                let frame = self.frame.get_or_insert_with(|| Frame::new(view.size()));
                let report = prepared.render(view, style, cancel, frame)?;
                (Pixels::InMemory(color_image(frame)), report)
            }
        };
        self.last_picture = Some(*request);
        Ok(Picture {
            request: *request,
            pixels,
            report,
            wall_ms: elapsed_ms(started),
        })
    }

    fn send(&self, event: RenderEvent) {
        // The receiver is gone if the file was closed in the meantime.
        let _ = self.events.send(event);
        (self.repaint)();
    }
}

/// The reason for a request without a picture.
enum Stop {
    NoScene,
    Method(UserError),
    Render(RenderError),
}

impl From<UserError> for Stop {
    fn from(error: UserError) -> Self {
        Self::Method(error)
    }
}

impl From<RenderError> for Stop {
    fn from(error: RenderError) -> Self {
        Self::Render(error)
    }
}
