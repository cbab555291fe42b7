//! From nothing to a valid LIF file, by keys and mouse only: the steps of docs/first-layout.md.

use std::path::Path;

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{By, Queryable};
use guideway_formats::{Loss, ReadOptions, Target, read_bytes};
use guideway_layout::{CheckOptions, Layout, Severity, Value, check};
use guideway_scene::Table;

use super::schema::schema_errors;
use super::services::TestServices;
use super::test_window::{TestWindow, has_notice};
use crate::services::LostPart;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Chooses two vehicle types with their speeds for what is drawn.
fn set_vehicle_types(window: &mut TestWindow) {
    let bar = "New paths: one-way, all vehicle types";
    window.harness.get_by_label(bar).click();
    window.harness.run_steps(3);
    let label = "Vehicle types, with their speeds in m/s";
    let field = By::new().role(Role::TextInput).label(label);
    window.harness.get(field).focus();
    window.harness.run_steps(2);
    window
        .harness
        .event(Event::Text("tugger: 1.5, stacker: 1.2".into()));
    window.harness.run_steps(2);
    window
        .harness
        .get_by_label("New paths: one-way, tugger, stacker")
        .click();
    window.harness.run_steps(3);
    window.key(NONE, Key::Escape);
}

fn draw(window: &mut TestWindow, tool: Key, points: &[&str]) {
    window.key(NONE, tool);
    for point in points {
        window.type_line(point);
    }
    window.key(NONE, Key::Enter);
}

/// A loop with a rounded corner, a second one beside it, and a link.
fn draw_network(window: &mut TestWindow) {
    draw(window, Key::D, &["0,0", "10,0", "10,8", "0,8", "0,0"]);
    window.key(NONE, Key::Escape);
    let corner = window.at(10.0, 8.0);
    window.click(corner);
    window.key(NONE, Key::Q);
    window.answer("2");
    // An arc that goes on from the first line, to the left.
    window.key(NONE, Key::O);
    window.type_line("10,0");
    window.type_line("12,2");
    let at = window.at(12.0, 0.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    window.type_line("r2");
    draw(window, Key::D, &["12,2", "@0,10", "12<180"]);
    draw(window, Key::C, &["0,12", "-2,10", "0,8"]);
    window.key(NONE, Key::W);
    window.type_line("5,0");
    window.type_line("5,8");
    draw(window, Key::D, &["5,8", "5,0"]);
}

fn create_stations(window: &mut TestWindow) {
    window.key(NONE, Key::S);
    for place in ["5,0", "12,12", "0,12"] {
        window.type_line(place);
    }
    window.key(NONE, Key::F2);
    window.answer("dock");
}

/// The parts of a layout that a format does not hold as they are.
fn losses_in(layout: &Layout, target: Target) -> Vec<LostPart> {
    let losses = target.write(layout, &mut Vec::new());
    let losses = losses.expect("memory takes all bytes");
    let part = |loss: &Loss| LostPart {
        what: loss.what.clone(),
        count: loss.count,
        detail: loss.detail.clone(),
    };
    losses.iter().map(part).collect()
}

fn written(layout: &Layout, target: Target) -> Layout {
    let mut bytes = Vec::new();
    let losses = target
        .write(layout, &mut bytes)
        .expect("memory takes all bytes");
    // A value that LIF 1.0 requires, or derives from paths, is no loss of content.
    let is_derived = |loss: &String| {
        let derived = [
            "because the format requires one",
            "are read as those of their paths",
        ];
        derived.iter().any(|text| loss.contains(text))
    };
    let losses = losses.iter().map(|loss| loss.to_string());
    let losses: Vec<String> = losses.filter(|loss| !is_derived(loss)).collect();
    assert!(losses.is_empty(), "{target:?}: {losses:?}");
    if target == Target::Lif1 {
        let errors = schema_errors("LIF-1.0.schema.json", &bytes).unwrap_or_default();
        assert_eq!(errors.trim(), "");
    }
    read_bytes("first.lif.json", &bytes, &ReadOptions::default()).expect("it is valid")
}

#[test]
fn from_nothing_to_a_valid_lif_file() {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    window.key(CTRL, Key::N);
    window.wait(|app| app.document().is_some());
    assert_eq!(
        window.app().files.active().unwrap().name(),
        "untitled.lif.json"
    );
    set_vehicle_types(&mut window);
    draw_network(&mut window);
    create_stations(&mut window);
    let counts = Table::ALL.map(|of| window.document().existing(of).count());
    assert_eq!(counts, [12, 10, 3], "paths, nodes, stations");

    // The first save asks for a name, and tells what LIF holds in another form.
    let drawn = window.document().layout().clone();
    *window.disk.losses.lock().unwrap() = losses_in(&drawn, Target::Lif1);
    window.key(CTRL, Key::S);
    assert!(!window.app().writer.is_busy());
    let prompt = window.app().dialogs.prompt.open_mut().unwrap();
    assert_eq!(prompt.text, "untitled.lif.json");
    prompt.text = "first.lif.json".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.dialogs.losses.is_open());
    window.harness.run_steps(3);
    let required = window
        .harness
        .query_by_label_contains("rotationAllowed (12)");
    assert!(required.is_some());
    window.harness.get_by_label("Save anyway").click();
    window.wait(|app| has_notice(app, "Saved first.lif.json"));
    window.wait(|app| app.files.active().is_some_and(|layer| !layer.is_changed()));
    let layout = window.disk.files.lock().unwrap()[Path::new("first.lif.json")].clone();
    // The next one asks neither.
    window.key(NONE, Key::S);
    window.type_line("30,30");
    window.key(CTRL, Key::S);
    assert!(window.app().dialogs.prompt.open_mut().is_none());
    window.wait(|app| app.files.active().is_some_and(|layer| !layer.is_changed()));
    assert!(!window.app().dialogs.losses.is_open());

    for target in [Target::Lif1, Target::Lif2] {
        let read = written(&layout, target);
        let counts = [read.paths.len(), read.nodes.len(), read.stations.len()];
        assert_eq!(counts, [12, 10, 3], "{target:?}");
        let found = check(&read, &CheckOptions::default());
        let found: Vec<String> = (read.diagnostics.iter().chain(found.iter()))
            .filter(|finding| finding.severity > Severity::Info)
            .map(|finding| format!("{finding:?}"))
            .collect();
        assert!(found.is_empty(), "{target:?}: {found:?}");
        assert_eq!(read.levels.len(), 1);
        let types = read.paths.vehicle_types();
        for row in 0..read.paths.len() {
            let path = read.paths.get(row);
            assert!(path.start_node().is_some() && path.end_node().is_some());
            for (name, speed) in [("tugger", 1.5), ("stacker", 1.2)] {
                let entry = types.entry_for(row, name).unwrap();
                let column = types.attributes.get("maxSpeed").unwrap();
                assert_eq!(column.values.get(entry), Some(Value::Float(speed)));
            }
        }
        let ids: Vec<&str> = (0..3).map(|row| read.stations.id(row)).collect();
        assert!(ids.contains(&"dock"), "{ids:?}");
    }
}

#[test]
fn new_layouts_lie_beside_open_files_and_close_like_them() {
    let disk = TestServices::with([
        ("site.arrow", super::services::lanes(2)),
        ("untitled.lif.json", super::services::lanes(5)),
    ]);
    let mut window = TestWindow::open(&disk, &["site.arrow"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    for count in [2, 3] {
        window.key(CTRL, Key::N);
        window.wait(|app| app.files.layers().len() == count && app.document().is_some());
    }
    let names: Vec<String> = window
        .app()
        .files
        .layers()
        .iter()
        .map(|l| l.name())
        .collect();
    // A file on disk has the first name.
    assert_eq!(
        names,
        ["site.arrow", "untitled-2.lif.json", "untitled-3.lif.json"]
    );
    window.key(CTRL, Key::W);
    assert_eq!(
        window.app().files.layers().len(),
        2,
        "an empty one closes at once"
    );
    draw(&mut window, Key::D, &["0,0", "5,0"]);
    window.key(CTRL, Key::W);
    assert!(
        window
            .harness
            .query_by_label("Close without saving")
            .is_some()
    );
    window.key(NONE, Key::Escape);
    // The name of another file is not taken without a question.
    window.key(CTRL, Key::S);
    window.app().dialogs.prompt.open_mut().unwrap().text = "site.arrow".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.dialogs.confirm.is_open());
    window.harness.run_steps(2);
    assert!(window.harness.query_by_label("Replace it").is_some());
}
