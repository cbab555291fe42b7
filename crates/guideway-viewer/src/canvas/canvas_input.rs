//! Pointer, wheel and touch input of the canvas: moves the camera and reports pointer events.

use eframe::egui::{
    Context, CursorIcon, Event, Key, LayerId, MouseWheelSource, MouseWheelUnit, Order, Pos2, Rect,
    Response, Sense, Ui,
};
use guideway_scene::{FrameSize, View};
use guideway_spline::Point;

use super::camera::Camera;
use super::pointer_tracker::{PointerInput, PointerStep, PointerTracker};
use super::screen::Screen;
use crate::tools::PointerEvent;

/// Scale factor of one notch of a mouse wheel.
const ZOOM_PER_NOTCH: f64 = 1.2;
/// Points of window scrolling that count as one notch, where a wheel reports points.
const POINTS_PER_NOTCH: f32 = 50.0;
/// Lines of a page, where a wheel reports pages.
const LINES_PER_PAGE: f32 = 10.0;

/// The canvas: camera, position in the window, and pointer.
pub(crate) struct Canvas {
    pub(crate) camera: Camera,
    screen: Screen,
    pointer_px: Option<Point<f64>>,
    pointer: PointerTracker,
    /// The area of the canvas in the present frame.
    response: Option<Response>,
    /// Longest side of a texture of this computer, in pixels.
    max_texture_side: u32,
}

impl Default for Canvas {
    fn default() -> Self {
        Self {
            camera: Camera::new(),
            screen: Screen {
                rect: Rect::ZERO,
                px_per_point: 1.0,
            },
            pointer_px: None,
            pointer: PointerTracker::default(),
            response: None,
            max_texture_side: 0,
        }
    }
}

impl Canvas {
    /// Upper left corner of the canvas in the window.
    pub(crate) fn origin(&self) -> Pos2 {
        self.screen.rect.min
    }

    /// The area of the canvas in the present frame.
    pub(crate) fn response(&self) -> Option<Response> {
        self.response.clone()
    }

    pub(crate) fn screen(&self) -> Screen {
        self.screen
    }

    /// Pixels of the picture per point of the window.
    pub(crate) fn px_per_point(&self) -> f64 {
        f64::from(self.screen.px_per_point)
    }

    /// Position of the pointer in the picture.
    pub(crate) fn pointer_px(&self) -> Option<Point<f64>> {
        self.pointer_px
    }

    /// The view to render: that of the camera, at lower resolution where it exceeds a texture.
    pub(crate) fn picture_view(&self) -> Option<View> {
        shrunk_to_texture(&self.camera.view()?, self.max_texture_side)
    }

    /// Takes all available space of `ui`; the wheel and the fingers on it move the camera. Returns
    /// the end of a drag that a second finger took over.
    pub(crate) fn show(&mut self, ui: &mut Ui) -> Option<PointerEvent> {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let px_per_point = ui.ctx().pixels_per_point();
        self.screen = Screen { rect, px_per_point };
        let size_px = rect.size() * px_per_point;
        self.camera
            .resize(size_px.x.round() as u32, size_px.y.round() as u32);
        self.max_texture_side = ui.input(|input| input.max_texture_side) as u32;
        self.pointer_px = response.hover_pos().map(|at| self.screen.pixel(at));
        self.response = Some(response.clone());
        let was_pressed = self.pointer.is_pressed();
        self.wheel(ui, &response);
        let is_moving = ui.input(|input| input.pointer.any_down() || input.is_scrolling());
        if !is_moving {
            self.camera.settle();
        }
        (was_pressed && !self.pointer.is_pressed()).then_some(PointerEvent::Cancelled)
    }

    /// Takes the place of the pointer before the canvas is shown.
    pub(crate) fn follow_pointer(&mut self, ctx: &Context) {
        let at = ctx.input(|input| input.pointer.hover_pos());
        let at = at.filter(|at| self.is_uncovered(*at, ctx));
        self.pointer_px = at.map(|at| self.screen.pixel(at));
    }

    /// Handles a pointer event of the window. Pans the camera, and returns what reaches the tools.
    /// With `primary_pans` the primary button pans instead of dragging.
    pub(crate) fn pointer_events(
        &mut self,
        event: &Event,
        ctx: &Context,
        primary_pans: bool,
    ) -> Vec<PointerEvent> {
        let is_space_down = ctx.input(|input| input.key_down(Key::Space));
        let input = PointerInput {
            screen: self.screen,
            time_s: ctx.input(|input| input.time),
            modifiers: ctx.input(|input| input.modifiers),
            is_on_canvas: self.is_over(event, ctx),
            primary_pans: primary_pans || (is_space_down && !ctx.text_edit_focused()),
        };
        let mut steps = Vec::new();
        self.pointer.handle(event, &input, &mut steps);
        let mut events = Vec::new();
        for step in steps {
            match step {
                PointerStep::Pan(by) => self.pan(by),
                PointerStep::Tool(event) => events.push(event),
            }
        }
        events
    }

    /// Returns `true` if a pointer event is on the canvas.
    pub(crate) fn is_over(&self, event: &Event, ctx: &Context) -> bool {
        place_of(event).is_some_and(|at| self.is_uncovered(at, ctx))
    }

    /// The pixel of the picture under the pointer at the time of the last event.
    pub(crate) fn event_px(&self, ctx: &Context) -> Option<Point<f64>> {
        let at = self.pointer.at().filter(|at| self.is_uncovered(*at, ctx))?;
        Some(self.screen.pixel(at))
    }

    /// The view, and the pointer as of the last event.
    pub(crate) fn place(&self) -> CanvasPlace {
        CanvasPlace {
            view: self.camera.view(),
            pointer: self.pointer.at(),
        }
    }

    /// Takes the view and the pointer of another time. Returns those of the present.
    pub(crate) fn exchange_place(&mut self, place: CanvasPlace) -> CanvasPlace {
        CanvasPlace {
            view: self.camera.exchange_view(place.view),
            pointer: self.pointer.exchange_at(place.pointer),
        }
    }

    /// Returns `true` while a button that went down on the canvas is down.
    pub(crate) fn is_pressed(&self) -> bool {
        self.pointer.is_pressed()
    }

    /// The cursor of a drag that pans.
    pub(crate) fn cursor(&self) -> Option<CursorIcon> {
        self.pointer.is_panning().then_some(CursorIcon::Grabbing)
    }

    /// Ends the drag of a pressed button: the rest of it has no effect.
    pub(crate) fn release_pointer(&mut self) {
        self.pointer.release();
    }

    /// Returns `true` if a point of the window is on the canvas, and no menu or dialog is over it.
    fn is_uncovered(&self, at: Pos2, ctx: &Context) -> bool {
        let is_covered = |layer: LayerId| layer.order != Order::Background;
        self.screen.rect.contains(at) && !ctx.layer_id_at(at).is_some_and(is_covered)
    }

    /// Pans by points of the window.
    fn pan(&mut self, by: eframe::egui::Vec2) {
        let by_px = by * self.screen.px_per_point;
        self.camera
            .pan(Point::new(f64::from(by_px.x), f64::from(by_px.y)));
    }

    /// A wheel zooms, two fingers on a trackpad pan, and a pinch zooms.
    fn wheel(&mut self, ui: &Ui, response: &Response) {
        let (pinch, touch, events) = ui.input(|input| {
            (
                input.zoom_delta(),
                input.multi_touch(),
                input.raw.events.clone(),
            )
        });
        if let Some(touch) = touch {
            // The first finger also acts as the pointer.
            self.pointer.release();
            self.pan(touch.translation_delta);
            let at_px = self.screen.pixel(touch.center_pos);
            self.camera.zoom(f64::from(touch.zoom_delta), at_px);
            return;
        }
        let Some(at_px) = response.hover_pos().map(|at| self.screen.pixel(at)) else {
            return;
        };
        if pinch != 1.0 {
            self.camera.zoom(f64::from(pinch), at_px);
            return;
        }
        for event in events {
            let Event::MouseWheel {
                unit,
                delta,
                source,
                modifiers,
                ..
            } = event
            else {
                continue;
            };
            if modifiers.command {
                // egui reports it as a pinch.
                continue;
            }
            let is_trackpad = match source {
                MouseWheelSource::Unknown => unit == MouseWheelUnit::Point,
                MouseWheelSource::Wheel => false,
                _ => true,
            };
            if is_trackpad {
                self.pan(delta);
                continue;
            }
            let notches = match unit {
                MouseWheelUnit::Line => delta.y,
                MouseWheelUnit::Page => delta.y * LINES_PER_PAGE,
                MouseWheelUnit::Point => delta.y / POINTS_PER_NOTCH,
            };
            self.camera
                .zoom(ZOOM_PER_NOTCH.powf(f64::from(notches)), at_px);
        }
    }
}

/// The view and the place of the pointer in the window at some time.
#[derive(Clone, Copy)]
pub(crate) struct CanvasPlace {
    view: Option<View>,
    pointer: Option<Pos2>,
}

/// The place of a pointer event in the window.
fn place_of(event: &Event) -> Option<Pos2> {
    match *event {
        Event::PointerMoved(at) | Event::PointerButton { pos: at, .. } => Some(at),
        _ => None,
    }
}

/// The same part of the world, divided by an integer factor until it fits a texture.
fn shrunk_to_texture(view: &View, max_side: u32) -> Option<View> {
    let (width, height) = (view.size().width(), view.size().height());
    let factor = width.max(height).div_ceil(max_side.max(1));
    let size = FrameSize::new((width / factor).max(1), (height / factor).max(1)).ok()?;
    View::new(size, view.center_m(), view.px_per_m() / f64::from(factor)).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn picture_larger_than_a_texture_is_shrunk() {
        let size = FrameSize::new(900, 600).unwrap();
        let view = View::new(size, Point::new(1.0, 2.0), 12.0).unwrap();
        assert_eq!(shrunk_to_texture(&view, 1000), Some(view));
        let small = shrunk_to_texture(&view, 400).unwrap();
        assert_eq!((small.size().width(), small.px_per_m()), (300, 4.0));
        assert_eq!(small.world_bounds(), view.world_bounds());
    }
}
