//! The Find tab: what was found is marked, and errors go with their query.

use eframe::egui::{Event, Key, Modifiers, Shape};
use egui_kittest::kittest::Queryable;

use super::services::lanes;
use super::test_window::TestWindow;
use crate::canvas::SELECTION_COLOR;
use crate::editing::MarkedSeverities;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn found_node_is_selected_and_marked() {
    let mut window = TestWindow::showing(lanes(50));
    window.app().findings.marked = MarkedSeverities([false; 3]);
    window.key(CTRL, Key::F);
    window.harness.event(Event::Text("n37 10".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.wait(|app| {
        app.document()
            .is_some_and(|document| !document.selected().nodes.is_empty())
    });
    window.wait(|app| app.is_settled());
    window.harness.step();
    let selected = window.document().selected();
    assert_eq!(selected.nodes.iter().collect::<Vec<_>>(), [75]);
    let node = window.at(10.0, 74.0);
    assert!(window.app().canvas.screen().rect.contains(node));
    let shapes = window.harness.output().shapes.iter();
    let rings = shapes.filter_map(|shape| match &shape.shape {
        Shape::Circle(circle) if circle.stroke.color == SELECTION_COLOR => Some(circle.center),
        _ => None,
    });
    let rings: Vec<_> = rings.collect();
    assert_eq!(rings.len(), 1);
    assert!(rings[0].distance(node) < 1.0);
}

#[test]
fn emptied_query_has_no_error() {
    let mut window = TestWindow::showing(lanes(3));
    window.app().side.open(SideTab::Find);
    window.harness.run_steps(2);
    window.harness.get_by_label("Query").focus();
    window.harness.run_steps(2);
    window.harness.event(Event::Text("spede > 2".into()));
    window.harness.run_steps(2);
    window.harness.get_by_label("Select matches").click();
    window.harness.run_steps(3);
    let is_told = |window: &TestWindow| {
        let errors = window.harness.query_all_by_label_contains("spede");
        errors.count() > 0
    };
    assert!(window.app().find.query_error.is_some() && is_told(&window));
    window.harness.get_by_label("Query").focus();
    window.harness.run_steps(2);
    window.key(CTRL, Key::A);
    window.key(NONE, Key::Backspace);
    window.harness.run_steps(2);
    assert_eq!(window.app().find.query, "");
    assert!(window.app().find.query_error.is_none() && !is_told(&window));
}
