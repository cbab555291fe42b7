//! What a hand drags: selections, nodes and control points.

use eframe::egui::{Key, Modifiers, Vec2};
use guideway_spline::Point;

use super::desk::Desk;
use super::table::lanes;
use crate::app::Tool;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn a_selection_is_dragged_and_the_drag_undone() {
    let mut desk = Desk::looking_at(lanes(5));
    let from = desk.at(5.0, 4.0);
    desk.click(from);
    let to = desk.at(6.0, 5.0);
    desk.drag(from, to);
    let start = |desk: &mut Desk| desk.document().layout().paths.get(2).ends().unwrap().0;
    assert!(start(&mut desk).distance(Point::new(1.0, 5.0)) < 1e-6);
    assert!(desk.document().is_changed());
    desk.wait(|app| app.layers[0].shown.is_some());
    desk.key(CTRL, Key::Z);
    assert_eq!(start(&mut desk), Point::new(0.0, 4.0));
    assert!(!desk.document().is_changed());
    desk.key(CTRL | Modifiers::SHIFT, Key::Z);
    assert!(desk.document().is_changed());
}

#[test]
fn a_selection_held_by_an_end_goes_to_a_node() {
    let mut desk = Desk::looking_at(lanes(5));
    let middle = desk.at(5.0, 4.0);
    desk.click(middle);
    let start = |desk: &mut Desk| desk.document().layout().paths.get(2).ends().unwrap().0;
    // A few pixels beside the node where another lane ends.
    let nearly = |desk: &mut Desk| desk.at(10.0, 8.0) + Vec2::new(3.0, 2.0);
    let (end, to) = (desk.at(10.0, 4.0), nearly(&mut desk));
    desk.drag(end, to);
    assert_eq!(start(&mut desk), Point::new(0.0, 8.0));
    desk.key(CTRL, Key::Z);
    // Held elsewhere it goes where the hand goes.
    let to = nearly(&mut desk);
    desk.drag(middle, to);
    assert_ne!(start(&mut desk), Point::new(5.0, 8.0));
    assert!(start(&mut desk).distance(Point::new(5.0, 8.0)) < 2.0);
}

#[test]
fn a_node_is_dragged_in_one_step_and_its_path_follows() {
    let mut desk = Desk::looking_at(lanes(3));
    desk.key(NONE, Key::P);
    assert_eq!(desk.app().tool, Tool::Points);
    let (from, to) = (desk.at(10.0, 2.0), desk.at(12.0, 3.0));
    desk.drag(from, to);
    let end = desk.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(Point::new(12.0, 3.0)) < 0.05, "{end:?}");
    desk.key(CTRL, Key::Z);
    let end = desk.document().layout().paths.get(1).ends().unwrap().1;
    assert_eq!(end, Point::new(10.0, 2.0));
    assert!(!desk.document().is_changed(), "the drag was one step");
    // Near another node it goes there.
    let to = desk.at(10.0, 4.02);
    desk.drag(from, to);
    let end = desk.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(Point::new(10.0, 4.0)) < 1e-9, "{end:?}");
}
