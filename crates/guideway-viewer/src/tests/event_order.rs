//! Events act in the order in which they came, also when several come in one frame, and when an
//! edit has the document.

use std::sync::mpsc::{self, Sender};
use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use guideway_document::{Document, Elements, Group, SelectMode};
use guideway_spline::Point;

use super::levels::two_levels;
use super::safety::{ids, in_one_frame, is_shown, key};
use super::services::lanes;
use super::test_window::{TestWindow, field};
use crate::editing::EditTask;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const QUESTION: &str = "On the level upper are 1 path, 2 nodes. What becomes of them?";

/// A window with one lane on each of two levels, of which the second is selected.
fn level_selected() -> TestWindow {
    let mut window = TestWindow::showing(two_levels());
    window.change(|document: &mut Document| {
        let upper = Elements::of_group(&Group::Level(1));
        document.select_elements(&upper, SelectMode::Replace);
    });
    window.harness.run_steps(3);
    window
}

/// Lets an edit keep the document until something is sent.
fn keep_document(window: &mut TestWindow) -> Sender<()> {
    let (done, rest) = mpsc::channel();
    window.app().edit_wait = Duration::ZERO;
    window.app().edit(EditTask::view_change(move |_| {
        // A sender that is gone ends the edit too.
        let _ = rest.recv();
    }));
    assert!(window.app().document().is_none());
    done
}

fn give_back(window: &mut TestWindow, done: &Sender<()>) {
    done.send(()).unwrap();
    window.wait(|app| app.document().is_some());
    window.harness.run_steps(3);
}

#[test]
fn delete_after_escape_in_one_frame_asks_at_once() {
    let mut window = level_selected();
    window.key(NONE, Key::Delete);
    window.harness.run_steps(2);
    assert!(is_shown(&window, QUESTION));
    // Escape closes the question, Delete asks it anew.
    in_one_frame(
        &mut window,
        key(Key::Escape).into_iter().chain(key(Key::Delete)),
    );
    assert!(is_shown(&window, QUESTION));
    in_one_frame(
        &mut window,
        key(Key::Delete).into_iter().chain(key(Key::Escape)),
    );
    assert!(!is_shown(&window, QUESTION));
    assert_eq!(window.document().layout().levels.len(), 2);
}

#[test]
fn keys_before_an_escape_belong_to_the_field_that_it_leaves() {
    let mut window = TestWindow::showing(lanes(3));
    let lane = window.at(5.0, 2.0);
    window.click(lane);
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(3);
    let type_in_field = |window: &mut TestWindow| {
        window.harness.get(field("lane 1")).focus();
        window.harness.run_steps(2);
        window.harness.event(Event::Text("x".into()));
        window.harness.run_steps(2);
    };
    type_in_field(&mut window);
    let letter = [Event::Text("d".into())];
    let events = key(Key::Delete).into_iter().chain(letter);
    in_one_frame(&mut window, events.chain(key(Key::Escape)));
    assert_eq!(ids(window.document()), ["lane 0", "lane 1", "lane 2"]);
    type_in_field(&mut window);
    in_one_frame(
        &mut window,
        key(Key::Escape).into_iter().chain(key(Key::Delete)),
    );
    assert_eq!(ids(window.document()), ["lane 0", "lane 2"]);
}

#[test]
fn commands_wait_for_a_document_that_an_edit_has() {
    let mut window = level_selected();
    let done = keep_document(&mut window);
    window.key(NONE, Key::Delete);
    window.key(NONE, Key::F2);
    assert!(!is_shown(&window, QUESTION));
    give_back(&mut window, &done);
    assert!(is_shown(&window, QUESTION));
    // Keys behind a question do nothing.
    assert!(!is_shown(&window, "New identifier of the level"));
    assert_eq!(window.document().layout().levels.len(), 2);
    assert_eq!(ids(window.document()).len(), 2);
    window.key(NONE, Key::Escape);
    let done = keep_document(&mut window);
    window.key(NONE, Key::Delete);
    window.key(NONE, Key::Escape);
    give_back(&mut window, &done);
    assert!(!is_shown(&window, QUESTION), "Escape takes it back");
}

#[test]
fn clicks_and_commands_that_wait_keep_their_order() {
    let mut window = TestWindow::showing(lanes(4));
    let lanes = [0.0, 2.0, 4.0].map(|y| window.at(5.0, y));
    let done = keep_document(&mut window);
    window.click(lanes[1]);
    window.key(NONE, Key::Delete);
    window.click(lanes[0]);
    window.key(NONE, Key::K);
    window.click(lanes[2]);
    give_back(&mut window, &done);
    window.wait(|app| app.files.is_settled());
    let names = ids(window.document()).len();
    assert_eq!(names, 4, "one is deleted, another one is split");
    assert!(!ids(window.document()).contains(&"lane 1"));
    assert_eq!(window.selected(), [2]);
}

#[test]
fn clicks_and_commands_that_wait_mean_the_places_of_their_time() {
    let mut window = TestWindow::showing(lanes(4));
    let lanes = [0.0, 2.0, 4.0].map(|y| window.at(2.0, y));
    window.click(lanes[0]);
    let done = keep_document(&mut window);
    window.key(NONE, Key::Delete);
    window.click(lanes[1]);
    window.key(NONE, Key::K);
    window.click(lanes[2]);
    // Everything is elsewhere when the document comes back.
    let view = window.app().canvas.camera.view();
    window.wheel(lanes[0] + Vec2::new(200.0, -100.0), 4.0);
    let moved = window.app().canvas.camera.view();
    assert_ne!(moved, view);
    give_back(&mut window, &done);
    window.wait(|app| app.files.is_settled());
    assert_eq!(window.app().canvas.camera.view(), moved, "the view stays");
    assert_eq!(
        ids(window.document()).len(),
        4,
        "one is deleted, one is split"
    );
    assert!(!ids(window.document()).contains(&"lane 0"));
    let node = window.document().node_near(Point::new(2.0, 2.0), 0.1);
    assert!(node.is_some(), "where the pointer was");
    let selected = window.selected();
    let name = window.document().layout().paths.id(selected[0] as usize);
    assert_eq!((selected.len(), name), (1, "lane 2"));
}

#[test]
fn box_keeps_its_corners_while_the_view_moves() {
    let mut window = TestWindow::showing(lanes(4));
    // Lanes are 10 m long and 2 m apart: the box holds the middle two.
    let corners = [window.at(-0.2, 1.0), window.at(10.2, 5.0)];
    window.press(corners[0], NONE);
    window.harness.event(Event::PointerMoved(corners[1]));
    window.harness.step();
    window.wheel(corners[1], -2.0);
    let end = window.at(10.2, 5.0);
    window.harness.event(Event::PointerMoved(end));
    window.harness.step();
    window.release(end, NONE);
    window.wait(|app| app.files.is_settled());
    assert_eq!(window.selected(), [1, 2]);
}

#[test]
fn arrow_keys_and_what_follows_them_wait_too() {
    let mut window = TestWindow::showing(lanes(3));
    let lane = window.at(5.0, 2.0);
    window.click(lane);
    let before = window.document().selection_bounds().unwrap();
    let view = window.app().canvas.camera.view();
    let done = keep_document(&mut window);
    for pressed in [Key::ArrowUp, Key::ArrowUp, Key::Delete] {
        window.key(NONE, pressed);
    }
    window.key(CTRL, Key::Z);
    give_back(&mut window, &done);
    window.wait(|app| app.files.is_settled());
    let after = window.document().selection_bounds().unwrap();
    assert!(
        after.min.y > before.min.y,
        "the lane moved, and was restored"
    );
    assert_eq!(ids(window.document()).len(), 3);
    assert_eq!(window.app().canvas.camera.view(), view, "the view did not");
    for _ in 0..2 {
        window.key(CTRL, Key::Z);
        window.wait(|app| app.files.is_settled());
    }
    assert!(!window.document().is_changed(), "two steps");
}
