//! Commands on the selection: fillet, split, join, reverse, align, array, copies between files.

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::{Document, Element, Elements, SelectMode};
use guideway_layout::Direction;
use guideway_scene::Table;
use guideway_spline::Point;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, field, has_notice};
use crate::command::Command;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

fn perform(window: &mut TestWindow, command: Command) {
    let ctx = window.harness.ctx.clone();
    window.app().perform(command, &ctx);
    window.harness.run_steps(2);
}

/// Moves the pointer to where nothing is.
fn point_away(window: &mut TestWindow) {
    let at = window.at(5.0, 50.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
}

fn count(window: &mut TestWindow, of: Table) -> usize {
    window.document().existing(of).count()
}

/// A new layout with a corner at (10, 0).
fn corner() -> TestWindow {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    window.key(CTRL, Key::N);
    window.wait(|app| app.document().is_some());
    window.key(NONE, Key::D);
    for text in ["0,0", "10,0", "10,10"] {
        window.type_line(text);
    }
    window.key(NONE, Key::Enter);
    window.key(NONE, Key::Escape);
    window
}

#[test]
fn fillet_asks_for_a_radius_and_says_which_one_fits() {
    let mut window = corner();
    window.key(NONE, Key::Q);
    window.answer("two");
    assert!(
        window
            .harness
            .query_by_label_contains("`two` is no number")
            .is_some()
    );
    window.answer("20");
    let refused = window
        .harness
        .query_by_label_contains("the largest one that does is");
    assert!(refused.is_some(), "the question stays");
    assert_eq!(count(&mut window, Table::Paths), 2);
    window.answer("2");
    assert_eq!(
        (
            count(&mut window, Table::Paths),
            count(&mut window, Table::Nodes)
        ),
        (3, 4)
    );
    let arc = window.selected()[0];
    let path = window.document().layout().paths.get(arc as usize);
    let length_m = path.length_m();
    assert!((length_m - std::f64::consts::PI).abs() < 1e-3, "{length_m}");
}

#[test]
fn typing_replaces_the_text_of_a_question() {
    let mut window = corner();
    let type_at_once = |window: &mut TestWindow, text: &str| {
        window.harness.run_steps(2);
        window.harness.event(Event::Text(text.into()));
        window.harness.run_steps(2);
    };
    window.key(NONE, Key::Q);
    assert!(window.harness.query(field("1")).is_some(), "a proposal");
    type_at_once(&mut window, "2");
    assert!(window.harness.query(field("2")).is_some());
    // A longer text in the same place: the cursor of the last one does not count.
    window.key(NONE, Key::Escape);
    window.change(|document| {
        document.select_elements(&Elements::of_paths([0]), SelectMode::Replace);
    });
    window.key(NONE, Key::F2);
    type_at_once(&mut window, "dock");
    assert!(window.harness.query(field("dock")).is_some());
}

#[test]
fn split_and_join_are_inverse() {
    let mut window = TestWindow::showing(lanes(2));
    let at = window.at(3.0, 0.0);
    window.click(at);
    window.key(NONE, Key::K);
    assert_eq!(count(&mut window, Table::Paths), 3);
    let node = window.document().node_near(Point::new(3.0, 0.0), 0.1);
    assert!(node.is_some(), "at the pointer");
    window.key(NONE, Key::J);
    assert_eq!(count(&mut window, Table::Paths), 2);
    // With the pointer elsewhere, at the middle.
    point_away(&mut window);
    window.key(NONE, Key::K);
    let node = window.document().node_near(Point::new(5.0, 0.0), 1e-3);
    assert!(node.is_some());
    window.key(NONE, Key::Escape);
    window.key(NONE, Key::J);
    assert!(has_notice(window.app(), "no node is selected"));
}

#[test]
fn directions_and_lines_are_set_from_the_menu() {
    let mut window = TestWindow::showing(lanes(1));
    window.key(CTRL, Key::A);
    window.harness.get_by_label("Arrange").click();
    window.harness.run_steps(3);
    window.harness.get_by_label("Make two-way").click();
    window.harness.run_steps(3);
    let direction = |window: &mut TestWindow| window.document().layout().paths.get(0).direction();
    assert_eq!(direction(&mut window), Direction::Both);
    perform(&mut window, Command::OneWay);
    assert_eq!(direction(&mut window), Direction::Forward);
    perform(&mut window, Command::Reverse);
    let start = window.document().layout().paths.get(0).start_node();
    assert_eq!(start, Some(1));
    window.key(NONE, Key::Escape);
    perform(&mut window, Command::Straighten);
    assert!(has_notice(window.app(), "no path is given"));
}

#[test]
fn nodes_are_aligned_and_distributed() {
    let mut window = TestWindow::showing(lanes(3));
    window.edit(|document| document.move_node(2, Point::new(1.0, 2.3)));
    let nodes = [0, 2, 4].into_iter().collect();
    window.change(move |document| {
        let elements = Elements {
            nodes,
            ..Elements::default()
        };
        document.select_elements(&elements, SelectMode::Replace);
    });
    perform(&mut window, Command::AlignX);
    let at = |window: &mut TestWindow, node| window.document().node_position_m(node);
    let x = [0, 2, 4].map(|node| at(&mut window, node).x);
    assert!(x.iter().all(|x| (x - 1.0 / 3.0).abs() < 1e-9), "{x:?}");
    perform(&mut window, Command::Distribute);
    window.answer("");
    let y = [0, 2, 4].map(|node| at(&mut window, node).y);
    assert!((y[1] - 2.0).abs() < 1e-9, "{y:?}");
}

#[test]
fn array_copies_nodes_too() {
    let mut window = TestWindow::showing(lanes(1));
    window.key(CTRL, Key::A);
    window.key(CTRL.plus(Modifiers::SHIFT), Key::D);
    window.answer("3, 0");
    assert!(
        window
            .harness
            .query_by_label_contains("type 3 numbers")
            .is_some()
    );
    window.answer("3, 0, 2.5");
    assert_eq!(
        (
            count(&mut window, Table::Paths),
            count(&mut window, Table::Nodes)
        ),
        (4, 8)
    );
    let last = window.document().layout().paths.get(3).ends().unwrap().0;
    assert!(last.distance(Point::new(0.0, 7.5)) < 1e-9);
}

#[test]
fn elements_are_copied_between_files_and_cut() {
    let disk = TestServices::with([("a.arrow", lanes(2)), ("b.arrow", lanes(1))]);
    let mut window = TestWindow::open(&disk, &["a.arrow", "b.arrow"], Some("cpu"));
    window.wait(|app| {
        app.files
            .layers()
            .iter()
            .all(|layer| layer.document().is_some())
    });
    window.app().files.activate(0);
    window.change(|document| {
        document.select([1].into_iter().collect(), SelectMode::Replace);
    });
    // The window system sends these instead of keys.
    window.harness.event(Event::Copy);
    window.harness.step();
    window.app().files.activate(1);
    window.harness.event(Event::Paste("anything".into()));
    window.harness.run_steps(2);
    let document = window.document();
    let pasted = document.layout().paths.get(1);
    assert_eq!(pasted.id(), "lane 1");
    assert_eq!(
        pasted.ends().unwrap().0,
        Point::new(0.0, 2.0),
        "at the same place"
    );
    assert_eq!(document.existing(Table::Nodes).count(), 4);
    // In its own file it lands beside the original.
    window.app().files.activate(0);
    window.key(CTRL, Key::V);
    let beside = window.document().layout().paths.get(2).ends().unwrap().0;
    assert!(beside.distance(Point::new(0.0, 2.0)) > 0.1);
    window.key(CTRL, Key::X);
    assert!(!window.document().contains(Element::Path(2)));
    window.key(CTRL, Key::V);
    assert_eq!(count(&mut window, Table::Paths), 3);
    window.key(CTRL, Key::Z);
    window.key(CTRL, Key::Z);
    assert!(window.document().contains(Element::Path(2)));
    window.key(CTRL, Key::Y);
    assert!(!window.document().contains(Element::Path(2)));
}

#[test]
fn arrows_move_the_selection_by_the_grid_and_pan_without_one() {
    let mut window = TestWindow::showing(lanes(2));
    window.app().settings.grid_step_m = Some(0.5);
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.key(NONE, Key::ArrowUp);
    window.key(NONE, Key::ArrowLeft);
    let start = window.document().layout().paths.get(1).ends().unwrap().0;
    assert!(start.distance(Point::new(-0.5, 2.5)) < 1e-9, "{start:?}");
    window.key(NONE, Key::Escape);
    let before = window.at(0.0, 0.0);
    window.key(NONE, Key::ArrowLeft);
    assert!(window.at(0.0, 0.0).x > before.x);
    let start = window.document().layout().paths.get(1).ends().unwrap().0;
    assert!(start.distance(Point::new(-0.5, 2.5)) < 1e-9);
}

#[test]
fn window_forgets_the_rows_of_undone_copies() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(CTRL, Key::T);
    window.harness.run_steps(4);
    window.key(CTRL, Key::A);
    window.edit(|document: &mut Document| document.copy_selection(2, Point::new(0.0, 2.0)));
    let app = window.app();
    app.find.name = "lane".into();
    app.find.search(app.files.document(), &app.context.repaint);
    app.side.open(SideTab::Find);
    window.harness.run_steps(4);
    assert_eq!(window.document().layout().paths.len(), 9);
    // The pointer is over a copy while it goes.
    let at = window.at(5.0, 4.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(3);
    for _ in 0..2 {
        window.key(CTRL, Key::Z);
        window.harness.run_steps(3);
        assert_eq!(window.document().layout().paths.len(), 3);
        window.wait(|app| {
            let shown = app.files.layers()[0].picture.shown();
            shown.is_some_and(|shown| shown.report.total == 3)
        });
        window.key(CTRL, Key::Y);
        window.harness.run_steps(3);
        assert_eq!(window.document().layout().paths.len(), 9);
    }
}
