//! A window without a screen, with the input of a user.

use std::sync::Arc;
use std::thread;
use std::time::Duration;

use eframe::egui::accesskit::Role;
use eframe::egui::{
    Context, CursorIcon, Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, Shape,
    TouchPhase, Vec2,
};
use egui_kittest::Harness;
use egui_kittest::kittest::{By, Queryable};
use guideway_document::Document;
use guideway_spline::Point;

use super::services::TestServices;
use crate::LaunchOptions;
use crate::app::App;
use crate::editing::EditTask;
use crate::services::AppServices;

/// The application in a test harness of egui.
pub(super) struct TestWindow {
    pub(super) harness: Harness<'static, Option<App>>,
    pub(super) disk: Arc<TestServices>,
}

/// Frames, two milliseconds apart, in which an awaited state must arrive.
const MAX_FRAMES: u32 = 5_000;

impl TestWindow {
    /// Opens files.
    pub(super) fn open(disk: &Arc<TestServices>, files: &[&str], method: Option<&str>) -> Self {
        let services: Arc<dyn AppServices> = disk.clone();
        Self::with_services(services, disk, files, method)
    }

    /// Opens files with services that may wrap `disk`.
    pub(super) fn with_services(
        services: Arc<dyn AppServices>,
        disk: &Arc<TestServices>,
        files: &[&str],
        method: Option<&str>,
    ) -> Self {
        Self::with_setup(services, disk, files, method, |_| {})
    }

    /// Opens files after `setup` in the first frame.
    pub(super) fn with_setup(
        services: Arc<dyn AppServices>,
        disk: &Arc<TestServices>,
        files: &[&str],
        method: Option<&str>,
        setup: impl FnOnce(&Context) + 'static,
    ) -> Self {
        let options = LaunchOptions {
            files: files.iter().map(Into::into).collect(),
            method: method.map(str::to_owned),
            ..LaunchOptions::default()
        };
        let mut start = Some((services, options, setup));
        let harness = Harness::builder()
            .with_size(Vec2::new(1200.0, 800.0))
            .with_max_steps(64)
            .build_ui_state(
                move |ui, app: &mut Option<App>| {
                    if let Some((services, options, setup)) = start.take() {
                        setup(ui.ctx());
                        let window = ui.ctx().clone();
                        let repaint = Arc::new(move || window.request_repaint());
                        let mut new = App::launch(repaint, services, options);
                        // On a slow computer too, an edit is complete after its key press.
                        new.edit_wait = Duration::from_secs(60);
                        *app = Some(new);
                    }
                    if let Some(app) = app {
                        app.show(ui);
                    }
                },
                None,
            );
        Self {
            harness,
            disk: Arc::clone(disk),
        }
    }

    /// Opens one file and waits for its document and picture.
    pub(super) fn showing(layout: guideway_layout::Layout) -> Self {
        let disk = TestServices::with([("site.arrow", layout)]);
        let mut window = Self::open(&disk, &["site.arrow"], Some("cpu"));
        window.wait(|app| {
            app.document().is_some() && app.files.layers()[0].picture.shown().is_some()
        });
        window
    }

    pub(super) fn app(&mut self) -> &mut App {
        self.harness
            .state_mut()
            .as_mut()
            .expect("the first frame creates it")
    }

    pub(super) fn document(&mut self) -> &mut Document {
        let layer = self.app().files.active_mut();
        let document = layer.and_then(|layer| layer.slot.document_mut());
        document.expect("a document is loaded")
    }

    /// Edits the document, as a command does.
    pub(super) fn edit<E: ToString>(
        &mut self,
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) {
        self.app().edit(EditTask::edit(edit));
    }

    /// Changes selection or visibility, as a command does.
    pub(super) fn change(&mut self, change: impl FnOnce(&mut Document) + Send + 'static) {
        self.app().edit(EditTask::view_change(change));
    }

    pub(super) fn selected(&mut self) -> Vec<u32> {
        self.document().selection().iter().collect()
    }

    /// Shows frames until a state arrives.
    pub(super) fn wait(&mut self, is_there: impl Fn(&App) -> bool) {
        for _ in 0..MAX_FRAMES {
            self.harness.step();
            if is_there(self.app()) {
                return;
            }
            thread::sleep(Duration::from_millis(2));
        }
        let app = self.app();
        let layers = app.files.layers().iter().map(|layer| {
            let shown = layer
                .picture
                .shown()
                .map(|shown| (&shown.report, shown.view));
            (layer.is_visible, layer.error(), shown)
        });
        let layers: Vec<_> = layers.collect();
        panic!(
            "the state did not arrive; {:?} {layers:?} {:?}",
            app.dialogs.notices.texts(),
            app.canvas.camera
        );
    }

    /// The point of the window at a position of the world, in meters.
    pub(super) fn at(&mut self, x: f64, y: f64) -> Pos2 {
        let app = self.app();
        let view = app.canvas.camera.view().expect("the canvas has a size");
        let pixel = view.pixel_from_world(Point::new(x, y));
        app.canvas.origin() + Vec2::new(pixel.x as f32, pixel.y as f32)
    }

    /// Moves the pointer to a position of the world, in meters.
    pub(super) fn hover(&mut self, x: f64, y: f64) -> Pos2 {
        let at = self.at(x, y);
        self.harness.event(Event::PointerMoved(at));
        self.harness.run_steps(3);
        at
    }

    /// The cursor of the last frame.
    pub(super) fn cursor(&self) -> CursorIcon {
        self.harness.output().platform_output.cursor_icon
    }

    pub(super) fn click(&mut self, at: Pos2) {
        self.click_with(at, Modifiers::NONE);
    }

    pub(super) fn click_with(&mut self, at: Pos2, modifiers: Modifiers) {
        self.press(at, modifiers);
        self.release(at, modifiers);
        // The next click must not be a double click.
        self.harness.run_steps(4);
    }

    pub(super) fn drag(&mut self, from: Pos2, to: Pos2) {
        self.press(from, Modifiers::NONE);
        for part in [0.3, 0.7] {
            self.harness
                .event(Event::PointerMoved(from + (to - from) * part));
            self.harness.step();
        }
        // The button is released in the frame of the last movement.
        let release = Event::PointerButton {
            pos: to,
            button: PointerButton::Primary,
            pressed: false,
            modifiers: Modifiers::NONE,
        };
        let events = [Event::PointerMoved(to), release];
        self.harness.input_mut().events.extend(events);
        self.harness.step();
    }

    pub(super) fn press(&mut self, at: Pos2, modifiers: Modifiers) {
        self.harness.event(Event::PointerMoved(at));
        self.harness.step();
        self.button(at, modifiers, true);
    }

    pub(super) fn release(&mut self, at: Pos2, modifiers: Modifiers) {
        self.button(at, modifiers, false);
    }

    fn button(&mut self, pos: Pos2, modifiers: Modifiers, pressed: bool) {
        self.harness.event_modifiers(
            Event::PointerButton {
                pos,
                button: PointerButton::Primary,
                pressed,
                modifiers,
            },
            modifiers,
        );
        self.harness.step();
    }

    /// Types a text without a field, and confirms it.
    pub(super) fn type_line(&mut self, text: &str) {
        self.harness.event(Event::Text(text.into()));
        self.harness.step();
        self.key(Modifiers::NONE, Key::Enter);
    }

    pub(super) fn right_click(&mut self, at: Pos2) {
        self.harness.event(Event::PointerMoved(at));
        for pressed in [true, false] {
            self.harness.event(Event::PointerButton {
                pos: at,
                button: PointerButton::Secondary,
                pressed,
                modifiers: Modifiers::NONE,
            });
        }
        self.harness.run_steps(2);
    }

    /// Answers the open one-line question.
    pub(super) fn answer(&mut self, text: &str) {
        self.harness.run_steps(2);
        self.key(Modifiers::COMMAND, Key::A);
        self.harness.event(Event::Text(text.into()));
        self.harness.run_steps(2);
        self.key(Modifiers::NONE, Key::Enter);
        self.harness.run_steps(2);
    }

    /// Replaces the text of the first field with this value, and confirms it.
    pub(super) fn type_over(&mut self, shown: &str, text: &str) {
        let mut fields = self.harness.get_all(field(shown));
        fields.next().expect("it is shown").focus();
        drop(fields);
        self.answer(text);
    }

    /// Replaces the number that a field to drag shows, and confirms it.
    pub(super) fn type_over_number(&mut self, shown: &str, text: &str) {
        let number = By::new().role(Role::SpinButton).value(shown);
        self.harness.get(number).focus();
        self.answer(text);
    }

    pub(super) fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.harness.step();
        self.harness.step();
    }

    pub(super) fn wheel(&mut self, at: Pos2, notches: f32) {
        self.harness.event(Event::PointerMoved(at));
        self.harness.step();
        self.harness.event(Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: Vec2::new(0.0, notches),
            phase: TouchPhase::Move,
            source: eframe::egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        self.harness.step();
    }
}

/// The texts that the last frame painted.
pub(super) fn drawn_texts(window: &TestWindow) -> Vec<String> {
    let shapes = window.harness.output().shapes.iter();
    let texts = shapes.filter_map(|shape| match &shape.shape {
        Shape::Text(text) => Some(text.galley.text().to_owned()),
        _ => None,
    });
    texts.collect()
}

/// The text field with this value.
pub(super) fn field(value: &str) -> By<'_> {
    By::new().role(Role::TextInput).value(value)
}

/// Returns `true` if a notice contains this text.
pub(super) fn has_notice(app: &App, text: &str) -> bool {
    let notices = app.dialogs.notices.texts();
    notices.iter().any(|notice| notice.contains(text))
}
