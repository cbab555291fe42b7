//! Levels and vehicle types are created, selected, renamed, changed, copied and deleted, by mouse
//! and keys.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::{Document, Group, LevelFact, PathSet, PropertyRef};
use guideway_layout::Value;
use guideway_scene::Table;

use super::levels::two_levels;
use super::services::lanes;
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;

/// The Layers tab of a window.
fn layers(mut window: TestWindow) -> TestWindow {
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    window
}

fn click(window: &mut TestWindow, label: &str) {
    window.harness.get_by_label(label).click();
    window.harness.run_steps(3);
}

/// Types into a field of the dialog, in place of its text.
fn fill(window: &mut TestWindow, label: &str, text: &str) {
    let field = By::new().role(Role::TextInput).label(label);
    window.harness.get(field).focus();
    window.harness.run_steps(2);
    window.key(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text(text.into()));
    window.harness.run_steps(2);
}

/// Runs a command of the menu behind the name of a level or vehicle type.
fn choose(window: &mut TestWindow, name: &str, command: &str) {
    click(window, &format!("Commands for {name}"));
    let entries = window.harness.query_all_by_label_contains(command);
    entries.last().expect("the menu is open").click();
    window.harness.run_steps(3);
}

fn selected(window: &mut TestWindow) -> Vec<Group> {
    window.document().selected().groups().collect()
}

fn levels(window: &mut TestWindow) -> Vec<String> {
    let layout = window.document().layout();
    layout.levels.iter().map(|level| level.id.clone()).collect()
}

fn types(window: &mut TestWindow) -> Vec<String> {
    let names = window.document().layout().vehicle_type_names();
    names.into_iter().map(str::to_owned).collect()
}

#[test]
fn a_level_is_added_renamed_and_drawn_on() {
    let mut window = layers(TestWindow::showing(two_levels()));
    click(&mut window, "Add level");
    let field = By::new().role(Role::TextInput).label("identifier");
    let width = window.harness.get(field).rect().width();
    assert!(width >= 190.0, "a name fits into {width} points");
    fill(&mut window, "identifier", "roof");
    fill(&mut window, "height (m)", "9,5");
    window.key(NONE, Key::Enter);
    assert_eq!(levels(&mut window), ["hall", "upper", "roof"]);
    let document = window.document();
    assert_eq!(document.layout().levels[2].elevation_m, Some(9.5));
    assert_eq!(document.level(), Some(2), "what is drawn goes there");
    window.harness.run_steps(3);
    click(&mut window, "Add level");
    fill(&mut window, "identifier", "upper");
    click(&mut window, "OK");
    let taken = window
        .harness
        .query_by_label("upper is taken; choose another name");
    assert!(taken.is_some(), "the dialog stays with its error");
    window.key(NONE, Key::Escape);
    click(&mut window, "hall");
    window.key(NONE, Key::F2);
    window.answer("ground");
    assert_eq!(levels(&mut window), ["ground", "upper", "roof"]);
    assert_eq!(window.document().layout().paths.get(0).level(), Some(0));
    for _ in 0..2 {
        window.key(Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(levels(&mut window), ["hall", "upper"]);
    let shown = window.document().scene().draw_order().len();
    assert_eq!(shown, 2, "the level that was shown alone is gone");
    assert!(!window.document().is_changed());
}

#[test]
fn a_level_with_elements_asks_what_becomes_of_them() {
    let mut window = layers(TestWindow::showing(two_levels()));
    click(&mut window, "upper");
    window.key(NONE, Key::Delete);
    window.harness.run_steps(3);
    let text = "On the level upper are 1 path, 2 nodes. What becomes of them?";
    assert!(window.harness.query_by_label(text).is_some());
    window.key(NONE, Key::Escape);
    assert_eq!(levels(&mut window).len(), 2, "Escape deletes nothing");
    window.key(NONE, Key::Delete);
    window.harness.run_steps(3);
    click(&mut window, "Move to hall");
    click(&mut window, "Delete");
    assert_eq!(levels(&mut window), ["hall"]);
    let document = window.document();
    assert_eq!(document.layout().paths.get(1).level(), Some(0));
    assert_eq!(document.scene().draw_order().len(), 2);
    window.key(Modifiers::COMMAND, Key::Z);
    window.harness.run_steps(3);
    assert_eq!(selected(&mut window), [Group::Level(1)]);
    choose(&mut window, "upper", "Delete");
    click(&mut window, "Delete with the level");
    click(&mut window, "Delete");
    assert_eq!(levels(&mut window), ["hall"]);
    assert_eq!(window.document().scene().path_count(), 1);
}

#[test]
fn the_first_level_is_added_to_a_layout_without_levels() {
    let mut window = layers(TestWindow::showing(lanes(2)));
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::NewLevel, &ctx);
    window.harness.run_steps(3);
    window.key(NONE, Key::Enter);
    assert_eq!(levels(&mut window), ["level"]);
    let shown = window.document().scene().draw_order().len();
    assert_eq!(shown, 2, "paths without a level are on all");
    assert!(window.harness.query_by_label("level").is_some());
}

#[test]
fn vehicle_types_are_added_changed_and_replaced() {
    let mut layout = lanes(3);
    layout.paths.vehicle_types_mut().set(0, &["tug"]);
    let mut window = layers(TestWindow::showing(layout));
    click(&mut window, "Vehicle types");
    window.harness.run_steps(20);
    click(&mut window, "Add vehicle type");
    fill(&mut window, "identifier", "crane");
    fill(&mut window, "maxSpeed (m/s)", "1.8 km/h");
    window.key(NONE, Key::Enter);
    assert_eq!(types(&mut window), ["crane", "tug"]);
    let crane = &window.document().layout().vehicle_types[0];
    let speed = crane.attributes.value(0, "maxSpeed");
    assert_eq!(speed.and_then(|speed| speed.number()), Some(0.5));
    click(&mut window, "tug");
    window.key(NONE, Key::F2);
    window.answer("tugger");
    let paths = |window: &mut TestWindow| {
        let entries = window.document().layout().paths.vehicle_types();
        entries.of(0).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(paths(&mut window), ["tugger"]);
    // Without its only type the path would be open to all.
    choose(&mut window, "tugger", "Delete");
    click(&mut window, "Take it off them");
    click(&mut window, "Delete");
    assert!(has_notice(window.app(), "would be open to all types"));
    choose(&mut window, "tugger", "Delete");
    click(&mut window, "Replace by crane");
    click(&mut window, "Delete");
    assert_eq!(
        (types(&mut window), paths(&mut window)),
        (vec!["crane".into()], vec!["crane".into()])
    );
}

#[test]
fn a_renamed_vehicle_type_is_renamed_wherever_it_is_named() {
    let mut layout = lanes(3);
    layout.paths.vehicle_types_mut().set(0, &["fork", "tug"]);
    layout.nodes.vehicle_types_mut().set(1, &["tug"]);
    let mut window = layers(TestWindow::showing(layout));
    window.edit(|document| {
        let speed = PropertyRef {
            of: Table::Paths,
            name: "maxSpeed",
            vehicle_type: Some("tug"),
        };
        document.set_property(speed, &[0].into_iter().collect(), Some(Value::Float(1.5)))
    });
    window.app().tools.template.vehicle_types = vec![("tug".into(), Some(2.0))];
    click(&mut window, "Vehicle types");
    window.harness.run_steps(20);
    click(&mut window, "tug");
    window.key(NONE, Key::F2);
    window.answer("tugger");
    assert_eq!(types(&mut window), ["fork", "tugger"]);
    let speed = |window: &mut TestWindow, name: &str| {
        let entries = window.document().layout().paths.vehicle_types();
        let entry = entries.entry_for(0, name)?;
        entries.attributes.value(entry, "maxSpeed")?.number()
    };
    assert_eq!(speed(&mut window, "tugger"), Some(1.5));
    let of_node = |window: &mut TestWindow| {
        let entries = window.document().layout().nodes.vehicle_types();
        entries.of(1).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(of_node(&mut window), ["tugger"]);
    // The next drawn path does not bring the old name back.
    let template = &window.app().tools.template;
    assert_eq!(template.vehicle_types, [("tugger".to_owned(), Some(2.0))]);
    window.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(speed(&mut window, "tug"), Some(1.5));
    assert_eq!(of_node(&mut window), ["tug"]);
}

#[test]
fn a_refused_name_stays_in_the_question_with_its_reason() {
    let mut layout = lanes(2);
    layout.paths.vehicle_types_mut().set(0, &["fork", "tug"]);
    let mut window = layers(TestWindow::showing(layout));
    window.app().tools.template.vehicle_types = vec![("tug".into(), None)];
    click(&mut window, "Vehicle types");
    window.harness.run_steps(20);
    click(&mut window, "tug");
    window.key(NONE, Key::F2);
    window.answer("fork");
    window.harness.run_steps(3);
    let question = window
        .harness
        .query_by_label("New name of the vehicle type");
    assert!(question.is_some());
    assert!(
        window.app().dialogs.notices.texts().is_empty(),
        "it is said there"
    );
    let field = By::new().role(Role::TextInput).value("fork");
    assert!(window.harness.query_all(field).next().is_some(), "its text");
    assert_eq!(types(&mut window), ["fork", "tug"]);
    let of_new = |window: &mut TestWindow| window.app().tools.template.vehicle_types.clone();
    assert_eq!(of_new(&mut window), [("tug".to_owned(), None)]);
    window.answer("tugger");
    window.harness.run_steps(3);
    assert_eq!(types(&mut window), ["fork", "tugger"]);
    assert_eq!(of_new(&mut window), [("tugger".to_owned(), None)]);
    let lane = window.at(5.0, 0.0);
    window.click(lane);
    window.key(NONE, Key::F2);
    window.answer("lane 1");
    window.harness.run_steps(3);
    let refused = window.harness.query_by_label_contains("lane 1");
    assert!(refused.is_some() && window.harness.query_by_label("New name").is_some());
}

#[test]
fn levels_stand_by_height_and_a_typed_height_moves_one() {
    let mut window = layers(TestWindow::showing(two_levels()));
    let is_above = |window: &TestWindow, above: &str, below: &str| {
        let top = |label| window.harness.get_by_label(label).rect().min.y;
        top(above) < top(below)
    };
    assert!(is_above(&window, "hall", "upper"), "by name");
    for (height, upper_is_above) in [(Some(4.0), true), (None, false)] {
        window.edit(move |document: &mut Document| {
            let upper = PathSet::from_iter([1]);
            document.set_level_fact(&upper, LevelFact::Elevation(height))
        });
        window.harness.run_steps(3);
        assert_eq!(is_above(&window, "upper", "hall"), upper_is_above);
    }
}
