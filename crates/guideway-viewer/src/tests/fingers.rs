//! What fingers do, on a trackpad and on a screen.

use eframe::egui::{
    Event, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, TouchDeviceId, TouchId, TouchPhase,
    Vec2,
};

use super::desk::Desk;
use super::table::lanes;

/// A place in the world that is in the middle of five lanes.
const MIDDLE: (f64, f64) = (5.0, 4.0);

fn middle(desk: &mut Desk) -> Pos2 {
    desk.at(MIDDLE.0, MIDDLE.1)
}

fn scale(desk: &mut Desk) -> f64 {
    desk.app().camera.view().unwrap().px_per_m()
}

#[test]
fn two_fingers_on_a_trackpad_move_the_view_and_spread_enlarge_it() {
    let mut desk = Desk::looking_at(lanes(5));
    let at = middle(&mut desk);
    desk.harness.event(Event::PointerMoved(at));
    desk.harness.step();
    let by = Vec2::new(30.0, -20.0);
    desk.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: by,
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    desk.harness.step();
    assert!(middle(&mut desk).distance(at + by) < 0.1);
    let before = scale(&mut desk);
    desk.harness.event(Event::Zoom(2.0));
    desk.harness.step();
    assert!((scale(&mut desk) / before - 2.0).abs() < 0.01);
}

#[test]
fn two_fingers_on_the_screen_move_and_enlarge_at_once() {
    let mut desk = Desk::looking_at(lanes(5));
    let at = middle(&mut desk);
    let before = scale(&mut desk);
    let touch = |desk: &mut Desk, phase, middle: Pos2, apart: f32| {
        for (id, side) in [(1, -0.5), (2, 0.5)] {
            desk.harness.event(Event::Touch {
                device_id: TouchDeviceId(7),
                id: TouchId(id),
                phase,
                pos: middle + Vec2::new(side * apart, 0.0),
                force: None,
            });
        }
        desk.harness.step();
    };
    // The first finger is the pointer too.
    desk.harness.event(Event::PointerMoved(at));
    desk.harness.step();
    let to = at + Vec2::new(40.0, 10.0);
    touch(&mut desk, TouchPhase::Start, at, 100.0);
    touch(&mut desk, TouchPhase::Move, to, 200.0);
    touch(&mut desk, TouchPhase::End, to, 200.0);
    let enlarged = scale(&mut desk) / before;
    assert!((enlarged - 2.0).abs() < 0.01, "{enlarged}");
    let now = middle(&mut desk);
    assert!(now.distance(to) < 1.0, "{now:?} {to:?}");
}
