//! The check of a layout.

use egui_kittest::kittest::Queryable;
use guideway_layout::Code;
use guideway_spline::Point;

use super::services::lanes;
use super::test_window::TestWindow;

#[test]
fn check_again_finds_defects_of_the_present_layout() {
    let mut window = TestWindow::showing(lanes(3));
    window.wait(|app| app.files.layers()[0].tasks.findings().is_some());
    let count = |window: &mut TestWindow| {
        let findings = window.app().files.layers()[0].tasks.findings().unwrap();
        (findings.diagnostics.count(Code::Curvature), findings.state)
    };
    assert_eq!(count(&mut window), (0, 0));
    window.harness.get_by_label("Findings").click();
    window.harness.run_steps(8);
    let is_old = "These findings predate the last change";
    assert!(window.harness.query_by_label(is_old).is_none());
    let hook = [(0.0, -9.0), (9.0, -9.0), (0.0, -8.0)].map(|(x, y)| Point::new(x, y));
    let drawn = window.document().draw_path("hook".into(), &hook, 0.0);
    drawn.unwrap();
    window.app().findings.min_radius_m = 2.0;
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label(is_old).is_some());
    window.harness.get_by_label("Check again").click();
    window.wait(|app| app.files.layers()[0].tasks.findings().unwrap().state != 0);
    let state = window.document().state();
    assert_eq!(count(&mut window), (1, state));
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label(is_old).is_none());
    window.document().undo();
    window.harness.run_steps(3);
    assert!(window.harness.query_by_label(is_old).is_some());
}
