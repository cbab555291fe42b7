//! The floor plan: reads it once and renders it for every view.

use std::sync::{Arc, Mutex, PoisonError};

use eframe::egui::{Context, TextureHandle};
use guideway_compose::{ComposeError, FloorPlan, PreparedFloorPlan};
use guideway_layout::UserError;
use guideway_scene::{Budget, Frame, Rgba, Strip, View};
use guideway_spline::{Bounds, Point};

use super::plan_placement::PlanPlacement;
use crate::background::{BackgroundTask, RepaintHandle};
use crate::render_queue::BackgroundPicture;
use crate::services::AppServices;

/// Part of its opacity that an image has on a dark background, where it would outshine names and
/// lines; paper is shown as its negative.
const DARK_IMAGE_OPACITY: f32 = 0.35;
const DARK_PAPER_OPACITY: f32 = 0.5;

/// A floor plan that stays prepared, to be rendered at every change of the view.
struct ReadyPlan {
    plan: FloorPlan,
    prepared: Mutex<PreparedFloorPlan>,
    /// The plan for a dark background, if it differs.
    dark: Option<Arc<ReadyPlan>>,
}

impl ReadyPlan {
    fn new(plan: FloorPlan) -> Result<Self, ComposeError> {
        Ok(Self {
            prepared: Mutex::new(plan.prepare(&Budget::default())?),
            dark: match plan.negative_of_paper() {
                Some(negative) => Some(Arc::new(Self {
                    prepared: Mutex::new(negative.prepare(&Budget::default())?),
                    plan: negative,
                    dark: None,
                })),
                None => None,
            },
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
pub(crate) struct FloorPlanLayer {
    /// File and placement as typed; empty without a plan.
    text: String,
    pub(crate) is_visible: bool,
    /// True if no click or drag moves or scales the plan.
    pub(crate) is_locked: bool,
    /// From 0 to 1.
    pub(crate) opacity: f32,
    /// Distance by which a drag has moved the plan that is shown, in meters.
    pub(crate) shift_m: Point<f64>,
    /// True if the plan that is being read is not one that was shown elsewhere.
    is_new: bool,
    reading: Option<BackgroundTask<Result<ReadyPlan, UserError>>>,
    ready: Option<Arc<ReadyPlan>>,
    read_error: Option<String>,
    /// The plan that this one replaces, until this one is read.
    before: Option<Box<FloorPlanLayer>>,
    /// True on a dark background.
    is_dark: bool,
    /// Its content is whether the background is dark.
    picture: BackgroundPicture<bool>,
}

impl Default for FloorPlanLayer {
    fn default() -> Self {
        Self {
            text: String::new(),
            is_visible: false,
            is_locked: false,
            opacity: 1.0,
            shift_m: Point::default(),
            is_new: true,
            reading: None,
            ready: None,
            read_error: None,
            before: None,
            is_dark: false,
            picture: BackgroundPicture::default(),
        }
    }
}

impl FloorPlanLayer {
    /// File and placement as typed; empty without a plan.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    /// Returns `true` if there is no plan.
    pub(crate) fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// Starts to read another plan; an empty text removes the present one.
    pub(crate) fn set(
        &mut self,
        text: &str,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        *self = Self {
            is_dark: self.is_dark,
            ..Self::default()
        };
        let text = text.trim();
        if text.is_empty() {
            return;
        }
        self.text = text.to_owned();
        self.is_visible = true;
        self.read(services, repaint);
    }

    /// Starts to read another plan, which takes the place of the present one if it can be read.
    pub(crate) fn replace(
        &mut self,
        text: &str,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        let is_dark = self.is_dark;
        let before = std::mem::take(self);
        self.is_dark = is_dark;
        self.set(text, services, repaint);
        // One that is still being read has shown nothing: the one before it stays.
        let shown = match before.ready {
            Some(_) => Some(Box::new(before)),
            None => before.before,
        };
        self.before = shown.filter(|_| !self.is_empty());
    }

    /// Shows the plan at another place. The old one stays until it is read anew; a plan that
    /// `is_new` there counts as read for the first time.
    pub(crate) fn place(
        &mut self,
        placement: &PlanPlacement,
        is_new: bool,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        self.text = placement.text();
        self.is_new = is_new || self.ready.is_none();
        self.read(services, repaint);
    }

    fn read(&mut self, services: &Arc<dyn AppServices>, repaint: &RepaintHandle) {
        let (services, text) = (Arc::clone(services), self.text.clone());
        let read = move || Ok(ReadyPlan::new(services.read_floor_plan(&text)?)?);
        self.reading = Some(BackgroundTask::start(repaint, read));
    }

    /// File and placement; `None` without a plan, or if its text is not understood.
    pub(crate) fn placement(&self) -> Option<PlanPlacement> {
        PlanPlacement::parse(&self.text).filter(|_| !self.is_empty())
    }

    /// Meters per unit of a drawing that does not state it, as its reader assumed.
    pub(crate) fn assumed_unit_m(&self) -> Option<f64> {
        self.ready.as_ref()?.plan.assumed_unit_m()
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
        let ready = self.ready.as_ref().filter(|_| self.is_visible)?;
        Some(
            ready
                .dark
                .as_ref()
                .filter(|_| self.is_dark)
                .unwrap_or(ready),
        )
    }

    /// The opacity with which the plan is drawn, from 0 to 1.
    pub(crate) fn drawn_opacity(&self) -> f32 {
        let is_paper = self
            .ready
            .as_ref()
            .is_some_and(|ready| ready.dark.is_some());
        let part = match self.visible() {
            Some(FloorPlan::Image(_)) if self.is_dark && is_paper => DARK_PAPER_OPACITY,
            Some(FloorPlan::Image(_)) if self.is_dark => DARK_IMAGE_OPACITY,
            _ => 1.0,
        };
        part * self.opacity.clamp(0.0, 1.0)
    }

    /// The last picture and its view.
    pub(crate) fn shown(&self) -> Option<(&TextureHandle, &View)> {
        self.picture.shown()
    }

    /// Takes finished tasks. Returns the bounds of a plan that was just read for the first time, or
    /// why it cannot be read.
    pub(crate) fn poll(&mut self, ctx: &Context) -> Option<Result<Bounds<f64>, String>> {
        self.picture.poll(ctx, "floor plan");
        let result = self.reading.as_ref().and_then(BackgroundTask::result)?;
        self.reading = None;
        self.shift_m = Point::default();
        match result.flatten() {
            Ok(ready) => {
                // It shows the plan at its old place.
                self.picture.clear();
                (self.read_error, self.before) = (None, None);
                let bounds = self.ready.insert(Arc::new(ready)).plan.bounds();
                bounds.filter(|_| self.is_new).map(Ok)
            }
            Err(error) => {
                let error = error.to_string();
                match self.before.take() {
                    Some(before) => {
                        *self = Self {
                            is_dark: self.is_dark,
                            ..*before
                        };
                    }
                    None => self.read_error = Some(error.clone()),
                }
                Some(Err(error))
            }
        }
    }

    /// Requests the picture of a view, unless it is there or in progress.
    pub(crate) fn request(&mut self, view: &View, is_dark: bool, repaint: &RepaintHandle) {
        self.is_dark = is_dark;
        let Some(ready) = self.visible_ready() else {
            self.picture.clear();
            return;
        };
        if self.picture.needs(&is_dark, view) {
            let (ready, view) = (Arc::clone(ready), *view);
            let draw = move || ready.draw(&view);
            self.picture.start(is_dark, view, repaint, draw);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use guideway_compose::{Image, ImagePlacement};
    use guideway_formats::raster::Raster;

    use super::*;
    use crate::tests::services::TestServices;

    fn read(text: &str) -> (FloorPlanLayer, Option<Bounds<f64>>) {
        let services: Arc<dyn AppServices> = TestServices::with([]);
        let repaint: RepaintHandle = Arc::new(|| {});
        let mut layer = FloorPlanLayer::default();
        layer.set(text, &services, &repaint);
        let mut bounds = None;
        for _ in 0..5_000 {
            bounds = bounds.or(layer.poll(&Context::default()).and_then(Result::ok));
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
    fn paper_is_dark_on_a_dark_background_other_images_dim_and_drawings_stay() {
        let (mut layer, _) = read("hall.png@px-per-m=20");
        layer.opacity = 0.5;
        let opacities = |layer: &mut FloorPlanLayer| {
            [false, true].map(|is_dark| {
                layer.is_dark = is_dark;
                layer.drawn_opacity()
            })
        };
        let drawing = opacities(&mut layer);
        assert_eq!(drawing, [0.5, 0.5], "the plan of the tests is a drawing");
        let placement = ImagePlacement {
            px_per_m: 1.0,
            rotate_deg: 0.0,
            offset_m: Point::default(),
        };
        for (gray, of_window) in [(255, 0), (100, 100)] {
            let image = Raster {
                width: 1,
                height: 1,
                pixels: vec![[gray, gray, gray, 255]],
                has_alpha: false,
                png: None,
            };
            let image = FloorPlan::from_image(Image::new(image, &placement));
            layer.ready = Some(Arc::new(ReadyPlan::new(image).unwrap()));
            let [light, dark] = opacities(&mut layer);
            assert!(light == 0.5 && dark < 0.3, "{dark}");
            let size = guideway_scene::FrameSize::new(1, 1).unwrap();
            let view = View::new(size, Point::new(0.5, 0.5), 1.0).unwrap();
            let frame = layer.visible_ready().unwrap().draw(&view).unwrap();
            assert_eq!(frame.pixels()[0], [of_window, of_window, of_window, 255]);
        }
    }

    #[test]
    fn keeps_the_error_of_an_unreadable_plan() {
        let (layer, bounds) = read("hall.bmp");
        assert!(bounds.is_none() && layer.error().is_some());
    }
}
