use eframe::egui::{
    Event, Key, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, Rect, Response, Sense, Ui,
    Vec2,
};
use guideway_scene::{FrameSize, View};
use guideway_spline::Point;

use crate::app::{App, Gesture, Tool, leave_field};
use crate::work::renderer::Shot;

/// From the points of the window to the pixels of the picture and back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screen {
    pub(super) rect: Rect,
    pub(super) px_per_point: f32,
}

impl Screen {
    pub(super) fn pixel(self, at: Pos2) -> Point<f64> {
        let at = (at - self.rect.min) * self.px_per_point;
        Point::new(f64::from(at.x), f64::from(at.y))
    }

    pub(super) fn point(self, pixel: Point<f64>) -> Pos2 {
        self.rect.min + Vec2::new(pixel.x as f32, pixel.y as f32) / self.px_per_point
    }
}

impl App {
    /// The picture, and all that the pointer does in it.
    pub(super) fn canvas(&mut self, ui: &mut Ui) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let px_per_point = ui.ctx().pixels_per_point();
        let screen = Screen { rect, px_per_point };
        let size_px = rect.size() * px_per_point;
        self.camera
            .resize(size_px.x.round() as u32, size_px.y.round() as u32);
        self.canvas_min = rect.min;
        self.px_per_point = f64::from(px_per_point);
        self.pointer_px = response.hover_pos().map(|at| screen.pixel(at));
        self.pointer(ui, &response, screen);
        self.wheel(ui, &response, screen);
        let is_moving = ui.input(|input| input.pointer.any_down() || input.is_scrolling());
        if !is_moving {
            self.camera.settle();
        }
        if let Some(view) = self.camera.view() {
            self.most_side_px = ui.input(|input| input.max_texture_side) as u32;
            self.ask_for_pictures(&view);
            self.paint(ui, screen, &view);
        }
    }

    fn pointer(&mut self, ui: &Ui, response: &Response, screen: Screen) {
        let modifiers = ui.input(|input| input.modifiers);
        // The last movement may come with letting go.
        let drags = |button| response.dragged_by(button) || response.drag_stopped_by(button);
        let is_panning = drags(PointerButton::Middle)
            || drags(PointerButton::Secondary)
            || (drags(PointerButton::Primary)
                && (matches!(self.tool, Tool::Draw | Tool::Measure)
                    || ui.input(|input| input.key_down(Key::Space))));
        if is_panning {
            let by = ui.input(|input| input.pointer.delta()) * screen.px_per_point;
            self.camera
                .pan(Point::new(f64::from(by.x), f64::from(by.y)));
        } else if response.drag_started_by(PointerButton::Primary) {
            let origin = ui.input(|input| input.pointer.press_origin());
            if let Some(origin) = origin {
                self.begin_drag(screen.pixel(origin));
            }
        }
        let at_px = response.interact_pointer_pos().map(|at| screen.pixel(at));
        if drags(PointerButton::Primary)
            && !is_panning
            && let Some(at_px) = at_px
        {
            self.drag(at_px, modifiers);
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            self.end_drag(modifiers);
        }
        if let Some(at_px) = at_px {
            if response.clicked() {
                self.click(at_px, modifiers);
                leave_field(ui.ctx());
            }
            if response.double_clicked() {
                self.double_click();
            }
        }
        let is_idle = !ui.input(|input| input.pointer.any_down());
        if is_idle && matches!(self.gesture, Gesture::None | Gesture::Points(_)) {
            self.hover(self.pointer_px);
        }
        if self.tool == Tool::Points
            && let Some(at_px) = self.pointer_px
        {
            for (key, inserts) in [(Key::Insert, true), (Key::Backspace, false)] {
                if ui.input(|input| input.key_pressed(key)) {
                    self.change_points(at_px, inserts);
                }
            }
        }
    }

    /// A wheel zooms, two fingers on a trackpad move, and spreading them zooms.
    fn wheel(&mut self, ui: &Ui, response: &Response, screen: Screen) {
        let (pinch, touch, events) = ui.input(|input| {
            (
                input.zoom_delta(),
                input.multi_touch(),
                input.raw.events.clone(),
            )
        });
        if let Some(touch) = touch {
            let by = touch.translation_delta * screen.px_per_point;
            self.camera
                .pan(Point::new(f64::from(by.x), f64::from(by.y)));
            let at_px = screen.pixel(touch.center_pos);
            self.camera.zoom(f64::from(touch.zoom_delta), at_px);
            return;
        }
        let Some(at_px) = response.hover_pos().map(|at| screen.pixel(at)) else {
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
            let is_trackpad = match source {
                MouseWheelSource::Unknown => unit == MouseWheelUnit::Point,
                MouseWheelSource::Wheel => false,
                _ => true,
            };
            if modifiers.command {
                // egui counts it as a pinch.
                continue;
            }
            if is_trackpad {
                let by = delta * screen.px_per_point;
                self.camera
                    .pan(Point::new(f64::from(by.x), f64::from(by.y)));
            } else {
                let notches = match unit {
                    MouseWheelUnit::Line => delta.y,
                    MouseWheelUnit::Page => delta.y * 10.0,
                    MouseWheelUnit::Point => delta.y / 50.0,
                };
                self.camera.zoom(1.2f64.powf(f64::from(notches)), at_px);
            }
        }
    }

    /// Has the renderers draw a view.
    pub(crate) fn ask_for_pictures(&mut self, view: &View) {
        let Some(view) = fitting(view, self.most_side_px) else {
            return;
        };
        let style = self.look.style();
        for layer in self.layers.iter_mut().filter(|layer| layer.is_visible) {
            layer.ask(Shot { view, style });
        }
        self.ask_for_swept(&view);
        self.ask_for_floor(&view);
    }
}

/// The view at its own size, or at a part of it where a texture cannot be as large.
fn fitting(view: &View, most_side: u32) -> Option<View> {
    let (width, height) = (view.size().width(), view.size().height());
    let parts = width.max(height).div_ceil(most_side.max(1));
    let size = FrameSize::new((width / parts).max(1), (height / parts).max(1)).ok()?;
    View::new(size, view.center_m(), view.px_per_m() / f64::from(parts)).ok()
}
