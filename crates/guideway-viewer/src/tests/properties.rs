//! Nodes, stations and properties: select, edit, rename, undo.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::Element;
use guideway_layout::Value;

use super::services::lanes;
use super::test_window::{TestWindow, has_notice};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// The text field with this value.
fn field(value: &str) -> By<'_> {
    By::new().role(Role::TextInput).value(value)
}

/// Replaces the text of the first field with this value, and confirms it.
fn type_over(window: &mut TestWindow, shown: &str, text: &str) {
    let mut fields = window.harness.get_all(field(shown));
    fields.next().expect("it is shown").focus();
    drop(fields);
    window.harness.run_steps(2);
    window.key(CTRL, Key::A);
    window.harness.event(Event::Text(text.into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.harness.run_steps(2);
}

fn speed(window: &mut TestWindow, row: usize) -> Option<f64> {
    let paths = &window.document().layout().paths;
    match paths.attributes.value(row, "speed") {
        Some(Value::Float(speed)) => Some(speed),
        _ => None,
    }
}

#[test]
fn a_property_of_several_paths_is_set_at_once_and_undone() {
    let mut window = TestWindow::showing(lanes(3));
    let at = window.at(5.0, 2.0);
    window.click(at);
    type_over(&mut window, "0.5", "2,5");
    assert_eq!(speed(&mut window, 1), Some(2.5));
    assert_eq!(speed(&mut window, 2), Some(1.0));
    window.key(CTRL, Key::A);
    window.harness.run_steps(2);
    type_over(&mut window, "", "4");
    let speeds = [0, 1, 2].map(|row| speed(&mut window, row));
    assert_eq!(speeds, [Some(4.0); 3]);
    window.key(CTRL, Key::Z);
    assert_eq!(speed(&mut window, 1), Some(2.5));
    window.key(CTRL, Key::Z);
    assert_eq!(speed(&mut window, 1), Some(0.5));
}

#[test]
fn wrong_text_is_refused_and_escape_takes_a_text_back() {
    let mut window = TestWindow::showing(lanes(3));
    let at = window.at(5.0, 2.0);
    window.click(at);
    type_over(&mut window, "0.5", "fast");
    assert!(has_notice(window.app(), "fast is no number"));
    assert_eq!(speed(&mut window, 1), Some(0.5));
    window.harness.get(field("0.5")).focus();
    window.harness.run_steps(2);
    window.harness.event(Event::Text("7".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Escape);
    window.harness.run_steps(2);
    assert_eq!(speed(&mut window, 1), Some(0.5));
    assert!(!window.document().is_changed());
}

#[test]
fn text_counts_when_the_canvas_is_pressed() {
    let mut window = TestWindow::showing(lanes(3));
    let (first, second) = (window.at(5.0, 2.0), window.at(5.0, 4.0));
    window.click(first);
    window.harness.get(field("0.5")).focus();
    window.harness.run_steps(2);
    window.key(CTRL, Key::A);
    window.harness.event(Event::Text("3".into()));
    window.harness.run_steps(2);
    window.click(second);
    assert_eq!(speed(&mut window, 1), Some(3.0));
    assert_eq!(
        speed(&mut window, 2),
        Some(1.0),
        "the other path keeps its own"
    );
}

#[test]
fn node_is_selected_renamed_moved_and_deleted_with_its_paths() {
    let mut window = TestWindow::showing(lanes(3));
    let at = window.at(10.0, 2.0);
    window.click(at);
    let node = window.document().layout().paths.get(1).end_node().unwrap();
    assert_eq!(
        window
            .document()
            .selected()
            .nodes
            .iter()
            .collect::<Vec<_>>(),
        [node]
    );
    let name = Element::Node(node)
        .id(window.document().layout())
        .to_owned();
    type_over(&mut window, &name, "dock");
    assert_eq!(window.document().layout().nodes.id(node), "dock");
    // A name that is taken is refused.
    type_over(&mut window, "dock", "n0 0");
    assert!(has_notice(window.app(), "n0 0"));
    // The path follows.
    let to = window.at(12.0, 3.0);
    window.drag(at, to);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(window.document().node_position_m(node)) < 1e-6);
    assert!(end.x > 11.5);
    window.key(NONE, Key::Delete);
    assert!(!window.document().contains(Element::Node(node)));
    assert!(!window.document().contains(Element::Path(1)));
    window.key(CTRL, Key::Z);
    assert!(window.document().contains(Element::Path(1)));
}
