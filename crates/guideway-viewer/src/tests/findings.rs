use egui_kittest::kittest::Queryable;
use guideway_layout::Code;
use guideway_spline::Point;

use super::desk::Desk;
use super::table::lanes;

#[test]
fn a_layout_is_looked_through_again_as_it_is_now() {
    let mut desk = Desk::looking_at(lanes(3));
    desk.wait(|app| app.layers[0].findings.is_some());
    let count = |desk: &mut Desk| {
        let findings = desk.app().layers[0].findings.as_ref().unwrap();
        (findings.found.count(Code::Curvature), findings.state)
    };
    assert_eq!(count(&mut desk), (0, 0));
    desk.harness.get_by_label("Findings").click();
    desk.harness.run_steps(8);
    let is_old = "These are from before what was changed last.";
    assert!(desk.harness.query_by_label(is_old).is_none());
    let hook = [(0.0, -9.0), (9.0, -9.0), (0.0, -8.0)].map(|(x, y)| Point::new(x, y));
    let drawn = desk.document().draw_path("hook".into(), &hook, 0.0);
    drawn.unwrap();
    desk.app().numbers.least_radius_m = 2.0;
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label(is_old).is_some());
    desk.harness.get_by_label("Check again").click();
    desk.wait(|app| app.layers[0].findings.as_ref().unwrap().state != 0);
    let state = desk.document().state();
    assert_eq!(count(&mut desk), (1, state));
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label(is_old).is_none());
    desk.document().undo();
    desk.harness.run_steps(3);
    assert!(desk.harness.query_by_label(is_old).is_some());
}
