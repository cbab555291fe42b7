//! The frames that a window presents per event, without a screen.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use eframe::egui::{
    Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, RequestRepaintInfo, Vec2,
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
    /// Passes that laid the last frame out.
    passes: usize,
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
        let ctx = Context::default();
        // As where a processor draws: what appears does not fade in.
        ctx.all_styles_mut(|style| style.animation_time = 0.0);
        let gate = Arc::new(RepaintGate::new(&ctx));
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
            passes: 0,
            time_s: 0.0,
        };
        screen.rest();
        screen
    }

    /// Shows frames until nothing more changes.
    fn rest(&mut self) {
        self.frames_until(|app| app.document().is_some() && app.is_settled());
        // Some frames after an edit, a check begins whose count may move a part of the window.
        self.frames_until(|app| !app.files.layers()[0].tasks.is_checking());
    }

    /// Shows frames until `is_done`, and eight more.
    fn frames_until(&mut self, is_done: impl Fn(&App) -> bool) {
        while !is_done(&self.app) {
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
        self.passes = output.platform_output.num_completed_passes;
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

    /// Asserts that a key shows one frame whose changes settle before it is drawn, and another one
    /// when it goes up.
    #[track_caller]
    fn settles(&mut self, key: Key, text: Option<&str>) {
        let [down, _] = self.events_of(key, text);
        assert_eq!(self.presented(down), 1);
        assert!(self.passes >= 3, "{}", self.passes);
        let [_, up] = self.events_of(key, text);
        assert_eq!(self.presented(up), 1);
    }

    /// The frames of a key that goes down and up.
    fn of_key(&mut self, key: Key, text: Option<&str>) -> [u32; 2] {
        self.events_of(key, text)
            .map(|events| self.presented(events))
    }

    /// The events of a key that goes down, with the text that it types, and up.
    fn events_of(&self, key: Key, text: Option<&str>) -> [Vec<Event>; 2] {
        let event = |pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: NONE,
        };
        let text = text.map(|text| Event::Text(text.into()));
        let down = [event(true)].into_iter().chain(text).collect();
        [down, vec![event(false)]]
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
fn keys_and_clicks_that_change_more_than_the_camera_settle_in_one_frame() {
    let mut screen = Screen::new();
    // A tool is told by parts that are shown before others.
    screen.settles(Key::D, Some("d"));
    // Typed input of a tool.
    screen.settles(Key::Num1, Some("1"));
    screen.of_key(Key::Escape, None);
    screen.of_key(Key::Escape, None);
    // The arrow moves what is selected.
    screen.app.edit(EditTask::view_change(
        guideway_document::Document::select_all,
    ));
    screen.settles(Key::ArrowLeft, None);
    screen.of_key(Key::Escape, None);
    // It moves the caret of a field.
    screen.app.side.open(SideTab::Find);
    screen.app.find.wants_focus = true;
    screen.settles(Key::ArrowLeft, None);
    screen.of_key(Key::Escape, None);
    let at = Pos2::new(300.0, 300.0);
    assert_eq!(screen.presented(vec![Event::PointerMoved(at)]), 1);
    for pressed in [true, false] {
        let button = Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: NONE,
        };
        assert_eq!(screen.presented(vec![button]), 1);
        assert!(screen.passes >= 3, "{}", screen.passes);
    }
}
