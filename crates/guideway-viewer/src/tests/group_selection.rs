//! Levels and vehicle types are selected, seen, edited and copied as all else is.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::Group;
use guideway_document::decorations::Outline;
use guideway_layout::{Layout, Value};

use super::levels::two_levels;
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Two levels with a lane each; `tug` drives on the first lane only, `fork` on both.
fn layout() -> Layout {
    let mut layout = two_levels();
    let types = layout.paths.vehicle_types_mut();
    types.set(0, &["fork", "tug"]);
    types.set(1, &["fork"]);
    layout
}

/// A window with the Layers tab in front, and all of its lists open.
fn window() -> TestWindow {
    let mut window = TestWindow::showing(layout());
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    click(&mut window, "Vehicle types");
    window.harness.run_steps(20);
    window
}

fn click(window: &mut TestWindow, label: &str) {
    window.harness.get_by_label(label).click();
    window.harness.run_steps(3);
}

fn click_with(window: &mut TestWindow, label: &str, modifiers: Modifiers) {
    let at = window.harness.get_by_label(label).rect().center();
    window.click_with(at, modifiers);
}

fn selected(window: &mut TestWindow) -> Vec<Group> {
    window.document().selected().groups().collect()
}

fn of_type(name: &str) -> Group {
    Group::VehicleType(name.into())
}

/// The numbers of outlined lines and of ringed places of what is highlighted.
fn highlighted(window: &mut TestWindow) -> Option<(usize, usize)> {
    window.wait(|app| app.files.is_settled());
    let overlay = window.app().files.layers()[0].slot.overlay().last()?;
    let members = overlay.highlighted.as_ref()?;
    let Outline::Lines(lines) = &members.paths else {
        panic!("few paths have lines");
    };
    Some((lines.len(), members.symbols.len()))
}

fn properties(window: &mut TestWindow) {
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(3);
}

#[test]
fn clicks_select_levels_and_types_as_they_select_elements() {
    let mut window = window();
    click(&mut window, "upper");
    assert_eq!(selected(&mut window), [Group::Level(1)]);
    click_with(&mut window, "tug", CTRL);
    assert_eq!(selected(&mut window), [Group::Level(1), of_type("tug")]);
    click_with(&mut window, "upper", CTRL);
    assert_eq!(selected(&mut window), [of_type("tug")]);
    let lane = window.at(5.0, 0.0);
    window.click_with(lane, Modifiers::SHIFT);
    assert!(window.document().selected().has_elements());
    assert_eq!(selected(&mut window), [of_type("tug")], "one selection");
    window.click(lane);
    assert!(selected(&mut window).is_empty());
    click(&mut window, "hall");
    window.key(NONE, Key::Escape);
    assert!(window.document().selected().is_empty());
    assert!(!window.document().is_changed());
}

#[test]
fn what_belongs_to_the_hovered_one_is_highlighted() {
    let mut window = window();
    assert_eq!(highlighted(&mut window), None);
    for (name, members) in [("upper", (1, 2)), ("tug", (1, 0)), ("fork", (2, 0))] {
        let at = window.harness.get_by_label(name).rect().center();
        window.harness.event(Event::PointerMoved(at));
        window.harness.run_steps(3);
        assert_eq!(highlighted(&mut window), Some(members), "{name}");
    }
    let nowhere = window.at(5.0, 1.0);
    window.harness.event(Event::PointerMoved(nowhere));
    window.harness.run_steps(3);
    assert_eq!(highlighted(&mut window), None);
    assert!(!window.document().is_changed());
}

#[test]
fn properties_of_levels_are_typed_with_units() {
    let mut window = window();
    click(&mut window, "upper");
    properties(&mut window);
    window.type_over("upper", "loft");
    window.type_over("", "The loft");
    let heights: Vec<_> = window
        .harness
        .get_all(By::new().role(Role::TextInput).value(""))
        .collect();
    assert_eq!(heights.len(), 1);
    drop(heights);
    window.type_over("", "13 ft");
    let level = &window.document().layout().levels[1];
    assert_eq!(
        (&*level.id, level.name.as_deref()),
        ("loft", Some("The loft"))
    );
    assert!((level.elevation_m.unwrap() - 3.9624).abs() < 1e-9);
    window.type_over("loft", "hall");
    assert!(has_notice(window.app(), "hall"), "the name is taken");
    assert_eq!(window.document().layout().levels[1].id, "loft");
    assert!(
        window
            .harness
            .query_by_label("on it: 1 path, 2 nodes")
            .is_some()
    );
    for _ in 0..3 {
        window.key(CTRL, Key::Z);
    }
    assert!(!window.document().is_changed());
    assert_eq!(selected(&mut window), [Group::Level(1)]);
}

#[test]
fn properties_of_several_types_are_set_at_once() {
    let mut window = window();
    click(&mut window, "tug");
    properties(&mut window);
    // The first empty field is that of the greatest speed.
    window.type_over("", "3.6 km/h");
    let speed = |window: &mut TestWindow, name: &str| {
        let types = &window.document().layout().vehicle_types;
        let known = types.iter().find(|known| known.id == name)?;
        known.attributes.value(0, "maxSpeed")?.number()
    };
    assert_eq!(speed(&mut window, "tug"), Some(1.0));
    window.app().side.open(SideTab::Layers);
    window.harness.run_steps(3);
    click_with(&mut window, "fork", Modifiers::SHIFT);
    properties(&mut window);
    window.type_over("", "1,5");
    assert_eq!(speed(&mut window, "tug"), Some(1.5));
    assert_eq!(speed(&mut window, "fork"), Some(1.5));
    window.key(CTRL, Key::Z);
    assert_eq!(
        (speed(&mut window, "tug"), speed(&mut window, "fork")),
        (Some(1.0), None)
    );
}

#[test]
fn a_type_that_is_renamed_in_its_field_is_renamed_for_new_paths_too() {
    let mut window = window();
    window.app().tools.template.vehicle_types = vec![("tug".into(), Some(2.0))];
    click(&mut window, "tug");
    properties(&mut window);
    window.type_over("tug", "tugger");
    let paths = window.document().layout().paths.vehicle_types();
    assert!(paths.of(0).eq(["fork", "tugger"]));
    let template = &window.app().tools.template;
    assert_eq!(template.vehicle_types, [("tugger".to_owned(), Some(2.0))]);
    assert_eq!(selected(&mut window), [of_type("tugger")]);
}

#[test]
fn a_level_is_copied_with_its_elements_and_shown_alone() {
    let mut window = window();
    click(&mut window, "hall");
    window.harness.event(Event::Copy);
    window.harness.run_steps(2);
    window
        .harness
        .event(Event::Paste("Guideway: 1 level".into()));
    window.harness.run_steps(3);
    let document = window.document();
    let ids: Vec<&str> = document.layout().levels.iter().map(|l| &*l.id).collect();
    assert_eq!(ids, ["hall", "upper", "hall 2"]);
    assert_eq!(document.scene().draw_order(), [2]);
    assert_eq!(document.layout().paths.get(2).level(), Some(2));
    assert_eq!(
        (document.level(), selected(&mut window)),
        (Some(2), vec![Group::Level(2)])
    );
    window.key(CTRL, Key::Z);
    assert_eq!(window.document().layout().levels.len(), 2);
    assert_eq!(window.document().scene().draw_order().len(), 2);
}

#[test]
fn a_duplicated_type_drives_where_the_original_drives() {
    let mut window = window();
    window.edit(|document| {
        let speed = guideway_document::PropertyRef {
            of: guideway_scene::Table::Paths,
            name: "maxSpeed",
            vehicle_type: Some("tug"),
        };
        document.set_property(speed, &[0].into_iter().collect(), Some(Value::Float(1.5)))
    });
    click(&mut window, "tug");
    window.key(CTRL, Key::D);
    let paths = &window.document().layout().paths;
    assert!(paths.vehicle_types().of(0).eq(["fork", "tug", "tug 2"]));
    assert_eq!(
        paths.value_for(0, "tug 2", "maxSpeed"),
        Some(Value::Float(1.5))
    );
    assert_eq!(selected(&mut window), [of_type("tug 2")]);
}

#[test]
fn cut_asks_as_delete_does_and_delete_without_members_does_not() {
    let mut window = window();
    click(&mut window, "upper");
    window.harness.event(Event::Cut);
    window.harness.run_steps(3);
    click(&mut window, "Delete with the level");
    click(&mut window, "Delete");
    assert_eq!(window.document().layout().levels.len(), 1);
    window
        .harness
        .event(Event::Paste("Guideway: 1 level".into()));
    window.harness.run_steps(3);
    let level = window.document().layout().levels.last();
    assert_eq!(
        level.map(|level| &*level.id),
        Some("upper"),
        "its name is free"
    );
    window.edit(|document| document.create_vehicle_type("crane", &[]));
    window.harness.run_steps(20);
    click(&mut window, "crane");
    window.key(NONE, Key::Delete);
    let names = window.document().layout().vehicle_type_names();
    assert!(!names.contains("crane"));
}

#[test]
fn elements_levels_and_types_are_deleted_together() {
    let mut window = window();
    let lane = window.at(5.0, 0.0);
    window.click(lane);
    click_with(&mut window, "upper", Modifiers::SHIFT);
    click_with(&mut window, "tug", Modifiers::SHIFT);
    window.key(NONE, Key::Delete);
    window.harness.run_steps(3);
    let too = "Deleted too: 1 path.";
    assert!(window.harness.query_by_label(too).is_some());
    click(&mut window, "Move to hall");
    click(&mut window, "Replace by fork");
    click(&mut window, "Delete");
    let document = window.document();
    assert_eq!(document.layout().levels.len(), 1);
    assert_eq!(document.scene().path_count(), 1);
    assert!(
        document
            .layout()
            .vehicle_type_names()
            .into_iter()
            .eq(["fork"])
    );
    window.key(CTRL, Key::Z);
    assert!(!window.document().is_changed(), "it is one step");
}

#[test]
fn a_right_click_selects_and_offers_the_commands() {
    let mut window = window();
    let at = window.harness.get_by_label("upper").rect().center();
    for pressed in [true, false] {
        window.harness.event(Event::PointerMoved(at));
        window.harness.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: NONE,
        });
        window.harness.run_steps(2);
    }
    window.harness.run_steps(2);
    assert_eq!(selected(&mut window), [Group::Level(1)]);
    let entry = window.harness.query_all_by_label_contains("Rename…").last();
    entry.expect("the menu is open").click();
    window.harness.run_steps(2);
    window.answer("loft");
    assert_eq!(window.document().layout().levels[1].id, "loft");
}

#[test]
fn find_lists_levels_and_types_and_leads_to_them() {
    let mut window = window();
    window.key(CTRL, Key::F);
    window.harness.run_steps(3);
    window.harness.event(Event::Text("upp".into()));
    window.wait(|app| {
        let document = app.files.document();
        document.is_some_and(|document| app.find.groups(document).count() == 1)
    });
    window.harness.run_steps(2);
    click(&mut window, "level upper");
    assert_eq!(selected(&mut window), [Group::Level(1)]);
    let view = window.app().canvas.camera.view().unwrap();
    assert!(
        (view.center_m().y - 2.0).abs() < 0.1,
        "{:?}",
        view.center_m()
    );
}

#[test]
fn commands_on_paths_need_more_than_a_level() {
    let mut window = window();
    click(&mut window, "upper");
    let state = window.app().command_state(1200.0);
    for (command, is_possible) in [
        (Command::Delete, true),
        (Command::Rename, true),
        (Command::Duplicate, true),
        (Command::Hide, true),
        (Command::ZoomToSelection, true),
        (Command::RotateLeft, false),
        (Command::Array, false),
        (Command::MoveToLevel, false),
    ] {
        assert_eq!(
            state.is_possible(command),
            is_possible,
            "{}",
            command.label()
        );
    }
    window.key(NONE, Key::H);
    assert_eq!(
        window.document().scene().draw_order(),
        [0],
        "the level is hidden"
    );
}
