//! The floor plan: reads it once and renders it for every view.

use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{Context, TextureHandle};
use guideway_compose::{ComposeError, FloorPlan, PreparedFloorPlan};
use guideway_layout::UserError;
use guideway_scene::{Budget, Frame, Rgba, Strip, View};
use guideway_spline::Bounds;

use crate::background::{BackgroundTask, RepaintHandle};
use crate::render_queue::BackgroundPicture;
use crate::services::AppServices;

/// A floor plan that stays prepared, to be rendered at every change of the view.
struct ReadyPlan {
    plan: FloorPlan,
    prepared: Mutex<PreparedFloorPlan>,
}

impl ReadyPlan {
    fn new(plan: FloorPlan) -> Result<Self, ComposeError> {
        Ok(Self {
            prepared: Mutex::new(plan.prepare(&Budget::default())?),
            plan,
        })
    }

    /// Renders the plan on a transparent background.
    fn draw(&self, view: &View) -> Result<Frame, UserError> {
        let mut frame = Frame::new(view.size());
        let mut prepared = self.prepared.lock().unwrap_or_else(PoisonError::into_inner);
        prepared.render(&Strip::whole(view), Rgba::from_u32(0), &mut frame)?;
        Ok(frame)
    }
}

/// The floor plan, if there is one.
#[derive(Default)]
pub(crate) struct FloorPlanLayer {
    /// File and placement as typed; empty without a plan.
    text: String,
    pub(crate) is_visible: bool,
    reading: Option<BackgroundTask<Result<ReadyPlan, UserError>>>,
    ready: Option<Arc<ReadyPlan>>,
    read_error: Option<String>,
    picture: BackgroundPicture<()>,
}

impl FloorPlanLayer {
    /// File and placement as typed; empty without a plan.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Starts to read another plan; an empty text removes the present one.
    pub(crate) fn set(
        &mut self,
        text: &str,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        *self = Self::default();
        let text = text.trim();
        if text.is_empty() {
            return;
        }
        self.text = text.to_owned();
        self.is_visible = true;
        let (services, text) = (Arc::clone(services), self.text.clone());
        let read = move || Ok(ReadyPlan::new(services.read_floor_plan(&text)?)?);
        self.reading = Some(BackgroundTask::start(repaint, read));
    }

    /// Returns `true` if the plan is being read.
    pub(crate) fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// Why the plan cannot be read or rendered.
    pub(crate) fn error(&self) -> Option<&str> {
        self.read_error.as_deref().or(self.picture.error())
    }

    /// The plan, if it is read and visible.
    pub(crate) fn visible(&self) -> Option<&FloorPlan> {
        self.visible_ready().map(|ready| &ready.plan)
    }

    fn visible_ready(&self) -> Option<&Arc<ReadyPlan>> {
        self.ready.as_ref().filter(|_| self.is_visible)
    }

    /// The last picture and its view.
    pub(crate) fn shown(&self) -> Option<(&TextureHandle, &View)> {
        self.picture.shown()
    }

    /// Takes finished tasks. Returns the bounds of a plan that was just read.
    pub(crate) fn poll(&mut self, ctx: &Context) -> Option<Bounds<f64>> {
        self.picture.poll(ctx, "floor plan");
        let result = self.reading.as_ref().and_then(BackgroundTask::result)?;
        self.reading = None;
        match result.flatten() {
            Ok(ready) => self.ready.insert(Arc::new(ready)).plan.bounds(),
            Err(error) => {
                self.read_error = Some(error.to_string());
                None
            }
        }
    }

    /// Requests the picture of a view, unless it is there or in progress.
    pub(crate) fn request(&mut self, view: &View, repaint: &RepaintHandle) {
        let Some(ready) = self.visible_ready() else {
            self.picture.clear();
            return;
        };
        if self.picture.needs(&(), view) {
            let (ready, view) = (Arc::clone(ready), *view);
            let draw = move || ready.draw(&view);
            self.picture.start((), view, repaint, draw);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use super::*;
    use crate::tests::services::TestServices;

    fn read(text: &str) -> (FloorPlanLayer, Option<Bounds<f64>>) {
        let services: Arc<dyn AppServices> = TestServices::with([]);
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut layer = FloorPlanLayer::default();
        layer.set(text, &services, &repaint);
        let mut bounds = None;
        for _ in 0..5_000 {
            bounds = bounds.or(layer.poll(&Context::default()));
            if !layer.is_reading() {
                break;
            }
            thread::sleep(Duration::from_millis(1));
        }
        (layer, bounds)
    }

    #[test]
    fn reports_bounds_of_a_plan_and_hides_it() {
        let (mut layer, bounds) = read(" hall.png@px-per-m=20 ");
        assert!(bounds.is_some() && layer.visible().is_some());
        layer.is_visible = false;
        assert!(layer.visible().is_none() && layer.error().is_none());
    }

    #[test]
    fn keeps_the_error_of_an_unreadable_plan() {
        let (layer, bounds) = read("hall.bmp");
        assert!(bounds.is_none() && layer.error().is_some());
    }
}
