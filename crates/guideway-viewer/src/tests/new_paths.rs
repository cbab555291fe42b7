//! The New paths window: what is set there, the next drawn path has.

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::EdgeTemplate;
use guideway_layout::{Direction, Layout, Quantity, Value};

use super::drawing::click;
use super::services::lanes;
use super::test_window::TestWindow;

const NONE: Modifiers = Modifiers::NONE;

/// Three lanes with the New paths window.
fn window(layout: Layout) -> TestWindow {
    let mut window = TestWindow::showing(layout);
    let bar = "New paths: one-way, all vehicle types";
    window.harness.get_by_label(bar).click();
    window.harness.run_steps(3);
    window
}

/// Draws a line between two points. Returns the template of it.
fn drawn(window: &mut TestWindow, y: f64) -> EdgeTemplate {
    window.key(NONE, Key::D);
    for x in [2.0, 8.0] {
        click(window, x, y);
    }
    window.key(NONE, Key::Enter);
    window.key(NONE, Key::V);
    let document = window.document();
    let new = document.layout().paths.len() as u32 - 1;
    document.template_of(new)
}

#[test]
fn two_way_holds_for_the_next_path() {
    let mut window = window(lanes(3));
    window.harness.get_by_label("Two-way").click();
    window.harness.run_steps(2);
    assert_eq!(drawn(&mut window, 1.0).direction, Direction::Both);
    window.harness.get_by_label("Two-way").click();
    window.harness.run_steps(2);
    assert_eq!(drawn(&mut window, 3.0).direction, Direction::Forward);
}

#[test]
fn next_path_is_as_the_selected_one() {
    let mut layout = lanes(3);
    layout.paths.vehicle_types_mut().set(1, &["tug"]);
    let attributes = &mut layout.paths.attributes;
    attributes.set(1, "maxSpeed", Value::Float(1.5));
    attributes.set(1, "name", Value::Text("the second"));
    attributes.set_quantity(1, "corridor.leftWidth", 0.5, Quantity::Length);
    let mut window = window(layout);
    let lane = window.at(6.0, 2.0);
    window.click(lane);
    window.harness.get_by_label("As the selected path").click();
    window.harness.run_steps(2);
    let expected = window.document().template_of(1);
    let new = drawn(&mut window, 1.0);
    assert_eq!(new.properties, expected.properties);
    assert_eq!(new.vehicle_types[0].0, "tug");
    let paths = &window.document().layout().paths;
    assert_eq!(
        paths.value(3, "corridor.leftWidth"),
        Some(Value::Float(0.5))
    );
    assert_eq!(paths.value(3, "name"), None);
    // The window tells the number of values, and a button removes them.
    assert!(window.harness.query_by_label("2 further values").is_some());
    let buttons = window.harness.get_all_by_label("×");
    let leftmost = buttons.min_by(|a, b| a.rect().left().total_cmp(&b.rect().left()));
    leftmost.expect("the button of the window").click();
    window.harness.run_steps(2);
    assert!(drawn(&mut window, 3.0).further_names().is_empty());
}
