//! Turns the presses, moves and releases of a pointer into drags, clicks and pans.
//!
//! It takes the events of the window in the order in which they came, whatever the frame rate: a
//! whole drag may happen between two frames.

use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Vec2};

use super::screen::Screen;
use crate::tools::PointerEvent;

/// Greatest distance between press and release of a click, in points.
const CLICK_REACH: f32 = 6.0;
/// Longest time between the clicks of a double click, in seconds.
const DOUBLE_CLICK_S: f64 = 0.3;

/// The pressed button, if any, and the last click.
#[derive(Default)]
pub(crate) struct PointerTracker {
    press: Option<Press>,
    /// Time in seconds and place of the last click.
    last_click: Option<(f64, Pos2)>,
    /// The last known place of the pointer in the window.
    at: Option<Pos2>,
}

struct Press {
    button: PointerButton,
    from: Pos2,
    last: Pos2,
    /// True once the pointer has left the reach of a click.
    is_drag: bool,
    /// True if a drag pans the camera instead of reaching the tools.
    pans: bool,
}

/// The state of the window at the time of an event.
#[derive(Clone, Copy)]
pub(crate) struct PointerInput {
    pub(crate) screen: Screen,
    /// Time of the frame, in seconds.
    pub(crate) time_s: f64,
    pub(crate) modifiers: Modifiers,
    /// True if nothing covers the canvas at the place of the event.
    pub(crate) is_on_canvas: bool,
    /// True if drags of the primary button pan.
    pub(crate) primary_pans: bool,
}

/// The effect of an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PointerStep {
    /// Pans the camera by points of the window.
    Pan(Vec2),
    /// Reaches the tools.
    Tool(PointerEvent),
}

impl PointerTracker {
    /// The last known place of the pointer in the window.
    pub(crate) fn at(&self) -> Option<Pos2> {
        self.at
    }

    /// Takes another place of the pointer. Returns the present one.
    pub(super) fn exchange_at(&mut self, at: Option<Pos2>) -> Option<Pos2> {
        std::mem::replace(&mut self.at, at)
    }

    /// Returns `true` while a button that went down on the canvas is down.
    pub(crate) fn is_pressed(&self) -> bool {
        self.press.is_some()
    }

    /// Returns `true` during a drag that pans.
    pub(crate) fn is_panning(&self) -> bool {
        let press = self.press.as_ref();
        press.is_some_and(|press| press.is_drag && press.pans)
    }

    /// Forgets the pressed button: the rest of its drag has no effect.
    pub(crate) fn release(&mut self) {
        self.press = None;
    }

    /// Handles an event and appends its effects to `steps`.
    pub(crate) fn handle(
        &mut self,
        event: &Event,
        input: &PointerInput,
        steps: &mut Vec<PointerStep>,
    ) {
        match *event {
            Event::PointerMoved(at) => self.moved(at, input, steps),
            Event::PointerButton {
                pos,
                button,
                pressed,
                modifiers,
            } => {
                let input = PointerInput {
                    modifiers,
                    ..*input
                };
                match pressed {
                    true => self.pressed(pos, button, &input, steps),
                    false => self.released(pos, button, &input, steps),
                }
            }
            Event::PointerGone => self.at = None,
            _ => {}
        }
    }

    fn pressed(
        &mut self,
        at: Pos2,
        button: PointerButton,
        input: &PointerInput,
        steps: &mut Vec<PointerStep>,
    ) {
        self.at = Some(at);
        if let Some(press) = &self.press {
            // The other button during a drag takes the drag back.
            if press.is_drag && !press.pans && press.button != button {
                steps.push(PointerStep::Tool(PointerEvent::Cancelled));
                self.press = None;
            }
            return;
        }
        let is_known = matches!(
            button,
            PointerButton::Primary | PointerButton::Secondary | PointerButton::Middle
        );
        self.press = (is_known && input.is_on_canvas).then_some(Press {
            button,
            from: at,
            last: at,
            is_drag: false,
            pans: input.primary_pans || button != PointerButton::Primary,
        });
    }

    fn moved(&mut self, at: Pos2, input: &PointerInput, steps: &mut Vec<PointerStep>) {
        self.at = Some(at);
        let Some(press) = &mut self.press else {
            return;
        };
        let begins = !press.is_drag && at.distance(press.from) > CLICK_REACH;
        press.is_drag |= begins;
        if begins && !press.pans {
            let from_px = input.screen.pixel(press.from);
            steps.push(PointerStep::Tool(PointerEvent::DragStarted(from_px)));
        }
        if press.is_drag && at != press.last {
            let dragged = PointerEvent::Dragged(input.screen.pixel(at), input.modifiers);
            steps.push(match press.pans {
                true => PointerStep::Pan(at - press.last),
                false => PointerStep::Tool(dragged),
            });
            press.last = at;
        }
    }

    fn released(
        &mut self,
        at: Pos2,
        button: PointerButton,
        input: &PointerInput,
        steps: &mut Vec<PointerStep>,
    ) {
        self.moved(at, input, steps);
        let Some(press) = self.press.take_if(|press| press.button == button) else {
            return;
        };
        if press.is_drag {
            let ended = PointerStep::Tool(PointerEvent::DragEnded(input.modifiers));
            steps.extend((!press.pans).then_some(ended));
        } else if button == PointerButton::Secondary {
            steps.push(PointerStep::Tool(PointerEvent::SecondaryClicked));
        } else if button == PointerButton::Primary {
            let at_px = input.screen.pixel(at);
            let clicked = PointerEvent::Clicked(at_px, input.modifiers);
            steps.push(PointerStep::Tool(clicked));
            let is_second = |(time_s, place): (f64, Pos2)| {
                input.time_s - time_s <= DOUBLE_CLICK_S && at.distance(place) <= CLICK_REACH
            };
            self.last_click = match self.last_click.is_some_and(is_second) {
                true => {
                    steps.push(PointerStep::Tool(PointerEvent::DoubleClicked));
                    None
                }
                false => Some((input.time_s, at)),
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Rect, pos2};
    use guideway_spline::Point;

    use super::*;

    const NONE: Modifiers = Modifiers::NONE;

    fn steps(events: &[Event], time_s: f64, tracker: &mut PointerTracker) -> Vec<PointerStep> {
        let input = PointerInput {
            screen: Screen {
                rect: Rect::from_min_size(Pos2::ZERO, Vec2::new(200.0, 100.0)),
                px_per_point: 1.0,
            },
            time_s,
            modifiers: NONE,
            is_on_canvas: true,
            primary_pans: false,
        };
        let mut steps = Vec::new();
        for event in events {
            tracker.handle(event, &input, &mut steps);
        }
        steps
    }

    fn button(at: Pos2, button: PointerButton, pressed: bool) -> Event {
        Event::PointerButton {
            pos: at,
            button,
            pressed,
            modifiers: NONE,
        }
    }

    #[test]
    fn drag_between_two_frames_is_whole() {
        let (from, to) = (pos2(10.0, 10.0), pos2(60.0, 40.0));
        let events = [
            button(from, PointerButton::Primary, true),
            Event::PointerMoved(to),
            button(to, PointerButton::Primary, false),
        ];
        let to_px = Point::new(60.0, 40.0);
        let expected = [
            PointerEvent::DragStarted(Point::new(10.0, 10.0)),
            PointerEvent::Dragged(to_px, NONE),
            PointerEvent::DragEnded(NONE),
        ];
        let tracker = &mut PointerTracker::default();
        assert_eq!(
            steps(&events, 0.0, tracker),
            expected.map(PointerStep::Tool)
        );
        // The same by the right button pans.
        let events = [
            button(from, PointerButton::Secondary, true),
            button(to, PointerButton::Secondary, false),
        ];
        let expected = [PointerStep::Pan(Vec2::new(50.0, 30.0))];
        assert_eq!(steps(&events, 0.0, tracker), expected);
    }

    #[test]
    fn right_click_without_a_drag_reaches_the_tools() {
        let at = pos2(10.0, 10.0);
        let events = [true, false].map(|pressed| button(at, PointerButton::Secondary, pressed));
        let expected = [PointerStep::Tool(PointerEvent::SecondaryClicked)];
        assert_eq!(
            steps(&events, 0.0, &mut PointerTracker::default()),
            expected
        );
    }

    #[test]
    fn second_click_in_time_and_reach_is_a_double_click() {
        let click = |x| {
            let at = pos2(x, 10.0);
            [true, false].map(|pressed| button(at, PointerButton::Primary, pressed))
        };
        let tracker = &mut PointerTracker::default();
        let mut count = |x, time_s| steps(&click(x), time_s, tracker).len();
        assert_eq!([count(10.0, 0.0), count(12.0, 0.2)], [1, 2]);
        assert_eq!(count(12.0, 0.3), 1, "a third click is the first again");
        assert_eq!(count(40.0, 0.4), 1, "too far away");
        assert_eq!(count(40.0, 0.8), 1, "too late");
    }

    #[test]
    fn other_button_takes_a_drag_back() {
        let events = [
            button(pos2(10.0, 10.0), PointerButton::Primary, true),
            Event::PointerMoved(pos2(60.0, 40.0)),
            button(pos2(60.0, 40.0), PointerButton::Secondary, true),
            Event::PointerMoved(pos2(90.0, 40.0)),
            button(pos2(90.0, 40.0), PointerButton::Primary, false),
        ];
        let steps = steps(&events, 0.0, &mut PointerTracker::default());
        assert_eq!(steps.len(), 3);
        assert_eq!(steps[2], PointerStep::Tool(PointerEvent::Cancelled));
    }
}
