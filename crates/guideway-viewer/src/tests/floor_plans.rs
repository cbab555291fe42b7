//! Floor plans by hand: moved by a drag, scaled by two points or a unit, turned, faded, locked.

use eframe::egui::{Key, Modifiers, Shape};
use egui_kittest::kittest::Queryable;
use guideway_compose::FloorPlan;
use guideway_scene::{Budget, Frame, FrameSize, Rgba, Strip, View};
use guideway_spline::{Bounds, Point};

use super::services::{TestServices, lanes};
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

/// A JPEG image of 16 x 8 pixels: the left half is red, the right half blue.
const JPEG: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../guideway-formats/src/raster/halves.jpg"
);

/// A window with a JPEG image as its floor plan, and the dialog that it opens.
fn with_jpeg() -> TestWindow {
    let mut window = TestWindow::showing(lanes(3));
    window.key(Modifiers::COMMAND, Key::L);
    window.app().dialogs.prompt.open_mut().unwrap().text = JPEG.into();
    window.key(NONE, Key::Enter);
    window.wait(|app| app.floor_plan.shown().is_some());
    window.harness.run_steps(3);
    window
}

/// The color of the plan at a place, in meters.
fn color_at(plan: &FloorPlan, x: f64, y: f64) -> [u8; 4] {
    let size = FrameSize::new(1, 1).unwrap();
    let view = View::new(size, Point::new(x, y), 1_000.0).unwrap();
    let mut frame = Frame::new(size);
    let mut prepared = plan.prepare(&Budget::default()).unwrap();
    let drawn = prepared.render(&Strip::whole(&view), Rgba::WHITE, &mut frame);
    drawn.unwrap();
    frame.pixels()[0]
}

#[test]
fn jpeg_is_a_floor_plan() {
    let mut window = with_jpeg();
    let app = window.app();
    assert!(app.plan_editor.is_open, "its scale is to be set");
    assert!(app.floor_plan.error().is_none() && app.dialogs.notices.texts().is_empty());
    let plan = app.floor_plan.visible().unwrap();
    // 16 x 8 pixels of 5 cm.
    let size_m = plan.bounds().unwrap().size();
    assert!(size_m.distance(Point::new(0.8, 0.4)) < 1e-9, "{size_m:?}");
    let [red, blue] = [0.1, 0.7].map(|x| color_at(plan, x, 0.2));
    assert!(red[0] > 240 && red[2] < 15, "{red:?}");
    assert!(blue[2] > 240 && blue[0] < 15, "{blue:?}");
}

#[test]
fn rotation_field_turns_the_plan_about_its_middle() {
    let mut window = with_jpeg();
    let bounds = |window: &mut TestWindow| {
        window.wait(|app| !app.floor_plan.is_reading() && app.floor_plan.visible().is_some());
        let plan = window.app().floor_plan.visible().unwrap();
        plan.bounds().unwrap()
    };
    let before = bounds(&mut window);
    window.harness.get_by_label("Rotation").focus();
    window.answer("90");
    assert!(placed(&mut window).contains("rotate=90,"));
    let after = bounds(&mut window);
    assert!(after.center().distance(before.center()) < 1e-6);
    assert!(after.size().distance(Point::new(0.4, 0.8)) < 1e-6);
    // The red half, which was on the left, is below.
    let center = after.center();
    let plan = window.app().floor_plan.visible().unwrap();
    let [red, blue] = [-0.3, 0.3].map(|up| color_at(plan, center.x, center.y + up));
    assert!(red[0] > 240 && blue[2] > 240, "{red:?} {blue:?}");
}

#[test]
fn plan_is_painted_with_its_opacity() {
    let mut window = with_plan();
    for (opacity, alpha) in [(1.0, 255), (0.4, 102), (0.0, 0)] {
        window.app().floor_plan.opacity = opacity;
        window.harness.run_steps(2);
        let texture = window.app().floor_plan.shown().unwrap().0.id();
        let shapes = window.harness.output().shapes.iter();
        let mut tints = shapes.filter_map(|shape| match &shape.shape {
            Shape::Mesh(mesh) if mesh.texture_id == texture => Some(mesh.vertices[0].color.a()),
            _ => None,
        });
        assert_eq!(tints.next(), Some(alpha), "{opacity}");
    }
}

/// Opens a file as the floor plan by its name, and waits until it is read.
fn open_plan(window: &mut TestWindow, name: &str) {
    window.key(Modifiers::COMMAND, Key::L);
    window.app().dialogs.prompt.open_mut().unwrap().text = name.into();
    window.key(NONE, Key::Enter);
    window.wait(|app| !app.floor_plan.is_empty() && !app.floor_plan.is_reading());
    window.harness.run_steps(3);
}

#[test]
fn unit_of_a_drawing_that_states_none_is_asked() {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    open_plan(&mut window, "hall.dxf");
    let units = ["1 mm", "1 cm", "1 m", "1 in", "1 ft"].map(|unit| {
        let unit = window.harness.get_by_label(unit);
        unit.rect().left()
    });
    assert!(units.is_sorted(), "the assumed unit is the first one");
    let width_m = |window: &mut TestWindow| {
        let plan = window.app().floor_plan.visible();
        let bounds: Option<Bounds<f64>> = plan.and_then(|plan| plan.bounds());
        bounds.unwrap().size().x
    };
    assert!((width_m(&mut window) - 0.04).abs() < 1e-9);
    window.harness.get_by_label("1 m").click();
    window.harness.run_steps(2);
    window.wait(|app| !app.floor_plan.is_reading());
    assert_eq!(placed(&mut window), "hall.dxf@scale=1000");
    assert!((width_m(&mut window) - 40.0).abs() < 1e-9);
    let seen = window.app().canvas.camera.view().unwrap().world_bounds();
    assert!(seen.size().x > 40.0, "the view shows the plan: {seen:?}");
    // Its place is set there too, and a unit that is known is not asked.
    assert!(window.harness.query_by_label("Rotation").is_some());
    window.app().plan_editor.is_open = false;
    open_plan(&mut window, "hall.dxf@scale=10");
    assert!(!window.app().plan_editor.is_open);
}

#[test]
fn unit_of_a_drawing_is_kept_in_the_project() {
    use crate::services::FileAnswer;
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("hall.dxf");
    let disk = TestServices::with([]);
    for name in [&file, &folder.path().join("site.arrow")] {
        disk.files.lock().unwrap().insert(name.clone(), lanes(2));
    }
    let site = folder.path().join("site.arrow");
    let mut window = TestWindow::open(&disk, &[site.to_str().unwrap()], Some("cpu"));
    window.wait(|app| app.document().is_some());
    open_plan(&mut window, file.to_str().unwrap());
    window.harness.get_by_label("1 cm").click();
    window.harness.run_steps(2);
    let project = folder.path().join("hall.guideway-project.toml");
    let chosen = FileAnswer::Chosen(project.clone());
    disk.answers.lock().unwrap().push(chosen);
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::SaveProject, &ctx);
    window.wait(|app| has_notice(app, "Saved"));
    drop(window);
    let mut window = TestWindow::open(&disk, &[project.to_str().unwrap()], Some("cpu"));
    window.wait(|app| app.files.layers().len() == 1 && app.is_settled());
    window.wait(|app| app.floor_plan.visible().is_some());
    assert!(placed(&mut window).ends_with("hall.dxf@scale=10"));
    assert!(!window.app().plan_editor.is_open, "it is not asked again");
}
