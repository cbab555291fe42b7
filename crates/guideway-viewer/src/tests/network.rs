//! From a drawing to an openTCS plant, by keys and mouse only: the steps of docs/first-network.md.

use std::path::Path;

use eframe::egui::{Event, Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use guideway_document::SelectMode;
use guideway_formats::{ReadOptions, Target, read_bytes};
use guideway_layout::{CheckOptions, Direction, Layout, Severity, Value, check};
use guideway_network::{AnalyzeOptions, NoteSource, analyze};
use guideway_scene::Table;

use super::schema::schema_errors;
use super::services::TestServices;
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// A hall in meters: a loop with a gap of 3 mm, two lanes that meet and cross inside, a one-way
/// lane to a charger, walls, and the names of stations.
fn drawing() -> Layout {
    let line = |layer: &str, [x0, y0, x1, y1]: [f64; 4]| {
        format!("0|LINE|8|{layer}|10|{x0}|20|{y0}|11|{x1}|21|{y1}|")
    };
    let text = |text: &str, [x, y]: [f64; 2]| format!("0|TEXT|8|STATION|10|{x}|20|{y}|1|{text}|");
    let mut entities = String::new();
    for lane in [
        [0.0, 0.0, 20.0, 0.0],
        [20.0, 0.0, 20.0, 10.0],
        [20.0, 10.0, 0.0, 10.0],
        [0.0, 9.997, 0.0, 0.0],
        [10.0, 0.0, 10.0, 10.0],
        [0.0, 5.0, 20.0, 5.0],
    ] {
        entities += &line("LANES", lane);
    }
    entities += &line("CHARGE", [20.0, 0.0, 30.0, 0.0]);
    entities += &line("WALLS", [-2.0, -2.0, 32.0, -2.0]);
    entities += &line("WALLS", [-2.0, 12.0, 32.0, 12.0]);
    entities += &text("DOCK-1", [5.0, 0.4]);
    entities += &text("PICK-07", [20.3, 7.0]);
    entities += &text("CHARGER", [30.0, 0.3]);
    let file = format!(
        "0|SECTION|2|HEADER|9|$INSUNITS|70|6|0|ENDSEC|\
         0|SECTION|2|ENTITIES|{entities}0|ENDSEC|0|EOF|"
    );
    let bytes = file.replace('|', "\n").into_bytes();
    read_bytes("hall.dxf", &bytes, &ReadOptions::default()).expect("it is a drawing")
}

fn showing_drawing() -> TestWindow {
    let disk = TestServices::with([("hall.dxf", drawing())]);
    let mut window = TestWindow::open(&disk, &["hall.dxf"], Some("cpu"));
    window.wait(|app| app.document().is_some());
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::Network, &ctx);
    wait_for_draft(&mut window);
    window
}

fn wait_for_draft(window: &mut TestWindow) {
    window.wait(|app| app.bottom.network.is_ready(&app.files));
    window.harness.run_steps(3);
}

fn choose(window: &mut TestWindow, menu: &str, entry: &str) {
    window.harness.get_by_label(menu).click();
    window.harness.run_steps(3);
    window.harness.get_by_label(entry).click();
    window.harness.run_steps(3);
    window.key(NONE, Key::Escape);
    wait_for_draft(window);
}

fn counts(window: &mut TestWindow) -> [u64; 5] {
    let app = window.app();
    let report = &app
        .bottom
        .network
        .network(&app.files)
        .unwrap()
        .unwrap()
        .report;
    [
        report.edges,
        report.stations,
        report.gaps,
        report.junctions,
        report.crossings,
    ]
}

/// Findings above notes, of the layout and of its network.
fn findings(layout: &Layout) -> Vec<String> {
    let mut found = check(layout, &CheckOptions::default());
    found.append(analyze(layout, &AnalyzeOptions::default()));
    let all = layout.diagnostics.iter().chain(found.iter());
    all.filter(|finding| finding.severity > Severity::Info)
        .map(|finding| format!("{finding:?}"))
        .collect()
}

#[test]
fn from_a_drawing_to_a_plant_without_findings() {
    let mut window = showing_drawing();
    // The preview follows each choice.
    assert_eq!(counts(&mut window)[1..], [0, 1, 4, 1]);
    choose(&mut window, "Layers: 3 of 3", "WALLS (2)");
    assert_eq!(counts(&mut window), [13, 0, 1, 4, 1]);
    choose(&mut window, "Stations: none", "text:STATION (3)");
    assert_eq!(counts(&mut window), [15, 3, 1, 4, 1]);
    let report = "15 edges between 12 nodes, 3 stations";
    assert!(window.harness.query_by_label(report).is_some());
    window.app().bottom.network.options.two_way = false;
    window.harness.step();
    wait_for_draft(&mut window);
    let one_way = "one-way: vehicles drive as the lines were drawn";
    assert!(window.harness.query_by_label(one_way).is_some());
    let state = window.document().state();
    window.harness.get_by_label("Make the network").click();
    window.wait(|app| {
        let active = app.files.active().unwrap();
        active.is_untitled() && active.document().is_some() && active.tasks.findings().is_some()
    });
    window.harness.run_steps(4);
    let layers = window.app().files.layers();
    assert_eq!(layers[0].document().unwrap().state(), state);
    assert!(layers[0].look.opacity < 0.5, "the drawing is faded");
    assert_eq!(layers[1].name(), "hall-network.lif.json");
    let made = Table::ALL.map(|of| window.document().existing(of).count());
    assert_eq!(made, [15, 12, 3]);

    // The charger can be reached, and not left: its finding offers a way back.
    assert_eq!(window.app().side.tab, SideTab::Findings);
    let charger = window.document().layout().clone();
    assert!(!findings(&charger).is_empty());
    window.key(CTRL, Key::A);
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::TwoWay, &ctx);
    window.harness.run_steps(3);

    // Speeds of all paths at once.
    window.change(|document| {
        let all = document.existing(Table::Paths).collect();
        document.select(all, SelectMode::Replace);
    });
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(4);
    set_speed(&mut window, "1.2");

    // The ending selects the format.
    window.key(CTRL, Key::S);
    let prompt = window.app().dialogs.prompt.open_mut().unwrap();
    prompt.text = "hall.xml".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| has_notice(app, "Saved hall.xml"));
    let layout = window.disk.files.lock().unwrap()[Path::new("hall.xml")].clone();
    let mut bytes = Vec::new();
    Target::OpenTcs7.write(&layout, &mut bytes).unwrap();
    let errors = schema_errors("opentcs-model-7.0.0.xsd", &bytes).unwrap_or_default();
    assert_eq!(errors.trim(), "");
    let plant = read_bytes("hall.xml", &bytes, &ReadOptions::default()).unwrap();
    assert_eq!(findings(&plant), Vec::<String>::new());
    let sizes = [plant.paths.len(), plant.nodes.len(), plant.stations.len()];
    assert_eq!(sizes, [15, 12, 3]);
    for row in 0..plant.paths.len() {
        assert_eq!(plant.paths.get(row).direction(), Direction::Both);
        let speed = plant.paths.attributes.value(row, "maxSpeed");
        assert_eq!(speed, Some(Value::Float(1.2)), "path {row}");
    }
}

/// Adds the greatest speed to what is selected.
fn set_speed(window: &mut TestWindow, speed: &str) {
    window.harness.get_by_label("Add property").click();
    window.harness.run_steps(3);
    window.harness.get_by_label("maxSpeed").click();
    // The new field has the focus.
    window.harness.run_steps(4);
    window.harness.event(Event::Text(speed.into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.harness.run_steps(2);
}

#[test]
fn lines_of_a_drawing_have_no_direction() {
    let mut window = showing_drawing();
    let at = window.at(5.0, 5.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(3);
    let said = window.harness.query_by_label_contains(": 20 m");
    let said = said.and_then(|label| label.accesskit_node().value());
    assert!(said.is_some_and(|said| said.ends_with(": 20 m")));
}

#[test]
fn what_cannot_become_a_network_says_why() {
    let mut window = showing_drawing();
    window.app().bottom.network.options.max_pieces = 2;
    window.harness.step();
    wait_for_draft(&mut window);
    let why = window.harness.query_by_label_contains("more than 2 pieces");
    assert!(why.is_some());
    let make = window.harness.get_by_label("Make the network");
    assert!(make.accesskit_node().is_disabled());
    // An edit of the drawing is seen at once.
    window.app().bottom.network.options.max_pieces = 1000;
    wait_for_draft(&mut window);
    let before = counts(&mut window);
    window.edit(|document| {
        document.select([8].into_iter().collect(), SelectMode::Replace);
        document.delete_selection()
    });
    window.harness.step();
    wait_for_draft(&mut window);
    assert_eq!(counts(&mut window)[0], before[0] - 1);
    // A closed panel keeps its options, and frees the network.
    let stations: NoteSource = "text:STATION".parse().unwrap();
    window.app().bottom.network.options.stations = vec![stations];
    window.app().bottom.view = None;
    window.harness.run_steps(2);
    let app = window.app();
    assert!(app.bottom.network.network(&app.files).is_none());
    assert_eq!(app.bottom.network.options.stations.len(), 1);
}
