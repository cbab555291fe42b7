//! Typed lengths, angles, coordinates and radii, in place of clicks.

use eframe::egui::{Event, Key, Modifiers};
use guideway_scene::Table;
use guideway_spline::Point;

use super::drawing::{click, new_layout, node_at};
use super::services::lanes;
use super::test_window::{TestWindow, drawn_texts};
use crate::tools::Gesture;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn typed_points_are_exact_and_a_right_click_finishes() {
    let mut window = new_layout();
    window.key(NONE, Key::D);
    window.type_line("0,0");
    window.type_line("5<90");
    window.type_line("@3,1");
    // A length goes in the direction of the pointer.
    let at = window.at(8.0, 6.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    window.type_line("2.5");
    window.right_click(at);
    let document = window.document();
    assert_eq!(document.existing(Table::Paths).count(), 3);
    for (x, y) in [(0.0, 0.0), (0.0, 5.0), (3.0, 6.0), (5.5, 6.0)] {
        let near = document.node_near(Point::new(x, y), 0.02);
        assert!(near.is_some(), "a node at {x}, {y}");
    }
    assert!(node_at(document, 3.0, 6.0).is_some());
    window.key(CTRL, Key::Z);
    assert_eq!(window.document().existing(Table::Nodes).count(), 0);
}

#[test]
fn length_typed_on_the_start_goes_on_in_the_last_direction_and_is_shown() {
    let mut window = new_layout();
    window.key(NONE, Key::D);
    // Without a line there is no last direction: the x axis counts.
    click(&mut window, 0.0, 0.0);
    let start = window.at(0.0, 0.0);
    for (typed, shown, end) in [
        ("5", "5 m at 0.0°", (5.0, 0.0)),
        ("3<90", "3 m at 90.0°, 8 m in total", (5.0, 3.0)),
        ("2", "2 m at 90.0°, 10 m in total", (5.0, 5.0)),
    ] {
        let (x, y) = end;
        window.harness.event(Event::Text(typed.into()));
        window.harness.run_steps(2);
        assert!(drawn_texts(&window).iter().any(|text| text == shown));
        window.key(NONE, Key::Enter);
        let points = match window.app().tools.gesture() {
            Gesture::Points(points) => points.clone(),
            gesture => panic!("{gesture:?}"),
        };
        let last = *points.last().unwrap();
        assert!(last.distance(Point::new(x, y)) < 0.05, "{typed}: {last:?}");
        let at = window.at(x, y);
        window.harness.event(Event::PointerMoved(at));
        window.harness.step();
    }
    window.harness.event(Event::PointerMoved(start));
    window.key(NONE, Key::Enter);
    assert_eq!(window.document().existing(Table::Paths).count(), 3);
    // A radius is shown as the arc that it means.
    window.key(NONE, Key::O);
    window.type_line("20,0");
    window.type_line("24,0");
    window.harness.event(Event::Text("r2".into()));
    window.harness.run_steps(2);
    let texts = drawn_texts(&window);
    assert!(
        texts.iter().any(|text| text.contains("tightest bend 2 m")),
        "{texts:?}"
    );
}

#[test]
fn minus_begins_a_point_instead_of_zooming_out() {
    let mut window = TestWindow::showing(lanes(1));
    let scale = |window: &mut TestWindow| window.app().canvas.camera.view().unwrap().px_per_m();
    let before = scale(&mut window);
    window.key(NONE, Key::D);
    for point in ["-3,-4", "-1,-4"] {
        window.key(NONE, Key::Minus);
        window.type_line(point);
    }
    window.key(NONE, Key::Enter);
    assert_eq!(scale(&mut window), before);
    let ends = window.document().layout().paths.get(1).ends().unwrap();
    assert_eq!(ends, (Point::new(-3.0, -4.0), Point::new(-1.0, -4.0)));
    window.key(NONE, Key::V);
    window.key(NONE, Key::Minus);
    assert!(scale(&mut window) < before, "no tool that adds points");
}

#[test]
fn wrong_text_stays_with_its_error_and_escape_closes_it_first() {
    let mut window = new_layout();
    window.key(NONE, Key::D);
    window.type_line("5");
    let error = |window: &mut TestWindow| {
        let typed = window.app().tools.typed().cloned();
        typed.and_then(|typed| typed.error)
    };
    assert!(error(&mut window).unwrap().contains("first point"));
    window.key(NONE, Key::Escape);
    assert!(window.app().tools.typed().is_none());
    window.type_line("1,1");
    window.type_line("5<x");
    assert!(error(&mut window).unwrap().contains("`x` is no number"));
    for _ in 0.."x".len() {
        window.key(NONE, Key::Backspace);
    }
    window.type_line("0");
    window.key(NONE, Key::Enter);
    assert!(node_at(window.document(), 6.0, 1.0).is_some());
    // Letters are no commands while a text is typed; Tab opens one without a digit.
    window.key(NONE, Key::Tab);
    window.key(NONE, Key::C);
    assert_eq!(window.app().tools.tool(), crate::tools::Tool::Line);
}

#[test]
fn text_and_enter_of_one_frame_count_in_their_order() {
    let mut window = new_layout();
    window.key(NONE, Key::D);
    let enter = [true, false].map(|pressed| Event::Key {
        key: Key::Enter,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: NONE,
    });
    let mut events = Vec::new();
    for text in ["0,0", "4,0"] {
        events.extend(text.chars().map(|sign| Event::Text(sign.into())));
        events.extend(enter.clone());
    }
    events.extend(enter.clone());
    window.harness.input_mut().events.extend(events);
    window.harness.run_steps(3);
    assert_eq!(window.document().existing(Table::Paths).count(), 1);
}
