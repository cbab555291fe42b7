//! Decides which of egui's requests for a repaint show a frame. By itself egui shows three frames
//! per input event, so that late changes settle; each costs a whole window, which a processor
//! without graphics hardware draws in a tenth of a second.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::thread::{self, ThreadId};

use eframe::egui::{Context, Event, Vec2};

/// First frames, in which the parts of the window find their places, and which follow each other.
const FIRST_FRAMES: u32 = 3;
/// Frames that follow a click or a key: a button may change a part that is shown before it, and a
/// menu finds its size in its first frame.
const LATE_FRAMES: u32 = 2;

/// Admits what the window and its threads ask for, and leaves out what egui adds.
pub(crate) struct RepaintGate {
    /// The thread that shows frames.
    window_thread: ThreadId,
    /// True from the begin of a frame until the window is shown: egui makes its requests then.
    is_beginning: AtomicBool,
    /// Frames that follow this one.
    due: AtomicU32,
    frames: AtomicU32,
}

impl RepaintGate {
    /// A gate for the window of this thread.
    pub(crate) fn new() -> Self {
        Self {
            window_thread: thread::current().id(),
            is_beginning: AtomicBool::new(false),
            due: AtomicU32::new(0),
            frames: AtomicU32::new(0),
        }
    }

    /// A frame begins.
    pub(crate) fn begin(&self) {
        self.is_beginning.store(true, Ordering::SeqCst);
    }

    /// The window is about to be shown: requests count from now on.
    pub(crate) fn show(&self, ctx: &Context) {
        self.is_beginning.store(false, Ordering::SeqCst);
        // egui spreads a turn of the wheel over several frames.
        if ctx.input(|input| input.smooth_scroll_delta() != Vec2::ZERO) {
            ctx.request_repaint();
        }
    }

    /// The window is shown. With `changes_late`, its parts may show the input of the frame in the
    /// frames that follow only.
    pub(crate) fn end(&self, ctx: &Context, changes_late: bool) {
        let is_first = self.frames.fetch_add(1, Ordering::SeqCst) < FIRST_FRAMES;
        let wanted = match changes_late {
            true => LATE_FRAMES,
            false => u32::from(is_first),
        };
        let due = self.due.load(Ordering::SeqCst).max(wanted);
        self.due.store(due.saturating_sub(1), Ordering::SeqCst);
        if due > 0 {
            ctx.request_repaint();
        }
    }

    /// Returns `true` if a request that is made now shows a frame.
    pub(crate) fn admits(&self) -> bool {
        let is_of_egui = self.is_beginning.load(Ordering::SeqCst);
        !is_of_egui || thread::current().id() != self.window_thread
    }
}

/// Returns `true` if an event may change a part of the window that is shown before the part which
/// handles it, as a button does. All parts know the place of the pointer, a wheel goes on by
/// itself, and keys act when they go down.
pub(crate) fn changes_parts_late(event: &Event) -> bool {
    !matches!(
        event,
        Event::PointerMoved(_)
            | Event::MouseMoved(_)
            | Event::MouseWheel { .. }
            | Event::ModifiersChanged(_)
            | Event::Key { pressed: false, .. }
    )
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::AtomicUsize;

    use eframe::egui::{Key, Modifiers, PointerButton, Pos2, RawInput, RequestRepaintInfo};

    use super::*;

    /// Runs frames as eframe does: one for the events, then one per admitted request.
    fn frames_for(events: Vec<Event>, has_gate: bool) -> usize {
        let (ctx, gate) = (Context::default(), Arc::new(RepaintGate::new()));
        let requests = Arc::<AtomicUsize>::default();
        let (counted, watched) = (Arc::clone(&requests), Arc::clone(&gate));
        match has_gate {
            true => ctx.set_repaint_observer(Box::new(move |info: RequestRepaintInfo| {
                if info.delay.is_zero() && watched.admits() {
                    counted.fetch_add(1, Ordering::SeqCst);
                }
            })),
            false => ctx.set_request_repaint_callback(move |_| {
                counted.fetch_add(1, Ordering::SeqCst);
            }),
        }
        let frame = |events: Vec<Event>| {
            requests.store(0, Ordering::SeqCst);
            let changes_late = events.iter().any(changes_parts_late);
            let input = RawInput {
                events,
                ..RawInput::default()
            };
            gate.begin();
            let mut output = ctx.run_ui(input, |ui| {
                gate.show(ui.ctx());
                ui.label("a window");
                gate.end(ui.ctx(), changes_late);
            });
            output.textures_delta.clear();
            requests.load(Ordering::SeqCst) > 0
        };
        for _ in 0..10 {
            frame(Vec::new());
        }
        let mut count = 1;
        let mut goes_on = frame(events);
        while goes_on && count < 100 {
            goes_on = frame(Vec::new());
            count += 1;
        }
        count
    }

    #[test]
    fn one_frame_per_movement_and_released_key_and_three_per_click() {
        let at = Pos2::new(5.0, 5.0);
        let moved = vec![Event::PointerMoved(at)];
        assert_eq!(frames_for(moved.clone(), false), 3, "what egui does alone");
        assert_eq!(frames_for(moved, true), 1);
        let press = Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(frames_for(vec![press], true), 3);
        assert_eq!(frames_for(vec![], true), 1);
        let key = |pressed| Event::Key {
            key: Key::A,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(
            [true, false].map(|on| frames_for(vec![key(on)], true)),
            [3, 1]
        );
    }

    #[test]
    fn requests_of_threads_count_at_any_time() {
        let gate = RepaintGate::new();
        gate.begin();
        assert!(!gate.admits());
        thread::scope(|scope| {
            let elsewhere = scope.spawn(|| gate.admits());
            assert!(elsewhere.join().unwrap());
        });
        gate.show(&Context::default());
        assert!(gate.admits());
    }
}
