//! The checks of a layout and its network: refreshed after edits, marked, and fixed.

use eframe::egui::{Color32, Event, Key, Modifiers, Pos2, Shape};
use egui_kittest::kittest::Queryable;
use guideway_layout::{Code, Direction, Layout, Severity};
use guideway_spline::Point;

use super::services::lanes;
use super::test_window::TestWindow;
use crate::canvas::severity_color;
use crate::editing::MarkedSeverities;
use crate::panels::SideTab;

const CTRL: Modifiers = Modifiers::COMMAND;

/// A window with the findings of a layout in front.
fn showing(layout: Layout) -> TestWindow {
    let mut window = TestWindow::showing(layout);
    window.wait(|app| app.files.layers()[0].tasks.findings().is_some());
    window.app().side.open(SideTab::Findings);
    window.harness.run_steps(3);
    window
}

fn count(window: &mut TestWindow, code: Code) -> u64 {
    let findings = window.app().files.layers()[0].tasks.findings().unwrap();
    findings.diagnostics.count(code)
}

/// Waits until the findings are those of the present layout.
fn wait_for_findings(window: &mut TestWindow) {
    window.wait(|app| {
        let findings = app.files.layers()[0].tasks.findings();
        let state = app.document().map(|document| document.state());
        findings.is_some_and(|findings| Some(findings.state) == state)
    });
    window.harness.run_steps(3);
}

/// Lanes whose second one ends half a meter beside its node.
fn with_gap() -> Layout {
    let mut layout = lanes(3);
    layout.nodes.set_position_m(3, Point::new(10.5, 2.0));
    layout
}

#[test]
fn findings_follow_edits_and_options() {
    let mut window = showing(lanes(3));
    assert_eq!(count(&mut window, Code::Curvature), 0);
    let is_old = "These findings predate the last change";
    let hook = [(0.0, -9.0), (9.0, -9.0), (0.0, -8.0)].map(|(x, y)| Point::new(x, y));
    let drawn = window.document().draw_path("hook".into(), &hook, 0.0);
    drawn.unwrap();
    window.harness.step();
    assert!(window.harness.query_by_label(is_old).is_some());
    window.app().findings.min_radius_m = 2.0;
    wait_for_findings(&mut window);
    assert!(window.harness.query_by_label(is_old).is_none());
    window.wait(|app| {
        let findings = app.files.layers()[0].tasks.findings().unwrap();
        findings.diagnostics.count(Code::Curvature) == 1
    });
    window.document().undo();
    wait_for_findings(&mut window);
    assert_eq!(count(&mut window, Code::Curvature), 0);
}

#[test]
fn long_check_runs_on_request_only() {
    let mut window = showing(lanes(3));
    let tasks = &mut window.app().files.layers_mut()[0].tasks;
    let mut findings = tasks.take_findings().unwrap();
    findings.elapsed = std::time::Duration::from_secs(5);
    tasks.set_findings(findings);
    window.key(CTRL, Key::A);
    window.key(Modifiers::NONE, Key::R);
    window.harness.run_steps(20);
    let is_old = "These findings predate the last change";
    assert!(window.harness.query_by_label(is_old).is_some());
    window.harness.get_by_label("Check again").click();
    wait_for_findings(&mut window);
    assert!(window.harness.query_by_label(is_old).is_none());
}

#[test]
fn tab_counts_and_pointer_tells_the_finding() {
    let mut window = showing(with_gap());
    let errors_warnings_notes = {
        let findings = window.app().files.layers()[0].tasks.findings().unwrap();
        let at_least = |severity| findings.diagnostics.count_at_least(severity);
        [Severity::Error, Severity::Warning, Severity::Info].map(at_least)
    };
    assert_eq!(errors_warnings_notes[0], 0);
    let warnings = errors_warnings_notes[1];
    let title = format!("Findings {warnings}");
    assert!(window.harness.query_by_label_contains(&title).is_some());
    let at = window.at(10.0, 2.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(3);
    let is_told = |window: &TestWindow| {
        let all = window
            .harness
            .query_all_by_label_contains("path \"lane 1\"");
        all.count()
    };
    assert!(is_told(&window) > 0, "the status bar tells it");
    window.app().findings.marked.0 = [false; 3];
    window.harness.run_steps(3);
    assert_eq!(is_told(&window), 0, "findings are not marked");
}

#[test]
fn pins_are_in_the_colors_of_their_severities() {
    let mut window = showing(lanes(9));
    let severities = [Severity::Error, Severity::Warning, Severity::Info];
    let tasks = &mut window.app().files.layers_mut()[0].tasks;
    let mut findings = tasks.take_findings().unwrap();
    assert!(
        findings.marks.len() > 3,
        "lanes that lead nowhere have findings"
    );
    // Three at places of their own, the others out of sight.
    let heights = [0.0, 4.0, 8.0];
    for (number, mark) in findings.marks.iter_mut().enumerate() {
        mark.severity = severities[number.min(2)];
        let y = heights.get(number).copied().unwrap_or(1e5);
        mark.at_m = Point::new(5.0, y);
    }
    tasks.set_findings(findings);
    window.app().findings.marked = MarkedSeverities([true; 3]);
    window.harness.run_steps(2);
    let heads: Vec<(Pos2, Color32)> = {
        let shapes = window.harness.output().shapes.iter();
        let circles = shapes.filter_map(|shape| match &shape.shape {
            Shape::Circle(circle) => Some((circle.center, circle.fill)),
            _ => None,
        });
        circles.collect()
    };
    for (severity, y) in severities.into_iter().zip(heights) {
        let at = window.at(5.0, y);
        let mut near = heads.iter().filter(|(head, _)| head.distance(at) < 20.0);
        let pin = near.next().map(|(_, fill)| *fill);
        assert_eq!(pin, Some(severity_color(severity)), "{severity:?}");
    }
    let colors = severities.map(severity_color);
    assert!(colors[0] != colors[1] && colors[1] != colors[2] && colors[0] != colors[2]);
}

#[test]
fn click_flies_to_the_finding_and_a_fix_is_one_step() {
    let mut window = showing(with_gap());
    window.harness.get_by_label("Node gap (1)").click();
    window.harness.run_steps(8);
    let link = |window: &TestWindow| {
        let link = window.harness.get_by_label_contains("path \"lane 1\"");
        link.rect()
    };
    let before = link(&window);
    window
        .harness
        .get_by_label_contains("path \"lane 1\"")
        .click();
    for _ in 0..8 {
        window.harness.step();
        assert_eq!(link(&window), before, "the list stays in its place");
    }
    assert_eq!(window.selected(), [1]);
    let seen = window.app().canvas.camera.view().unwrap().world_bounds();
    assert!(seen.contains(Point::new(5.0, 2.0)) && !seen.contains(Point::new(5.0, 40.0)));
    window.harness.get_by_label("Fix").click();
    window.harness.run_steps(3);
    let fix = "Move the ends of the path onto its nodes";
    window.harness.get_by_label(fix).click();
    wait_for_findings(&mut window);
    assert_eq!(count(&mut window, Code::NodeGap), 0);
    let end = window.document().layout().paths.get(1).ends().unwrap().1;
    assert!(end.distance(Point::new(10.5, 2.0)) < 1e-9);
    window.key(CTRL, Key::Z);
    wait_for_findings(&mut window);
    assert_eq!(count(&mut window, Code::NodeGap), 1);
    assert!(!window.document().is_changed());
}

#[test]
fn network_findings_are_fixed_in_the_window() {
    let mut layout = lanes(2);
    // One network: the lanes share their first node.
    let runs = {
        let mut runs = guideway_spline::Runs::default();
        runs.push_line(Point::new(0.0, 0.0), Point::new(10.0, 2.0));
        runs
    };
    layout.paths.push(&guideway_layout::NewPath {
        id: "link",
        runs: &runs,
        start_node: Some(0),
        end_node: Some(3),
        ..guideway_layout::NewPath::default()
    });
    let mut window = showing(layout);
    let before = count(&mut window, Code::DeadEnd);
    assert!(before > 0);
    let title = format!("Dead end ({before})");
    window.harness.get_by_label(&title).click();
    window.harness.run_steps(8);
    let menus: Vec<_> = window.harness.get_all_by_label("Fix").collect();
    menus[0].click();
    drop(menus);
    window.harness.run_steps(3);
    window.harness.get_by_label("Make lane 0 two-way").click();
    wait_for_findings(&mut window);
    let path = window.document().layout().paths.get(0);
    assert_eq!(path.direction(), Direction::Both);
}
