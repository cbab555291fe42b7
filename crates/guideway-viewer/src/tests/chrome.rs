//! The parts around the canvas: toolbar, context menu, settings, what the window remembers.

use std::path::Path;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::{By, NodeT, Queryable};

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::canvas::shown_legends;
use crate::display_settings::ThemeChoice;
use crate::language::Language;
use crate::panels::SideTab;
use crate::tools::Tool;
use crate::units::SpeedUnit;

const NONE: Modifiers = Modifiers::NONE;

fn right_click(window: &mut TestWindow, at: Pos2) {
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    for pressed in [true, false] {
        window.harness.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: NONE,
        });
        window.harness.step();
    }
    window.harness.run_steps(3);
}

#[test]
fn context_menu_acts_on_what_is_under_the_pointer() {
    let mut window = TestWindow::showing(lanes(3));
    let (path, node, empty) = (
        window.at(5.0, 2.0),
        window.at(10.0, 4.0),
        window.at(5.0, 3.0),
    );
    right_click(&mut window, path);
    assert_eq!(window.selected(), [1]);
    window
        .harness
        .get_by_label_contains("Hide selection")
        .click();
    window.harness.run_steps(3);
    assert_eq!(window.document().scene().hidden_count(), 1);
    right_click(&mut window, node);
    let nodes: Vec<u32> = window.document().selected().nodes.iter().collect();
    assert_eq!(nodes.len(), 1, "the node at the end of lane 2");
    assert!(
        window
            .harness
            .query_by_label_contains("Hide selection")
            .is_none()
    );
    window.key(NONE, Key::Escape);
    right_click(&mut window, empty);
    window
        .harness
        .get_by_label_contains("Show all paths")
        .click();
    window.harness.run_steps(3);
    assert_eq!(window.document().scene().hidden_count(), 0);
}

#[test]
fn right_click_keeps_a_selection_that_it_is_in() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(Modifiers::COMMAND, Key::A);
    let at = window.at(5.0, 2.0);
    right_click(&mut window, at);
    assert_eq!(window.selected(), [0, 1, 2]);
}

#[test]
fn toolbar_selects_tools_and_greys_out_what_is_impossible() {
    let mut window = TestWindow::showing(lanes(3));
    window.harness.get_by_label("Draw lines").click();
    window.harness.run_steps(2);
    assert_eq!(window.app().tools.tool(), Tool::Line);
    window.harness.get_by_label("Select and move").click();
    window.harness.run_steps(2);
    assert_eq!(window.app().tools.tool(), Tool::Select);
    let is_possible = |window: &TestWindow| {
        let button = window.harness.get_by_label("Undo");
        !button.accesskit_node().is_disabled()
    };
    assert!(!is_possible(&window));
    window.key(Modifiers::COMMAND, Key::A);
    window.key(NONE, Key::R);
    assert!(is_possible(&window));
    window.harness.get_by_label("Undo").click();
    window.harness.run_steps(3);
    assert!(!window.document().is_changed());
}

#[test]
fn settings_outlive_the_window() {
    let folder = tempfile::tempdir().unwrap();
    let open = || {
        let disk = TestServices::with([("site.arrow", lanes(2))]);
        *disk.state.lock().unwrap() = Some(folder.path().to_owned());
        let mut window = TestWindow::open(&disk, &["site.arrow"], Some("cpu"));
        window.wait(|app| app.document().is_some());
        window
    };
    let mut window = open();
    window.key(NONE, Key::A);
    window.key(NONE, Key::B);
    assert!(window.app().settings.is_dark);
    window.app().settings.grid_step_m = Some(2.5);
    window.harness.run_steps(2);
    // As if the program had been killed: settings are written when they change.
    drop(window);
    let mut window = open();
    let settings = window.app().settings.clone();
    assert!(!settings.has_arrows && settings.is_dark);
    assert_eq!(settings.theme, ThemeChoice::Dark);
    assert_eq!(settings.grid_step_m, Some(2.5));
    window.app().window_place.size = [777.0, 555.0];
    window.app().leave();
    let text = std::fs::read_to_string(folder.path().join("window.toml")).unwrap();
    assert!(text.contains("777"), "{text}");
    std::fs::write(folder.path().join("window.toml"), "theme = [").unwrap();
    let mut window = open();
    assert!(has_notice(window.app(), "window.toml"));
    assert!(!window.app().settings.is_dark);
    assert!(Path::new(folder.path()).join("recent-files").exists());
}

#[test]
fn settings_dialog_changes_theme_and_grid() {
    use crate::command::Command;
    let mut window = TestWindow::showing(lanes(2));
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::Settings, &ctx);
    window.harness.run_steps(3);
    window.harness.get_by_label("dark").click();
    window.harness.run_steps(3);
    assert!(window.app().settings.is_dark);
    window.harness.get_by_label("every").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().settings.grid_step_m, Some(1.0));
    window.key(NONE, Key::Escape);
    assert!(!window.app().dialogs.settings.is_open);
    window.app().perform(Command::About, &ctx);
    window.harness.run_steps(3);
    let licenses = env!("CARGO_PKG_LICENSE");
    let line = window.harness.query_by_label_contains(licenses);
    assert!(line.is_some());
    let version = concat!("Guideway ", env!("CARGO_PKG_VERSION"));
    assert!(window.harness.query_by_label(version).is_some());
}

#[test]
fn legend_is_about_the_colors_that_are_drawn() {
    let mut layout = lanes(3);
    for row in 0..3 {
        let speed = guideway_layout::Value::Float(0.5 + row as f64);
        layout.paths.attributes.set(row, "speed", speed);
    }
    let mut window = TestWindow::showing(layout);
    let title = |window: &mut TestWindow| {
        let app = window.app();
        let colors = shown_legends(&app.files, &app.settings);
        colors.first().map(|colors| colors.title())
    };
    assert_eq!(title(&mut window), None);
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.wait(|app| app.files.is_settled());
    assert_eq!(title(&mut window).as_deref(), Some("speed"));
    window.app().settings.is_density = true;
    window.wait(|app| !shown_legends(&app.files, &app.settings).is_empty());
    assert_eq!(title(&mut window).as_deref(), Some("paths per pixel"));
}

#[test]
fn speeds_are_shown_and_typed_in_the_unit_of_the_settings() {
    let mut layout = lanes(2);
    let attributes = &mut layout.paths.attributes;
    for row in 0..2 {
        attributes.set_quantity(row, "maxSpeed", 1.5, guideway_layout::Quantity::Speed);
    }
    let mut window = TestWindow::showing(layout);
    window.app().side.open(SideTab::Properties);
    window.key(Modifiers::COMMAND, Key::A);
    window.harness.run_steps(3);
    window.app().settings.speed_unit = SpeedUnit::KilometersPerHour;
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label("maxSpeed (km/h)").is_some());
    let field = By::new().role(Role::TextInput).value("5.4");
    window.harness.get(field).focus();
    window.harness.run_steps(2);
    window.key(Modifiers::COMMAND, Key::A);
    window.harness.event(Event::Text("3.6".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    let attributes = &window.document().layout().paths.attributes;
    for row in 0..2 {
        let speed = attributes.value(row, "maxSpeed");
        let speed_m_s = speed.and_then(|speed| speed.number());
        assert!(speed_m_s.is_some_and(|m_s| (m_s - 1.0).abs() < 1e-12));
    }
}

#[test]
fn german_window_has_german_menus_panels_and_notices() {
    let mut window = TestWindow::showing(lanes(3));
    window.app().settings.language = Some(Language::German);
    window.harness.run_steps(3);
    for label in ["Datei", "Bearbeiten", "Eigenschaften", "Befunde", "Suchen"] {
        let found = window.harness.query_all_by_label_contains(label).count();
        assert!(found > 0, "{label}");
    }
    window.key(Modifiers::COMMAND, Key::A);
    window.harness.run_steps(3);
    let counts = window
        .harness
        .query_all_by_label("3 Wege und 6 Knoten gewählt")
        .count();
    assert!(counts > 0);
    // A notice of a background thread.
    window.key(Modifiers::NONE, Key::Delete);
    window.key(Modifiers::COMMAND, Key::S);
    window.wait(|app| has_notice(app, "ist gespeichert"));
    window.app().settings.language = None;
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label("File").is_some());
}

#[test]
fn title_names_the_file_and_marks_changes() {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    assert_eq!(window.app().title, "Guideway");
    let mut window = TestWindow::showing(lanes(2));
    window.harness.run_steps(2);
    assert_eq!(window.app().title, "site.arrow - Guideway");
    window.key(Modifiers::COMMAND, Key::A);
    window.key(NONE, Key::Delete);
    window.harness.run_steps(2);
    assert_eq!(window.app().title, "site.arrow * - Guideway");
    window.key(Modifiers::COMMAND, Key::Z);
    window.harness.run_steps(2);
    assert_eq!(window.app().title, "site.arrow - Guideway");
}
