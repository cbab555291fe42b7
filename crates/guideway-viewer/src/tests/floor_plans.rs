//! Floor plans by hand: moved by a drag, scaled by two points, faded, locked.

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

use super::services::lanes;
use super::test_window::{TestWindow, has_notice};
use crate::backdrop::PlanTask;
use crate::command::Command;

const NONE: Modifiers = Modifiers::NONE;

fn with_plan() -> TestWindow {
    let mut window = TestWindow::showing(lanes(3));
    let app = window.app();
    let context = app.context.clone();
    let text = "hall.png@px-per-m=20,offset=0,0";
    app.floor_plan
        .set(text, &context.services, &context.repaint);
    window.wait(|app| app.floor_plan.shown().is_some());
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::PlaceFloorPlan, &ctx);
    window.harness.run_steps(3);
    window
}

/// A window with a plan on which two points are chosen, and their distance in meters.
fn with_two_points() -> (TestWindow, f64) {
    let mut window = with_plan();
    window.harness.get_by_label("Scale by two points").click();
    window.harness.run_steps(3);
    for x in [0.0, 8.0] {
        let at = window.at(x, 3.0);
        window.click(at);
    }
    let measured = window.app().plan_editor.distance_m;
    (window, measured)
}

fn placed(window: &mut TestWindow) -> String {
    window.app().floor_plan.text().to_owned()
}

fn assert_scaled_twofold(window: &mut TestWindow) {
    let text = placed(window);
    assert!(text.starts_with("hall.png@px-per-m=10,"), "{text}");
    assert_eq!(window.app().plan_editor.task, PlanTask::None);
}

#[test]
fn two_points_of_known_distance_scale_the_plan() {
    let (mut window, measured) = with_two_points();
    assert!((measured - 8.0).abs() < 0.1, "{measured}");
    assert!(window.selected().is_empty(), "the clicks are for the plan");
    window.app().plan_editor.distance_m = 2.0 * measured;
    window.harness.run_steps(2);
    window.harness.get_by_label("Apply").click();
    window.harness.run_steps(3);
    assert_scaled_twofold(&mut window);
    window.wait(|app| !app.floor_plan.is_reading() && app.floor_plan.shown().is_some());
}

#[test]
fn distance_is_typed_right_after_the_second_click() {
    let (mut window, measured) = with_two_points();
    window.harness.run_steps(2);
    window.answer(&format!("{}", 2.0 * measured));
    assert_scaled_twofold(&mut window);
    assert_eq!(window.document().layout().paths.len(), 3);
}

#[test]
fn drag_moves_the_plan_and_escape_takes_it_back() {
    let mut window = with_plan();
    window.harness.get_by_label("Move by hand").click();
    window.harness.run_steps(3);
    let (from, to) = (window.at(2.0, 3.0), window.at(5.0, 1.0));
    window.drag(from, to);
    let placement = window.app().floor_plan.placement().unwrap();
    let by_m = placement.offset_m;
    assert!((by_m.x - 3.0).abs() < 0.1 && (by_m.y + 2.0).abs() < 0.1);
    assert!(window.document().undo_redo_names().0.is_none());
    window.wait(|app| !app.floor_plan.is_reading());
    assert_eq!(window.app().floor_plan.shift_m, Default::default());
    window.key(NONE, Key::Escape);
    assert_eq!(window.app().plan_editor.task, PlanTask::None);
    let text = placed(&mut window);
    window.drag(from, to);
    assert_eq!(placed(&mut window), text, "the task is over");
}

#[test]
fn locked_plan_stays() {
    let mut window = with_plan();
    window.harness.get_by_label("Move by hand").click();
    window.harness.run_steps(3);
    window.app().floor_plan.is_locked = true;
    let before = placed(&mut window);
    let (from, to) = (window.at(2.0, 3.0), window.at(5.0, 1.0));
    window.drag(from, to);
    assert_eq!(placed(&mut window), before);
}

#[test]
fn plan_that_cannot_be_read_is_told_and_the_present_one_stays() {
    let mut window = with_plan();
    window.harness.get_by_label("Move by hand").click();
    window.harness.run_steps(3);
    let (from, to) = (window.at(2.0, 3.0), window.at(5.0, 1.0));
    window.drag(from, to);
    window.wait(|app| !app.floor_plan.is_reading());
    let before = placed(&mut window);
    window.key(NONE, Key::Escape);
    window.key(Modifiers::COMMAND, Key::L);
    window.app().dialogs.prompt.open_mut().unwrap().text = "hall.bmp".into();
    window.key(NONE, Key::Enter);
    window.wait(|app| has_notice(app, "not a floor plan"));
    assert_eq!(placed(&mut window), before);
    window.wait(|app| app.floor_plan.shown().is_some());
}
