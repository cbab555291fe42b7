//! How smooth the viewer is: it is moved through a file without a screen, as a hand would, sixty frames a second, and
//! says what its own thread took for each frame and what drawing took beside it.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui::{
    Context, Event, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, RawInput,
    Rect, TouchPhase, Vec2,
};
use guideway_document::{Document, PathSet, SelectMode};
use guideway_scene::elapsed_ms;
use guideway_spline::{Bounds, Point};

use crate::LaunchOptions;
use crate::app::{App, REACH_PX};
use crate::services::{AppServices, WINDOW_ERROR};
use guideway_layout::UserError;

/// Size of the window, in pixels.
const SIZE_PX: Vec2 = Vec2::new(1280.0, 800.0);
const FRAME: Duration = Duration::from_nanos(16_666_667);
/// Frames of a movement.
const FRAMES: usize = 120;
/// How long anything may take before it is given up.
const PATIENCE: Duration = Duration::from_secs(120);

/// One movement, measured.
#[derive(Clone, Debug)]
pub struct Movement {
    /// What was done.
    pub name: &'static str,
    /// What the thread of the window took for each frame, in milliseconds: events, panels, marks and triangles.
    pub frames_ms: Vec<f64>,
    /// For each picture that came meanwhile, the time from the question to the picture, in milliseconds.
    pub pictures_ms: Vec<f64>,
    /// From the last movement until the last picture of it, in milliseconds; 0 where none came after it.
    pub shown_ms: f64,
    /// From the last movement until all of it is done, and the layout can be changed again, in milliseconds.
    pub settled_ms: f64,
}

/// Opens a file and moves it: still, panned, zoomed, with a hundredth and then all of its paths dragged, and zoomed with
/// all of them selected.
///
/// # Errors
/// When the file cannot be read or drawn, or a movement comes to no end.
pub fn measure(
    services: Arc<dyn AppServices>,
    file: PathBuf,
    method: Option<String>,
) -> Result<Vec<Movement>, UserError> {
    let context = Context::default();
    // It has a frame sixty times a second, whatever happens.
    let wake = Arc::new(|| {});
    let started = Instant::now();
    let opening = LaunchOptions {
        files: vec![file],
        method,
        ..LaunchOptions::default()
    };
    let mut hand = Hand {
        app: App::new(wake, services, opening),
        context,
        started,
        at: Pos2::new(480.0, 400.0),
        seen: Vec::new(),
        last_seen: started,
    };
    hand.wait(|app| {
        let layer = &app.layers[0];
        layer.trouble.is_some() || (layer.shown.is_some() && layer.findings.is_some())
    })?;
    if let Some(trouble) = &hand.app.layers[0].trouble {
        return Err(UserError {
            code: WINDOW_ERROR,
            message: trouble.clone(),
            remedy: "Give a file that `guideway check` has no errors for".into(),
        });
    }
    if hand.app.layers[0].has_found_work() {
        return Err(UserError {
            code: WINDOW_ERROR,
            message: "work on this file was not saved when the viewer last ended".into(),
            remedy: "Open it in the window first, or measure a copy".into(),
        });
    }
    hand.wait(App::is_settled)?;
    let nothing = |_: usize, _: &mut Hand| Vec::new();
    Ok(vec![
        hand.movement("still", nothing)?,
        hand.pan()?,
        hand.zoom("zoom")?,
        hand.drag("drag a hundredth", 100)?,
        hand.drag("drag all", 1)?,
        hand.zoom("zoom, all selected")?,
    ])
}

struct Hand {
    app: App,
    context: Context,
    started: Instant,
    at: Pos2,
    /// Times of the pictures that came.
    seen: Vec<f64>,
    /// When the last one came.
    last_seen: Instant,
}

impl Hand {
    /// One frame; says how long it took, in milliseconds.
    fn frame(&mut self, events: Vec<Event>) -> f64 {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, SIZE_PX)),
            time: Some(self.started.elapsed().as_secs_f64()),
            max_texture_side: Some(8192),
            events,
            ..RawInput::default()
        };
        let count = |app: &App| app.layers[0].shown.as_ref().map_or(0, |shown| shown.number);
        let before = count(&self.app);
        let since = Instant::now();
        let (context, app) = (&self.context, &mut self.app);
        let mut output = context.run_ui(input, |ui| app.show(ui));
        context.tessellate(output.shapes, output.pixels_per_point);
        let frame_ms = elapsed_ms(since);
        // There is no device to bring them to.
        output.textures_delta.clear();
        if count(&self.app) != before {
            let shown = self.app.layers[0].shown.as_ref();
            self.seen.extend(shown.map(|shown| shown.wall_ms));
            self.last_seen = Instant::now();
        }
        thread::sleep(FRAME.saturating_sub(since.elapsed()));
        frame_ms
    }

    fn wait(&mut self, is_so: impl Fn(&App) -> bool) -> Result<f64, UserError> {
        let since = Instant::now();
        // What a thread has just brought is taken in with the next frame.
        let mut was_so = false;
        while !std::mem::replace(&mut was_so, is_so(&self.app)) || !was_so {
            if since.elapsed() > PATIENCE {
                return Err(UserError {
                    code: WINDOW_ERROR,
                    message: "a movement came to no end".into(),
                    remedy: "Try a smaller file, or another way of drawing".into(),
                });
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
        self.seen.clear();
        let frames_ms = (0..FRAMES).map(|number| {
            let events = events(number, self);
            self.frame(events)
        });
        let frames_ms = frames_ms.collect::<Vec<f64>>();
        let end = Instant::now();
        let settled_ms = self.wait(App::is_settled)?;
        let until_shown = self.last_seen.saturating_duration_since(end);
        Ok(Movement {
            name,
            frames_ms,
            pictures_ms: std::mem::take(&mut self.seen),
            shown_ms: until_shown.as_secs_f64() * 1e3,
            settled_ms,
        })
    }

    fn button(&self, button: PointerButton, pressed: bool) -> Event {
        Event::PointerButton {
            pos: self.at,
            button,
            pressed,
            modifiers: Modifiers::NONE,
        }
    }

    /// The events of a drag: pressed in the first frame, let go in the last.
    fn dragged(&mut self, number: usize, button: PointerButton) -> Vec<Event> {
        match number {
            0 => vec![Event::PointerMoved(self.at), self.button(button, true)],
            last if last == FRAMES - 1 => vec![self.button(button, false)],
            _ => {
                self.at += Vec2::new(2.0, 1.0);
                vec![Event::PointerMoved(self.at)]
            }
        }
    }

    fn pan(&mut self) -> Result<Movement, UserError> {
        self.movement("pan", |number, hand| {
            hand.dragged(number, PointerButton::Middle)
        })
    }

    fn zoom(&mut self, name: &'static str) -> Result<Movement, UserError> {
        self.at = Pos2::new(480.0, 400.0);
        self.movement(name, |number, hand| {
            let notches = if number < FRAMES / 2 { 0.25 } else { -0.25 };
            let wheel = Event::MouseWheel {
                unit: MouseWheelUnit::Line,
                delta: Vec2::new(0.0, notches),
                phase: TouchPhase::Move,
                source: MouseWheelSource::Wheel,
                modifiers: Modifiers::NONE,
            };
            vec![Event::PointerMoved(hand.at), wheel]
        })
    }

    /// Drags one path in so many, those around the middle one.
    fn drag(&mut self, name: &'static str, one_in: u64) -> Result<Movement, UserError> {
        let none = || UserError {
            code: WINDOW_ERROR,
            message: "there is no path in the middle that could be dragged".into(),
            remedy: "Give a file with paths".into(),
        };
        let document = self.app.document().ok_or_else(none)?;
        let (mut rows, held_m) = around_middle(document, one_in).ok_or_else(none)?;
        let view = self.app.camera.view().ok_or_else(none)?;
        // Another one may lie over it.
        let (rule, px_per_m) = (self.app.look.line_rule(), view.px_per_m());
        let hit = document.pick(rule, px_per_m, held_m, REACH_PX, usize::MAX);
        rows.extend(hit.map(|hit| hit.path));
        self.app
            .change(move |document| document.select(rows, SelectMode::Replace));
        self.wait(App::is_settled)?;
        let pixel = view.pixel_from_world(held_m);
        self.at = self.app.canvas_min + Vec2::new(pixel.x as f32, pixel.y as f32);
        self.movement(name, |number, hand| {
            hand.dragged(number, PointerButton::Primary)
        })
    }
}

/// One path in so many, those nearest to the middle, and a point on one of them.
fn around_middle(document: &Document, one_in: u64) -> Option<(PathSet, Point<f64>)> {
    let bounds = document.bounds()?;
    let order = document.scene().draw_order();
    let wanted = (order.len() as u64 / one_in).max(1);
    let mut half_m = bounds.size() * 0.5;
    let mut rows: PathSet = order.iter().copied().collect();
    while rows.len() > wanted {
        half_m = half_m * 0.9;
        let around = Bounds {
            min: bounds.center() - half_m,
            max: bounds.center() + half_m,
        };
        let fewer: PathSet = document.index().paths_in(around).collect();
        if fewer.is_empty() {
            break;
        }
        rows = fewer;
    }
    let near = |row: u32| {
        let hit = guideway_document::nearest(document.layout(), row, bounds.center(), 1e-3)?;
        Some((hit.distance_m, hit.point_m))
    };
    let nearest = rows
        .iter()
        .filter_map(near)
        .min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some((rows, nearest.1))
}
