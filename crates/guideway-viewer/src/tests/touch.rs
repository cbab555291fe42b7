//! Input of fingers on trackpads and touch screens.

use eframe::egui::{
    Event, Modifiers, MouseWheelSource, MouseWheelUnit, Pos2, TouchDeviceId, TouchId, TouchPhase,
    Vec2,
};

use super::services::lanes;
use super::test_window::TestWindow;

/// Center of five lanes, in meters.
const MIDDLE: (f64, f64) = (5.0, 4.0);

fn middle(window: &mut TestWindow) -> Pos2 {
    window.at(MIDDLE.0, MIDDLE.1)
}

fn scale(window: &mut TestWindow) -> f64 {
    window.app().canvas.camera.view().unwrap().px_per_m()
}

#[test]
fn trackpad_pans_with_two_fingers_and_zooms_with_a_pinch() {
    let mut window = TestWindow::showing(lanes(5));
    let at = middle(&mut window);
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    let by = Vec2::new(30.0, -20.0);
    window.harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: by,
        phase: TouchPhase::Move,
        source: MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.harness.step();
    assert!(middle(&mut window).distance(at + by) < 0.1);
    let before = scale(&mut window);
    window.harness.event(Event::Zoom(2.0));
    window.harness.step();
    assert!((scale(&mut window) / before - 2.0).abs() < 0.01);
}

#[test]
fn touch_screen_pans_and_zooms_at_once() {
    let mut window = TestWindow::showing(lanes(5));
    let at = middle(&mut window);
    let before = scale(&mut window);
    let touch = |window: &mut TestWindow, phase, middle: Pos2, apart: f32| {
        for (id, side) in [(1, -0.5), (2, 0.5)] {
            window.harness.event(Event::Touch {
                device_id: TouchDeviceId(7),
                id: TouchId(id),
                phase,
                pos: middle + Vec2::new(side * apart, 0.0),
                force: None,
            });
        }
        window.harness.step();
    };
    // The first finger also acts as the pointer.
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    let to = at + Vec2::new(40.0, 10.0);
    touch(&mut window, TouchPhase::Start, at, 100.0);
    touch(&mut window, TouchPhase::Move, to, 200.0);
    touch(&mut window, TouchPhase::End, to, 200.0);
    let enlarged = scale(&mut window) / before;
    assert!((enlarged - 2.0).abs() < 0.01, "{enlarged}");
    let now = middle(&mut window);
    assert!(now.distance(to) < 1.0, "{now:?} {to:?}");
}
