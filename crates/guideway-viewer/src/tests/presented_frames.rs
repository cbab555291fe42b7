//! The frames that a window presents per event, without a screen.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use eframe::egui::{
    Context, Event, Key, Modifiers, Pos2, RawInput, Rect, RequestRepaintInfo, Vec2,
};

use super::services::{TestServices, lanes};
use crate::LaunchOptions;
use crate::app::App;
use crate::background::RepaintGate;
use crate::editing::EditTask;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;

/// A window that presents the frames that it asks for itself; those for the results of threads are
/// left out.
struct Screen {
    ctx: Context,
    app: App,
    gate: Arc<RepaintGate>,
    is_asked: Arc<AtomicBool>,
    time_s: f64,
}

impl Screen {
    /// A window that shows three lanes and has come to rest.
    fn new() -> Self {
        let disk = TestServices::with([("site.arrow", lanes(3))]);
        let options = LaunchOptions {
            files: vec!["site.arrow".into()],
            method: Some("cpu".into()),
            ..LaunchOptions::default()
        };
        let (ctx, gate) = (Context::default(), Arc::new(RepaintGate::new()));
        let is_asked = Arc::<AtomicBool>::default();
        let (admitting, asked) = (Arc::clone(&gate), Arc::clone(&is_asked));
        ctx.set_repaint_observer(Box::new(move |info: RequestRepaintInfo| {
            if info.delay.is_zero() && admitting.admits() {
                asked.store(true, Ordering::SeqCst);
            }
        }));
        let mut app = App::launch(Arc::new(|| {}), disk, options);
        app.edit_wait = Duration::from_secs(60);
        // Another step would be another text in the bar.
        app.settings.grid_step_m = Some(2.0);
        let mut screen = Self {
            ctx,
            app,
            gate,
            is_asked,
            time_s: 0.0,
        };
        screen.rest();
        screen
    }

    /// Shows frames until nothing more changes.
    fn rest(&mut self) {
        while self.app.document().is_none() || !self.app.is_settled() {
            self.frame(Vec::new());
            thread::sleep(Duration::from_millis(2));
        }
        for _ in 0..8 {
            self.frame(Vec::new());
        }
    }

    /// Shows a frame. Returns `true` if another one must follow.
    fn frame(&mut self, events: Vec<Event>) -> bool {
        self.time_s += 0.1;
        self.is_asked.store(false, Ordering::SeqCst);
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(1200.0, 800.0))),
            time: Some(self.time_s),
            events,
            ..RawInput::default()
        };
        self.gate.begin();
        let (app, gate) = (&mut self.app, &self.gate);
        let mut output = self.ctx.run_ui(input, |ui| {
            gate.show(ui.ctx());
            app.show(ui);
            gate.end(ui.ctx(), app.changes_late);
        });
        output.textures_delta.clear();
        self.is_asked.load(Ordering::SeqCst)
    }

    /// The frames that show these events.
    fn presented(&mut self, events: Vec<Event>) -> u32 {
        self.rest();
        let mut count = 1;
        let mut goes_on = self.frame(events);
        while goes_on && count < 20 {
            goes_on = self.frame(Vec::new());
            count += 1;
        }
        count
    }

    /// The frames of a key that goes down and up.
    fn of_key(&mut self, key: Key, text: Option<&str>) -> [u32; 2] {
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: NONE,
        };
        let text = text.map(|text| Event::Text(text.into()));
        let down = [event(true)].into_iter().chain(text).collect();
        [down, vec![event(false)]].map(|events| self.presented(events))
    }
}

#[test]
fn keys_that_move_the_camera_present_one_frame() {
    let mut screen = Screen::new();
    let moved = Event::PointerMoved(Pos2::new(300.0, 300.0));
    assert_eq!(screen.presented(vec![moved]), 1);
    let view = |screen: &Screen| screen.app.canvas.camera.view();
    for (key, text) in [
        (Key::ArrowLeft, None),
        (Key::ArrowUp, None),
        (Key::Plus, Some("+")),
        (Key::Minus, Some("-")),
        (Key::F, Some("f")),
    ] {
        let before = view(&screen);
        assert_eq!(screen.of_key(key, text), [1, 1], "{key:?}");
        assert_ne!(view(&screen), before, "{key:?}");
    }
}

#[test]
fn keys_that_change_more_than_the_camera_present_what_follows() {
    let mut screen = Screen::new();
    // A tool is told by parts that are shown before others.
    let [down, up] = screen.of_key(Key::D, Some("d"));
    assert!(down >= 3 && up == 1, "{down} {up}");
    // Typed input of a tool.
    let [down, up] = screen.of_key(Key::Num1, Some("1"));
    assert!(down >= 3 && up == 1, "{down} {up}");
    screen.of_key(Key::Escape, None);
    screen.of_key(Key::Escape, None);
    // The arrow moves what is selected.
    screen.app.edit(EditTask::view_change(
        guideway_document::Document::select_all,
    ));
    let [down, _] = screen.of_key(Key::ArrowLeft, None);
    assert!(down >= 3, "{down}");
    screen.of_key(Key::Escape, None);
    // It moves the caret of a field.
    screen.app.side.open(SideTab::Find);
    screen.app.find.wants_focus = true;
    let [down, _] = screen.of_key(Key::ArrowLeft, None);
    assert!(down >= 3, "{down}");
}
