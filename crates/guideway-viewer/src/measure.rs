//! Measures the smoothness of the window: moves a file as a user would, at 60 frames per second and
//! without a screen, and reports the time of each frame on the window's thread and of each picture.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui::{
    Context, Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, RawInput,
    Rect, RequestRepaintInfo, TouchPhase, Vec2,
};
use guideway_document::{Document, PathSet, SelectMode, nearest};
use guideway_layout::UserError;
use guideway_scene::elapsed_ms;
use guideway_spline::{Bounds, Point};

use crate::LaunchOptions;
use crate::app::App;
use crate::background::RepaintGate;
use crate::editing::EditTask;
use crate::services::{AppServices, WINDOW_ERROR};
use crate::tools::HIT_RADIUS_PX;

/// Size of the window, in pixels.
const SIZE_PX: Vec2 = Vec2::new(1280.0, 800.0);
/// Center of the canvas, in pixels of the window.
const CANVAS_CENTER: Pos2 = Pos2::new(480.0, 400.0);
/// Duration of a frame at 60 Hz.
const FRAME: Duration = Duration::from_nanos(16_666_667);
/// Frames of a movement: two seconds.
const FRAMES: usize = 120;
/// Longest time for a movement to settle.
const SETTLE_TIMEOUT: Duration = Duration::from_secs(120);

/// The times of one movement.
#[derive(Clone, Debug)]
pub struct Movement {
    /// Name of the movement.
    pub name: &'static str,
    /// Time of each frame on the window's thread, in milliseconds: input, panels, marks, triangles.
    pub frames_ms: Vec<f64>,
    /// Frames that a window would have presented: those with input events, and those that it
    /// asks for.
    pub presented: usize,
    /// Time from request to picture of each picture that was shown meanwhile, in milliseconds.
    pub pictures_ms: Vec<f64>,
    /// Time from the last frame of the movement to its last picture, in milliseconds; 0 if none
    /// followed.
    pub shown_ms: f64,
    /// Time from the last frame of the movement until the layout can be edited again, in
    /// milliseconds.
    pub settled_ms: f64,
}

/// Opens a file and moves it, without a journal: still, hovered over, panned, zoomed, with a
/// hundredth and then all of its paths dragged, and zoomed with all of them selected.
///
/// # Errors
/// When the file cannot be read or rendered, or a movement does not settle.
pub fn measure(
    services: Arc<dyn AppServices>,
    file: PathBuf,
    method: Option<String>,
) -> Result<Vec<Movement>, UserError> {
    let options = LaunchOptions {
        files: vec![file],
        method,
        ..LaunchOptions::default()
    };
    let mut user = SimulatedUser::new(services, options);
    user.wait(|app| {
        let layer = &app.files.layers()[0];
        let is_loaded = layer.picture.shown().is_some() && layer.tasks.findings().is_some();
        layer.error().is_some() || is_loaded
    })?;
    let layer = &user.app.files.layers()[0];
    if let Some(error) = layer.error() {
        return Err(error_of(
            error,
            "Use a file for which `guideway check` reports no errors",
        ));
    }
    // The probe of the methods asks for a frame of its own.
    user.wait(|app| app.is_settled() && !app.methods.choices().is_empty())?;
    Ok(vec![
        user.movement("still", |_, _| Vec::new())?,
        user.movement("hover", |number, _| {
            let at = CANVAS_CENTER + Vec2::splat(number as f32);
            vec![Event::PointerMoved(at)]
        })?,
        user.pan()?,
        user.zoom("zoom")?,
        user.drag("drag a hundredth", 100)?,
        user.drag("drag all", 1)?,
        user.zoom("zoom, all selected")?,
    ])
}

fn error_of(message: &str, remedy: &str) -> UserError {
    UserError::new(WINDOW_ERROR, message, remedy)
}

/// Mouse and clock of a user, without a screen. Frames come at a fixed rate.
struct SimulatedUser {
    app: App,
    context: Context,
    gate: Arc<RepaintGate>,
    /// True if the window asked for a frame since the last one.
    is_asked: Arc<AtomicBool>,
    /// Frames of the movement that a window would have presented.
    presented: usize,
    started: Instant,
    pointer: Pos2,
    /// Time from request to picture of each picture shown, in milliseconds.
    pictures_ms: Vec<f64>,
    last_picture: Instant,
}

impl SimulatedUser {
    fn new(services: Arc<dyn AppServices>, options: LaunchOptions) -> Self {
        let started = Instant::now();
        let context = Context::default();
        let gate = Arc::new(RepaintGate::new(&context));
        let is_asked = Arc::<AtomicBool>::default();
        let ask = |is_asked: &Arc<AtomicBool>| {
            let is_asked = Arc::clone(is_asked);
            move || is_asked.store(true, Ordering::SeqCst)
        };
        let (admitting, asked) = (Arc::clone(&gate), ask(&is_asked));
        context.set_repaint_observer(Box::new(move |info: RequestRepaintInfo| {
            if info.delay.is_zero() && admitting.admits() {
                asked();
            }
        }));
        let mut app = App::launch(Arc::new(ask(&is_asked)), services, options);
        // Colors are measured, whatever the file.
        app.shows_crowds = false;
        Self {
            app,
            context,
            gate,
            is_asked,
            presented: 0,
            started,
            pointer: CANVAS_CENTER,
            pictures_ms: Vec::new(),
            last_picture: started,
        }
    }

    /// Shows one frame. Returns its time on this thread, in milliseconds.
    fn frame(&mut self, events: Vec<Event>) -> f64 {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, SIZE_PX)),
            time: Some(self.started.elapsed().as_secs_f64()),
            max_texture_side: Some(8192),
            events,
            ..RawInput::default()
        };
        let shown = |app: &App| {
            let shown = app.files.layers()[0].picture.shown()?;
            Some((shown.number, shown.wall_ms))
        };
        let before = shown(&self.app);
        let is_asked = self.is_asked.swap(false, Ordering::SeqCst);
        self.presented += usize::from(is_asked || !input.events.is_empty());
        self.gate.begin();
        let since = Instant::now();
        let (context, app, gate) = (&self.context, &mut self.app, &self.gate);
        let mut output = context.run_ui(input, |ui| {
            gate.show(ui.ctx());
            app.show(ui);
            gate.end(ui.ctx(), app.changes_late);
        });
        context.tessellate(output.shapes, output.pixels_per_point);
        let frame_ms = elapsed_ms(since);
        // No device uploads them.
        output.textures_delta.clear();
        let after = shown(&self.app);
        if after.map(|(number, _)| number) != before.map(|(number, _)| number) {
            self.pictures_ms.extend(after.map(|(_, wall_ms)| wall_ms));
            self.last_picture = Instant::now();
        }
        thread::sleep(FRAME.saturating_sub(since.elapsed()));
        frame_ms
    }

    /// Shows frames until `is_done` holds in two of them: results of threads arrive one frame late.
    /// Returns the time that took, in milliseconds.
    fn wait(&mut self, is_done: impl Fn(&App) -> bool) -> Result<f64, UserError> {
        let since = Instant::now();
        let mut was_done = false;
        while !std::mem::replace(&mut was_done, is_done(&self.app)) || !was_done {
            if since.elapsed() > SETTLE_TIMEOUT {
                return Err(error_of(
                    "a movement did not settle within 120 s",
                    "Use a smaller file or another render method",
                ));
            }
            self.frame(Vec::new());
        }
        Ok(elapsed_ms(since))
    }

    fn movement(
        &mut self,
        name: &'static str,
        mut events: impl FnMut(usize, &mut Self) -> Vec<Event>,
    ) -> Result<Movement, UserError> {
        self.pictures_ms.clear();
        self.presented = 0;
        let frames_ms = (0..FRAMES).map(|number| {
            let events = events(number, self);
            self.frame(events)
        });
        let frames_ms = frames_ms.collect::<Vec<f64>>();
        let (end, presented) = (Instant::now(), self.presented);
        let settled_ms = self.wait(App::is_settled)?;
        let until_shown = self.last_picture.saturating_duration_since(end);
        Ok(Movement {
            name,
            frames_ms,
            presented,
            pictures_ms: std::mem::take(&mut self.pictures_ms),
            shown_ms: until_shown.as_secs_f64() * 1e3,
            settled_ms,
        })
    }

    fn button(&self, button: PointerButton, pressed: bool) -> Event {
        Event::PointerButton {
            pos: self.pointer,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        }
    }

    /// The events of a drag: press in the first frame, release in the last.
    fn drag_events(&mut self, number: usize, button: PointerButton) -> Vec<Event> {
        match number {
            0 => vec![Event::PointerMoved(self.pointer), self.button(button, true)],
            last if last == FRAMES - 1 => vec![self.button(button, false)],
            _ => {
                self.pointer += Vec2::new(2.0, 1.0);
                vec![Event::PointerMoved(self.pointer)]
            }
        }
    }

    fn pan(&mut self) -> Result<Movement, UserError> {
        self.movement("pan", |number, user| {
            user.drag_events(number, PointerButton::Middle)
        })
    }

    fn zoom(&mut self, name: &'static str) -> Result<Movement, UserError> {
        self.pointer = CANVAS_CENTER;
        self.movement(name, |number, user| {
            let notches = if number < FRAMES / 2 { 0.25 } else { -0.25 };
            let wheel = Event::MouseWheel {
                unit: MouseWheelUnit::Line,
                delta: Vec2::new(0.0, notches),
                phase: TouchPhase::Move,
                source: MouseWheelSource::Wheel,
                modifiers: Modifiers::NONE,
            };
            vec![Event::PointerMoved(user.pointer), wheel]
        })
    }

    /// Selects and drags one in `one_in` paths, those nearest to the center.
    fn drag(&mut self, name: &'static str, one_in: u64) -> Result<Movement, UserError> {
        let no_path = || {
            error_of(
                "the file has no path that could be dragged",
                "Use a file with paths",
            )
        };
        let document = self.app.document().ok_or_else(no_path)?;
        let (mut paths, held_m) = paths_near_center(document, one_in).ok_or_else(no_path)?;
        let view = self.app.canvas.camera.view().ok_or_else(no_path)?;
        // Another path may lie over the held one.
        let widths = self.app.files.active().map(|layer| layer.widths);
        let px_per_point = self.app.canvas.px_per_point();
        let rule = self
            .app
            .settings
            .line_rule(widths.unwrap_or_default(), px_per_point);
        let px_per_m = view.px_per_m();
        let hit = document.pick(rule, px_per_m, held_m, HIT_RADIUS_PX, usize::MAX);
        paths.extend(hit.map(|hit| hit.path));
        self.app.edit(EditTask::view_change(move |document| {
            document.select(paths, SelectMode::Replace);
        }));
        self.wait(App::is_settled)?;
        let pixel = view.pixel_from_world(held_m);
        self.pointer = self.app.canvas.origin() + Vec2::new(pixel.x as f32, pixel.y as f32);
        self.movement(name, |number, user| {
            user.drag_events(number, PointerButton::Primary)
        })
    }
}

/// One in `one_in` paths, those nearest to the center of the document, and a point on one of them.
fn paths_near_center(document: &Document, one_in: u64) -> Option<(PathSet, Point<f64>)> {
    let bounds = document.bounds()?;
    let order = document.scene().draw_order();
    let wanted = (order.len() as u64 / one_in).max(1);
    let mut half_m = bounds.size() * 0.5;
    let mut paths: PathSet = order.iter().copied().collect();
    while paths.len() > wanted {
        half_m = half_m * 0.9;
        let around = Bounds {
            min: bounds.center() - half_m,
            max: bounds.center() + half_m,
        };
        let fewer: PathSet = document.index().paths_in(around).collect();
        if fewer.is_empty() {
            break;
        }
        paths = fewer;
    }
    let distance = |path: u32| {
        let hit = nearest(document.layout(), path, bounds.center(), 1e-3)?;
        Some((hit.distance_m, hit.point_m))
    };
    let nearest = paths
        .iter()
        .filter_map(distance)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((paths, nearest.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::{TestServices, lanes};

    #[test]
    fn window_presents_one_frame_per_movement_of_the_pointer_and_none_at_rest() {
        let services = TestServices::with([("site.arrow", lanes(3))]);
        let method = Some("cpu".to_owned());
        let movements = measure(services, "site.arrow".into(), method).unwrap();
        let presented = |name: &str| {
            let movement = movements.iter().find(|movement| movement.name == name);
            movement.map(|movement| movement.presented)
        };
        assert_eq!(
            (presented("still"), presented("hover")),
            (Some(0), Some(FRAMES))
        );
        // Each movement of a drag or of the wheel may have a picture of its own.
        let drag = presented("pan").unwrap();
        assert!((FRAMES..=2 * FRAMES).contains(&drag), "{drag}");
    }
}
