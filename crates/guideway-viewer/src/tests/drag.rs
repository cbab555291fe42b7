//! Drags of selections, nodes and control points.

use eframe::egui::{Event, Key, Modifiers, Vec2};
use guideway_spline::Point;

use super::lane_network::network;
use super::services::lanes;
use super::test_window::TestWindow;
use crate::app::App;
use crate::tools::Tool;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn dragged_selection_moves_and_undo_restores_it() {
    let mut window = TestWindow::showing(lanes(5));
    let from = window.at(5.0, 4.0);
    window.click(from);
    let to = window.at(6.0, 5.0);
    window.drag(from, to);
    let start = |window: &mut TestWindow| window.document().layout().paths.get(2).ends().unwrap().0;
    assert!(start(&mut window).distance(Point::new(1.0, 5.0)) < 1e-6);
    assert!(window.document().is_changed());
    window.wait(|app| app.files.layers()[0].picture.shown().is_some());
    window.key(CTRL, Key::Z);
    assert_eq!(start(&mut window), Point::new(0.0, 4.0));
    assert!(!window.document().is_changed());
    window.key(CTRL | Modifiers::SHIFT, Key::Z);
    assert!(window.document().is_changed());
}

#[test]
fn ctrl_at_the_end_of_a_drag_leaves_neighbors_alone() {
    let ends = |window: &mut TestWindow, row| {
        let ends = window.document().layout().paths.get(row).ends().unwrap();
        [ends.0, ends.1]
    };
    for (modifiers, follows) in [(NONE, true), (CTRL, false)] {
        let mut window = TestWindow::showing(network(2 * 3));
        window.key(NONE, Key::F);
        // Lane 1 ends at links to the lanes beside it.
        let from = window.at(5.0, 2.0);
        window.click(from);
        let links = [6, 7].map(|row| ends(&mut window, row));
        let to = window.at(8.0, 2.0);
        window.press(from, NONE);
        window.harness.event(Event::PointerMoved(to));
        window.harness.step();
        window.release(to, modifiers);
        let moved = ends(&mut window, 1)[0];
        assert!(moved.distance(Point::new(3.0, 2.0)) < 0.1, "{moved:?}");
        let after = [6, 7].map(|row| ends(&mut window, row));
        assert_eq!(after != links, follows, "{after:?}");
    }
}

#[test]
fn picture_follows_the_drag_and_escape_takes_it_back() {
    let mut window = TestWindow::showing(lanes(5));
    let from = window.at(5.0, 4.0);
    window.click(from);
    let shows = |paths: u64| {
        move |app: &App| {
            let shown = app.files.layers()[0].picture.shown();
            shown.is_some_and(|shown| shown.report.drawn == paths)
        }
    };
    window.wait(shows(5));
    window.press(from, NONE);
    // Far above the canvas.
    let to = from - Vec2::new(0.0, 4000.0);
    window.harness.event(Event::PointerMoved(to));
    window.wait(shows(4));
    assert!(!window.document().is_changed());
    window.key(NONE, Key::Escape);
    window.wait(shows(5));
    assert!(!window.document().is_changed());
}

#[test]
fn selection_dragged_by_an_end_snaps_to_a_node() {
    let mut window = TestWindow::showing(lanes(5));
    let middle = window.at(5.0, 4.0);
    window.click(middle);
    let start = |window: &mut TestWindow| window.document().layout().paths.get(2).ends().unwrap().0;
    // A few pixels beside the end node of another lane.
    let nearly = |window: &mut TestWindow| window.at(10.0, 8.0) + Vec2::new(3.0, 2.0);
    let (end, to) = (window.at(10.0, 4.0), nearly(&mut window));
    window.drag(end, to);
    assert_eq!(start(&mut window), Point::new(0.0, 8.0));
    window.key(CTRL, Key::Z);
    // Dragged elsewhere it follows the pointer.
    let to = nearly(&mut window);
    window.drag(middle, to);
    assert_ne!(start(&mut window), Point::new(5.0, 8.0));
    assert!(start(&mut window).distance(Point::new(5.0, 8.0)) < 2.0);
}

#[test]
fn dragged_node_is_one_undo_step_and_its_path_follows() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::P);
    assert_eq!(window.app().tools.tool(), Tool::Points);
    let (from, to) = (window.at(10.0, 2.0), window.at(12.0, 3.0));
    window.drag(from, to);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(Point::new(12.0, 3.0)) < 0.05, "{end:?}");
    window.key(CTRL, Key::Z);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert_eq!(end, Point::new(10.0, 2.0));
    assert!(!window.document().is_changed(), "the drag was one step");
    // Near another node it snaps to it.
    let to = window.at(10.0, 4.02);
    window.drag(from, to);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(Point::new(10.0, 4.0)) < 1e-9, "{end:?}");
}
