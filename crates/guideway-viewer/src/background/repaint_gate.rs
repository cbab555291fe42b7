//! Decides which of egui's requests for a repaint show a frame. By itself egui shows three frames
//! per input event, so that late changes settle; each costs a whole window, which a processor
//! without graphics hardware draws in a tenth of a second.

use std::mem;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::{self, ThreadId};

use eframe::egui::{Context, Event, Vec2};

/// First frames, in which the parts of the window find their places, and which follow each other.
const FIRST_FRAMES: u32 = 3;
/// Passes that lay the frame of a click or a key out again: a button may change a part that is laid
/// out before it, and a menu finds its size in its first pass. Only the last pass is drawn.
const LATE_PASSES: u32 = 2;
/// Most passes of a frame: these, and one for what egui itself lays out again.
const MAX_PASSES: NonZeroUsize = NonZeroUsize::new(LATE_PASSES as usize + 2).unwrap();

/// Admits what the window and its threads ask for, and leaves out what egui adds.
pub(crate) struct RepaintGate {
    /// The thread that shows frames.
    window_thread: ThreadId,
    stage: Mutex<Stage>,
    /// Passes that follow this one.
    due: AtomicU32,
    passes: AtomicU32,
}

/// The part of a frame in which the window is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// A pass begins, for which egui makes its requests.
    Begins,
    /// The window is laid out. A frame must follow if this pass is the last one.
    IsLaidOut { is_followed: bool },
    /// The last pass has laid the window out.
    Rests,
}

impl RepaintGate {
    /// A gate for the window of this thread.
    pub(crate) fn new(ctx: &Context) -> Self {
        ctx.options_mut(|options| options.max_passes = MAX_PASSES);
        Self {
            window_thread: thread::current().id(),
            stage: Mutex::new(Stage::Rests),
            due: AtomicU32::new(0),
            passes: AtomicU32::new(0),
        }
    }

    /// A frame begins.
    pub(crate) fn begin(&self) {
        *self.stage() = Stage::Begins;
    }

    /// The window is about to be laid out: requests count from now on.
    pub(crate) fn show(&self, ctx: &Context) {
        // egui spreads a turn of the wheel over several frames.
        let is_followed = ctx.input(|input| input.smooth_scroll_delta() != Vec2::ZERO);
        *self.stage() = Stage::IsLaidOut { is_followed };
    }

    /// The window is laid out. With `changes_late`, its parts may show the input of this pass in
    /// those that follow only.
    pub(crate) fn end(&self, ctx: &Context, changes_late: bool) {
        let is_first = self.passes.fetch_add(1, Ordering::SeqCst) < FIRST_FRAMES;
        let wanted = if changes_late { LATE_PASSES } else { 0 };
        let due = self.due.load(Ordering::SeqCst).max(wanted);
        self.due.store(due.saturating_sub(1), Ordering::SeqCst);
        if due > 0 {
            lay_out_again(ctx, "parts of the window show this input later");
        }
        let is_last = !ctx.will_discard();
        let next = if is_last { Stage::Rests } else { Stage::Begins };
        let ended = mem::replace(&mut *self.stage(), next);
        if is_last && (is_first || ended == Stage::IsLaidOut { is_followed: true }) {
            ctx.request_repaint();
        }
    }

    /// Returns `true` if a request that is made now shows a frame.
    pub(crate) fn admits(&self) -> bool {
        if thread::current().id() != self.window_thread {
            return true;
        }
        let mut stage = self.stage();
        match &mut *stage {
            Stage::Begins => false,
            Stage::IsLaidOut { is_followed } => {
                *is_followed = true;
                false
            }
            Stage::Rests => true,
        }
    }

    fn stage(&self) -> MutexGuard<'_, Stage> {
        // A stage is complete at any time.
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Asks for another pass of this frame, or for another frame after the last pass.
pub(crate) fn lay_out_again(ctx: &Context, reason: &'static str) {
    match ctx.current_pass_index() + 1 < MAX_PASSES.get() {
        true => ctx.request_discard(reason),
        false => ctx.request_repaint(),
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
    use std::cell::Cell;
    use std::sync::Arc;
    use std::sync::atomic::AtomicUsize;

    use eframe::egui::{Key, Modifiers, PointerButton, Pos2, RawInput, RequestRepaintInfo};

    use super::*;

    /// As [`frames_of`], of a window that asks for nothing itself.
    fn frames_for(events: Vec<Event>, has_gate: bool) -> [usize; 2] {
        frames_of(events, has_gate, None)
    }

    /// Runs frames as eframe does: one for the events, then one per admitted request. The window
    /// asks for another frame in one pass of the first. Returns the number of frames, and that of
    /// passes.
    fn frames_of(events: Vec<Event>, has_gate: bool, asking: Option<usize>) -> [usize; 2] {
        let ctx = Context::default();
        let gate = Arc::new(RepaintGate::new(&ctx));
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
        let (passes, asking_pass) = (Cell::new(0), Cell::new(None));
        let frame = |events: Vec<Event>| {
            requests.store(0, Ordering::SeqCst);
            let input = RawInput {
                events,
                ..RawInput::default()
            };
            gate.begin();
            let mut output = ctx.run_ui(input, |ui| {
                gate.show(ui.ctx());
                ui.label("a window");
                if asking_pass.get() == Some(ui.current_pass_index()) {
                    asking_pass.set(None);
                    ui.request_repaint();
                }
                let changes_late = ui.input(|input| input.events.iter().any(changes_parts_late));
                gate.end(ui.ctx(), changes_late);
            });
            output.textures_delta.clear();
            passes.set(passes.get() + output.platform_output.num_completed_passes);
            requests.load(Ordering::SeqCst) > 0
        };
        for _ in 0..10 {
            frame(Vec::new());
        }
        passes.set(0);
        asking_pass.set(asking);
        let mut count = 1;
        let mut goes_on = frame(events);
        while goes_on && count < 100 {
            goes_on = frame(Vec::new());
            count += 1;
        }
        [count, passes.get()]
    }

    fn key(pressed: bool) -> Event {
        Event::Key {
            key: Key::A,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers: Modifiers::NONE,
        }
    }

    #[test]
    fn one_frame_per_event_whose_changes_settle_before_it_is_drawn() {
        let at = Pos2::new(5.0, 5.0);
        let moved = vec![Event::PointerMoved(at)];
        assert_eq!(frames_for(moved.clone(), false), [3, 3], "egui alone");
        assert_eq!(frames_for(moved, true), [1, 1]);
        let press = Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        };
        assert_eq!(frames_for(vec![press], true), [1, 3]);
        assert_eq!(frames_for(vec![], true), [1, 1]);
        assert_eq!(frames_for(vec![key(true)], true), [1, 3]);
        assert_eq!(frames_for(vec![key(false)], true), [1, 1]);
    }

    #[test]
    fn requests_of_threads_count_at_any_time() {
        let gate = RepaintGate::new(&Context::default());
        gate.begin();
        assert!(!gate.admits());
        thread::scope(|scope| {
            let elsewhere = scope.spawn(|| gate.admits());
            assert!(elsewhere.join().unwrap());
        });
    }

    #[test]
    fn requests_of_the_last_pass_count() {
        let frames = |asking| frames_of(vec![key(true)], true, asking);
        assert_eq!(frames(Some(2)), [2, 4]);
        // The later passes show what the first one asked for.
        assert_eq!([frames(Some(0)), frames(Some(1))], [[1, 3]; 2]);
    }
}
