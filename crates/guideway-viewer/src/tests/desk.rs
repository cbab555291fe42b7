use std::sync::Arc;
use std::thread;
use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2};
use egui_kittest::Harness;
use guideway_document::Document;
use guideway_spline::Point;

use super::table::Table;
use crate::LaunchOptions;
use crate::app::App;
use crate::services::AppServices;

/// A viewer at which a person sits.
pub(super) struct Desk {
    pub(super) harness: Harness<'static, Option<App>>,
    pub(super) table: Arc<Table>,
}

/// How often the desk looks for what a thread is to bring, some milliseconds apart, before it gives up.
const MOST_LOOKS: u32 = 5_000;

impl Desk {
    pub(super) fn with(table: &Arc<Table>, files: &[&str], method: Option<&str>) -> Self {
        let services: Arc<dyn AppServices> = table.clone();
        Self::of(services, table, files, method)
    }

    /// With files of a services of its own.
    pub(super) fn of(
        services: Arc<dyn AppServices>,
        table: &Arc<Table>,
        files: &[&str],
        method: Option<&str>,
    ) -> Self {
        let opening = LaunchOptions {
            files: files.iter().map(Into::into).collect(),
            method: method.map(str::to_owned),
            ..LaunchOptions::default()
        };
        let mut start = Some((services, opening));
        let harness = Harness::builder()
            .with_size(Vec2::new(1200.0, 800.0))
            .with_max_steps(64)
            .build_ui_state(
                move |ui, app: &mut Option<App>| {
                    if let Some((services, opening)) = start.take() {
                        let window = ui.ctx().clone();
                        let wake = Arc::new(move || window.request_repaint());
                        let mut new = App::new(wake, services, opening);
                        // However slow the computer, an edit is done when its key was pressed.
                        new.patience = Duration::from_secs(60);
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
            table: Arc::clone(table),
        }
    }

    /// With one file open, and its picture there.
    pub(super) fn looking_at(layout: guideway_layout::Layout) -> Self {
        let table = Table::with([("site.arrow", layout)]);
        let mut desk = Self::with(&table, &["site.arrow"], Some("cpu"));
        desk.wait(|app| app.document().is_some() && app.layers[0].shown.is_some());
        desk
    }

    pub(super) fn app(&mut self) -> &mut App {
        self.harness
            .state_mut()
            .as_mut()
            .expect("made with the first frame")
    }

    pub(super) fn document(&mut self) -> &mut Document {
        self.app().document_mut().expect("a file is open")
    }

    pub(super) fn selected(&mut self) -> Vec<u32> {
        self.document().selection().iter().collect()
    }

    /// Waits for what the threads bring.
    pub(super) fn wait(&mut self, is_there: impl Fn(&App) -> bool) {
        for _ in 0..MOST_LOOKS {
            self.harness.step();
            if is_there(self.app()) {
                return;
            }
            thread::sleep(Duration::from_millis(2));
        }
        let app = self.app();
        let layers = app.layers.iter().map(|layer| {
            let shown = layer
                .shown
                .as_ref()
                .map(|shown| (&shown.report, shown.view));
            (layer.is_visible, &layer.trouble, shown)
        });
        let layers: Vec<_> = layers.collect();
        panic!(
            "it did not come; {:?} {layers:?} {:?}",
            app.notices, app.camera
        );
    }

    /// Where a place of the world is in the window.
    pub(super) fn at(&mut self, x: f64, y: f64) -> Pos2 {
        let app = self.app();
        let view = app.camera.view().expect("the picture has a size");
        let pixel = view.pixel_from_world(Point::new(x, y));
        app.canvas_min + Vec2::new(pixel.x as f32, pixel.y as f32)
    }

    pub(super) fn click(&mut self, at: Pos2) {
        self.click_with(at, Modifiers::NONE);
    }

    pub(super) fn click_with(&mut self, at: Pos2, modifiers: Modifiers) {
        self.press(at, modifiers);
        self.release(at, modifiers);
        // So that the next click is no double click.
        self.harness.run_steps(4);
    }

    pub(super) fn drag(&mut self, from: Pos2, to: Pos2) {
        self.press(from, Modifiers::NONE);
        for part in [0.3, 0.7] {
            self.harness
                .event(Event::PointerMoved(from + (to - from) * part));
            self.harness.step();
        }
        // A swift hand has let go before the next frame.
        let let_go = Event::PointerButton {
            pos: to,
            button: PointerButton::Primary,
            pressed: false,
            modifiers: Modifiers::NONE,
        };
        let events = [Event::PointerMoved(to), let_go];
        self.harness.input_mut().events.extend(events);
        self.harness.step();
    }

    fn press(&mut self, at: Pos2, modifiers: Modifiers) {
        self.harness.event(Event::PointerMoved(at));
        self.harness.step();
        self.button(at, modifiers, true);
    }

    fn release(&mut self, at: Pos2, modifiers: Modifiers) {
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
