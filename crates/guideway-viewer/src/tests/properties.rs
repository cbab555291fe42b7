//! Nodes, stations and properties: select, edit, rename, undo.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, Vec2};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::Element;
use guideway_layout::Value;

use super::services::lanes;
use super::test_window::{TestWindow, field, has_notice};
use crate::app::App;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Types into the field with this value, without confirming it.
fn begin_typing(window: &mut TestWindow, shown: &str, text: &str) {
    window.harness.get(field(shown)).focus();
    window.harness.run_steps(2);
    window.key(CTRL, Key::A);
    window.harness.event(Event::Text(text.into()));
    window.harness.run_steps(3);
}

/// The arrows on screen that point both ways.
fn two_way_arrows(app: &App) -> usize {
    let overlay = app.files.layers()[0].slot.overlay().last();
    let arrows = overlay.map_or(&[][..], |overlay| &overlay.marks.arrows);
    arrows.iter().filter(|arrow| arrow.is_two_way).count()
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
    window.type_over("0.5", "2,5");
    assert_eq!(speed(&mut window, 1), Some(2.5));
    assert_eq!(speed(&mut window, 2), Some(1.0));
    window.key(CTRL, Key::A);
    window.harness.run_steps(2);
    window.type_over("", "4");
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
    window.type_over("0.5", "fast");
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
fn value_out_of_range_is_refused_with_the_range_and_changes_nothing() {
    let mut layout = lanes(3);
    let paths = &mut layout.paths.attributes;
    paths.set_quantity(1, "maxSpeed", 1.25, guideway_layout::Quantity::Speed);
    let mut window = TestWindow::showing(layout);
    let at = window.at(5.0, 2.0);
    window.click(at);
    let max_speed = |window: &mut TestWindow| {
        let paths = &window.document().layout().paths;
        paths.attributes.value(1, "maxSpeed")?.number()
    };
    for (text, said) in [("-1", "at least 0"), ("1e999", "is no number")] {
        window.type_over("1.25", text);
        window.harness.run_steps(2);
        assert!(has_notice(window.app(), said), "{text}");
        assert_eq!(max_speed(&mut window), Some(1.25), "{text}");
    }
    assert!(!window.document().is_changed());
}

#[test]
fn all_properties_can_be_added_in_a_low_window() {
    let mut window = TestWindow::showing(lanes(3));
    window.harness.set_size(Vec2::new(1200.0, 480.0));
    window.key(CTRL, Key::A);
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(4);
    window
        .harness
        .get_all_by_label("Add property")
        .next()
        .unwrap()
        .click();
    window.harness.run_steps(4);
    let first = window.harness.get_by_label("description").rect();
    assert!(first.min.y >= 0.0);
    let last = |window: &TestWindow| window.harness.get_by_label("locked").rect();
    assert!(last(&window).min.y > 480.0, "there are more than fit");
    window.wheel(first.center(), -30.0);
    window.harness.run_steps(20);
    let rect = last(&window);
    assert!(rect.max.y <= 480.0, "{rect:?}");
    window.click(rect.center());
    window.harness.run_steps(4);
    assert!(
        window.harness.query_by_label("locked").is_some(),
        "its field"
    );
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
    window.type_over(&name, "dock");
    assert_eq!(window.document().layout().nodes.id(node), "dock");
    // A name that is taken is refused.
    window.type_over("dock", "n0 0");
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

#[test]
fn what_is_typed_shows_at_once_and_counts_as_one_step() {
    let mut window = TestWindow::showing(lanes(3));
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    let colored = |app: &App| app.document().is_some_and(|d| d.scene().legend().is_some());
    window.wait(colored);
    let at = window.at(5.0, 2.0);
    window.click(at);
    let before = window.document().scene().color(1);
    for end in [Key::Escape, Key::Enter] {
        begin_typing(&mut window, "0.5", "2");
        assert_eq!(speed(&mut window, 1), Some(2.0));
        window.wait(|app| app.document().is_some_and(|d| d.scene().color(1) != before));
        // A wrong text shows what the file has.
        window.harness.event(Event::Text("x".into()));
        window.harness.run_steps(3);
        assert_eq!(speed(&mut window, 1), Some(0.5));
        window.key(NONE, Key::Backspace);
        window.harness.event(Event::Text("5".into()));
        window.harness.run_steps(3);
        assert_eq!(speed(&mut window, 1), Some(25.0));
        assert!(!window.document().is_changed());
        assert!(window.document().take_journal_entries().is_empty());
        window.key(NONE, end);
        window.harness.run_steps(3);
        let counts = end == Key::Enter;
        assert_eq!(speed(&mut window, 1), Some(if counts { 25.0 } else { 0.5 }));
        assert_eq!(window.document().is_changed(), counts);
    }
    window.key(CTRL, Key::Z);
    assert_eq!(speed(&mut window, 1), Some(0.5));
    assert_eq!(
        window.document().undo_redo_names(),
        (None, Some("set property"))
    );
    window.wait(|app| app.document().is_some_and(|d| d.scene().color(1) == before));
    // Another tab leaves the field, which confirms it.
    begin_typing(&mut window, "0.5", "3");
    window.key(CTRL, Key::F);
    window.harness.run_steps(3);
    assert_eq!(speed(&mut window, 1), Some(3.0));
    assert!(window.document().is_changed() && !window.document().is_preview());
}

#[test]
fn direction_under_the_pointer_shows_until_another_is_chosen() {
    let mut window = TestWindow::showing(lanes(3));
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.harness.run_steps(3);
    let combo = By::new().role(Role::ComboBox).value("one-way");
    window.harness.get(combo).click();
    window.harness.run_steps(4);
    let choice = window.harness.get_by_label("two-way").rect().center();
    window.harness.event(Event::PointerMoved(choice));
    window.wait(|app| two_way_arrows(app) > 0);
    assert!(!window.document().is_changed());
    window.harness.event(Event::PointerMoved(at));
    window.wait(|app| two_way_arrows(app) == 0);
    window.click(choice);
    window.wait(|app| two_way_arrows(app) > 0);
    assert_eq!(window.document().undo_redo_names().0, Some("make two-way"));
}

#[test]
fn nodes_of_a_station_are_typed_by_name() {
    let mut layout = lanes(3);
    layout.stations.push("dock", None, vec![1], None);
    let mut window = TestWindow::showing(layout);
    let at_m = window.document().station_position_m(0).unwrap();
    window.change(|document: &mut guideway_document::Document| {
        let dock = guideway_document::Elements::of(Element::Station(0));
        document.select_elements(&dock, Default::default());
    });
    window.harness.run_steps(3);
    let nodes = |window: &mut TestWindow| window.document().layout().stations.nodes(0).to_vec();
    let first = window.document().layout().nodes.id(1).to_owned();
    window.type_over(&first, "n1 0, n9");
    assert!(has_notice(window.app(), "no node is called `n9`"));
    assert_eq!(nodes(&mut window), [1]);
    window.type_over(&first, "n1 0, n2 10");
    assert_eq!(nodes(&mut window).len(), 2);
    window.type_over("n1 0, n2 10", " ");
    assert!(nodes(&mut window).is_empty());
    assert_eq!(window.document().station_position_m(0), Some(at_m));
    window.key(CTRL, Key::Z);
    window.key(CTRL, Key::Z);
    assert_eq!(nodes(&mut window), [1]);
}
