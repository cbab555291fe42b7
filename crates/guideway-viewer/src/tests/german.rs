//! The window in German: no English is left in menus, panels, findings, reports and errors.

use eframe::egui::{Key, Modifiers, Shape};
use egui_kittest::kittest::{NodeT, Queryable};
use guideway_document::SelectMode;
use guideway_formats::ReadOptions;
use guideway_layout::Layout;
use guideway_spline::Point;

use super::lane_network::network;
use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::language::{Language, set_language, translated};
use crate::panels::SideTab;

/// Words that no German text of the window has.
const ENGLISH: &[&str] = &[
    "a", "and", "are", "at", "begins", "by", "ends", "for", "from", "has", "have", "is", "lead",
    "leads", "leave", "left", "neither", "no", "node", "nodes", "not", "of", "or", "path", "paths",
    "reach", "the", "they", "this", "to", "vehicles", "with", "without",
];

/// Returns `true` if a text has an English word outside of quotes, in which names of files are.
fn is_english(text: &str) -> bool {
    let own = text.split(['\u{201e}', '\u{201c}', '"']).step_by(2);
    let words = own.flat_map(str::split_whitespace);
    // Places in files are in no language.
    let words = words.filter(|word| {
        !word
            .trim_end_matches('.')
            .contains(['[', '.', '_', '-', '\'', '&'])
    });
    words
        .flat_map(|word| word.split(|c: char| !c.is_alphabetic()))
        .any(|word| ENGLISH.contains(&word))
}

/// The texts of the window that have an English word.
fn english(window: &TestWindow) -> Vec<String> {
    let nodes = window.harness.root().children_recursive();
    let texts = nodes.flat_map(|node| {
        let node = node.accesskit_node();
        [node.label(), node.value(), node.description()]
    });
    let texts = texts.flatten().filter(|text| is_english(text));
    let mut found: Vec<String> = texts.collect();
    found.sort_unstable();
    found.dedup();
    found
}

fn german(layout: Layout) -> TestWindow {
    let disk = TestServices::with([("halle.arrow", layout)]);
    let mut window = TestWindow::open(&disk, &["halle.arrow"], Some("cpu"));
    window.app().settings.language = Some(Language::German);
    window.wait(|app| app.document().is_some());
    window.wait(|app| app.files.layers()[0].tasks.findings().is_some());
    window.harness.run_steps(3);
    window
}

/// Faults of paths and of the network.
fn faulty() -> Layout {
    let mut layout = network(9);
    layout.nodes.set_position_m(3, Point::new(10.5, 2.0));
    layout
        .paths
        .attributes
        .set_quantity(2, "maxSpeed", 400.0, guideway_layout::Quantity::Speed);
    layout.nodes.push("abseits", Point::new(50.0, 50.0), None);
    layout.stations.push("ohne", None, Vec::new(), None);
    layout
}

#[test]
fn english_is_recognized() {
    let window = TestWindow::showing(lanes(2));
    assert!(!english(&window).is_empty());
}

#[test]
fn findings_and_their_fixes_are_german() {
    let mut window = german(faulty());
    window.app().side.open(SideTab::Findings);
    window.harness.run_steps(3);
    let findings = window.app().files.layers()[0].tasks.findings().unwrap();
    assert!(findings.diagnostics.counts().count() > 4);
    // The headers of the lists, from below: an open one moves those that follow.
    let headers: Vec<_> = window.harness.query_all_by_label_contains(" (").collect();
    for header in headers.iter().rev() {
        header.click();
    }
    drop(headers);
    window.harness.run_steps(12);
    let is_shown = |window: &TestWindow, text: &str| {
        window.harness.query_all_by_label_contains(text).count() > 0
    };
    assert!(is_shown(&window, "Weg \u{201e}lane 1\u{201c}: endet bei"));
    assert_eq!(english(&window), [""; 0]);
    let fixes: Vec<_> = window.harness.query_all_by_label("Beheben").collect();
    assert!(!fixes.is_empty());
    fixes[0].click();
    drop(fixes);
    window.harness.run_steps(3);
    assert_eq!(english(&window), [""; 0]);
}

/// Reads the damaged and odd files of all formats, with all that is found.
#[test]
fn findings_and_errors_of_files_are_german() {
    set_language(Language::German);
    let (mut texts, mut english) = (0, Vec::new());
    let mut look_at = |text: String| {
        texts += 1;
        let german = translated(&text);
        // The library of Arrow has texts of its own.
        let is_arrow = ["argument error", "Ipc error", "Type `i"]
            .iter()
            .any(|s| text.contains(s));
        if is_english(&german) && !is_arrow {
            english.push(format!("{text} -> {german}"));
        }
    };
    for format in guideway_bad_files::FORMATS {
        for (name, bytes) in guideway_bad_files::inputs(format).unwrap().iter() {
            match guideway_formats::read_bytes(name, bytes, &ReadOptions::default()) {
                Ok(layout) => {
                    for finding in layout.diagnostics.iter() {
                        look_at(finding.place.to_string());
                        look_at(finding.message.clone());
                        look_at(finding.remedy.to_string());
                    }
                }
                Err(error) => look_at(error.to_string()),
            }
        }
    }
    set_language(Language::English);
    assert!(texts > 1_000, "{texts}");
    english.sort_unstable();
    english.dedup();
    assert!(
        english.is_empty(),
        "{} of {texts}: {english:#?}",
        english.len()
    );
}

#[test]
fn report_of_a_network_is_german() {
    let mut layout = lanes(4);
    let dot = layout.paths.len();
    layout.paths.push(&guideway_layout::NewPath::default());
    assert_eq!(layout.paths.len(), dot + 1);
    let mut window = german(layout);
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::Network, &ctx);
    window.wait(|app| app.bottom.network.is_ready(&app.files));
    window.harness.run_steps(3);
    let line = window
        .harness
        .query_all_by_label_contains("beide Richtungen");
    let one_way = window
        .harness
        .query_all_by_label_contains("Einbahn: Fahrzeuge");
    assert!(line.count() + one_way.count() > 0);
    assert_eq!(english(&window), [""; 0]);
}

/// The choice of a flag that differs has a button behind it, and little room.
#[test]
fn choices_of_several_values_are_not_cut() {
    let mut layout = lanes(2);
    for (row, flag) in [(0, true), (1, false)] {
        layout.paths.vehicle_types_mut().set(row, &["tug"]);
        let value = guideway_layout::Value::Bool(flag);
        layout.paths.attributes.set(row, "rotationAllowed", value);
    }
    let mut window = german(layout);
    for (language, word) in [
        (Language::German, "mehrere"),
        (Language::English, "several"),
    ] {
        window.app().settings.language = Some(language);
        window.key(Modifiers::COMMAND, Key::A);
        window.app().side.open(SideTab::Properties);
        window.harness.run_steps(4);
        let shapes = window.harness.output().shapes.iter();
        let texts = shapes.filter_map(|shape| match &shape.shape {
            Shape::Text(text) if text.galley.job.text == word => Some(&text.galley),
            _ => None,
        });
        let texts: Vec<_> = texts.collect();
        assert!(!texts.is_empty(), "{word}");
        assert!(texts.iter().all(|text| !text.elided), "{word} is cut");
    }
}

#[test]
fn refused_edits_are_told_in_german() {
    let mut window = german(lanes(3));
    window.change(|document| document.select([0, 1].into_iter().collect(), SelectMode::Replace));
    window.harness.run_steps(2);
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::SplitCrossings, &ctx);
    window.wait(|app| has_notice(app, "die Wege kreuzen sich nicht"));
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(english(&window), [""; 0]);
}
