//! The route between two clicked places, and the comparison of two files.

use eframe::egui::accesskit::Role;
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use guideway_layout::{Layout, NewPath, Value};
use guideway_spline::{Point, Runs};

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::command::Command;
use crate::compare::ChangeKind;
use crate::panels::BottomView;

const NONE: Modifiers = Modifiers::NONE;

/// Four nodes in a row, 10 m apart, with one-way paths between them, for two vehicle types.
fn row() -> Layout {
    let mut layout = Layout::default();
    let at = |i: u32| Point::new(10.0 * f64::from(i), 0.0);
    for i in 0..4 {
        layout.nodes.push(&format!("n{i}"), at(i), None);
    }
    for (id, a, types) in [
        ("a", 0, &["fork", "tug"][..]),
        ("b", 1, &["fork", "tug"]),
        ("c", 2, &["tug"]),
    ] {
        let mut runs = Runs::default();
        runs.push_line(at(a), at(a + 1));
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(a),
            end_node: Some(a + 1),
            vehicle_types: types,
            ..NewPath::default()
        });
    }
    layout
}

fn result(window: &mut TestWindow) -> Result<(f64, usize), String> {
    window.wait(|app| !app.bottom.route.is_busy() && app.bottom.route.result(0).is_some());
    let found = window.app().bottom.route.result(0).unwrap();
    found
        .map(|route| (route.length_m, route.steps.len()))
        .map_err(str::to_owned)
}

#[test]
fn route_between_clicked_places_is_shown_with_its_reason_or_steps() {
    let mut window = TestWindow::showing(row());
    window.key(Modifiers::SHIFT, Key::R);
    window.harness.run_steps(3);
    window.key(NONE, Key::F);
    let hint = "Click the station or node where the route starts";
    assert!(window.harness.query_by_label(hint).is_some());
    let nowhere = window.at(15.0, 3.0);
    window.click(nowhere);
    assert!(has_notice(window.app(), "Nothing is there"));
    let (start, goal) = (window.at(0.0, 0.0), window.at(20.0, 0.0));
    window.click(start);
    window.click(goal);
    assert_eq!(result(&mut window), Ok((20.0, 2)));
    window.harness.run_steps(3);
    assert!(
        window
            .harness
            .query_by_label("2 paths, 20 m, 20.0 s")
            .is_some()
    );
    assert!(window.selected().is_empty(), "the clicks chose places");
    // The end of a path counts too; the forklift may not go there.
    window.harness.get_by_label_contains("To: n2").click();
    window.harness.run_steps(2);
    let near_end = window.at(28.0, 0.0);
    window.click(near_end);
    let why = result(&mut window).unwrap_err();
    assert!(why.contains("no way leads from \"n0\" to \"n3\""), "{why}");
    window.app().bottom.route.vehicle_type = Some("tug".into());
    window.harness.run_steps(2);
    window.wait(|app| {
        app.bottom
            .route
            .result(0)
            .is_some_and(|found| found.is_ok())
    });
    assert_eq!(result(&mut window), Ok((30.0, 3)));
    // An edit searches again, and a step flies to its path.
    window.harness.run_steps(3);
    window.harness.get_by_label_contains("2. b to n2").click();
    window.harness.run_steps(3);
    assert_eq!(window.selected(), [1]);
    window.key(NONE, Key::Delete);
    window.wait(|app| {
        app.bottom
            .route
            .result(0)
            .is_some_and(|found| found.is_err())
    });
}

#[test]
fn swept_area_is_that_of_the_vehicle() {
    let mut window = TestWindow::showing(row());
    window.key(Modifiers::SHIFT, Key::R);
    window.app().bottom.route.shows_area = true;
    window.key(NONE, Key::F);
    let (start, goal) = (window.at(0.0, 0.0), window.at(10.0, 0.0));
    window.click(start);
    window.click(goal);
    assert_eq!(result(&mut window), Ok((10.0, 1)));
    let area_m2 = |window: &mut TestWindow| {
        let found = window.app().bottom.route.result(0).unwrap().unwrap();
        found
            .area
            .iter()
            .map(|polygon| polygon.area_m2())
            .sum::<f64>()
    };
    let narrow = area_m2(&mut window);
    assert!((narrow - 12.0 * 1.2).abs() < 0.1, "{narrow}");
    window.app().swept_areas.vehicle_text = "2x2".into();
    window.harness.run_steps(2);
    window.wait(|app| !app.bottom.route.is_busy());
    window.harness.run_steps(2);
    let wide = area_m2(&mut window);
    assert!((wide - 12.0 * 2.0).abs() < 0.1, "{wide}");
}

#[test]
fn click_on_the_slider_within_one_frame_moves_the_vehicle_and_the_view_follows() {
    let mut window = TestWindow::showing(row());
    window.key(Modifiers::SHIFT, Key::R);
    window.key(NONE, Key::F);
    let (start, goal) = (window.at(0.0, 0.0), window.at(20.0, 0.0));
    window.click(start);
    window.click(goal);
    assert_eq!(result(&mut window), Ok((20.0, 2)));
    // The goal is out of sight.
    let around = Point::new(-30.0, 0.0);
    window.app().canvas.camera.look_at(around, 20.0);
    window.harness.run_steps(3);
    let slider = window.harness.get_by_role(Role::Slider).rect();
    let seen = |window: &mut TestWindow, x: f64| {
        let view = window.app().canvas.camera.view().unwrap();
        view.world_bounds().contains(Point::new(x, 0.0))
    };
    let press = |at: Pos2, pressed| Event::PointerButton {
        pos: at,
        button: PointerButton::Primary,
        pressed,
        modifiers: NONE,
    };
    let at = slider.lerp_inside(Vec2::new(0.75, 0.5));
    assert!(!seen(&mut window, 15.0));
    let events = [Event::PointerMoved(at), press(at, true), press(at, false)];
    window.harness.input_mut().events.extend(events);
    window.harness.step();
    let driven = window.app().bottom.route.driven;
    assert!((driven - 0.75).abs() < 0.05, "{driven}");
    assert!(seen(&mut window, 15.0));
    assert_eq!(window.app().canvas.camera.view().unwrap().px_per_m(), 20.0);
}

#[test]
fn escape_ends_the_choice_of_places() {
    let mut window = TestWindow::showing(row());
    window.key(Modifiers::SHIFT, Key::R);
    assert!(window.app().bottom.picks_places());
    window.key(NONE, Key::Escape);
    assert!(!window.app().bottom.picks_places());
    window.key(NONE, Key::F);
    let at = window.at(15.0, 0.0);
    window.click(at);
    assert_eq!(window.selected(), [1], "a click selects again");
}

#[test]
fn changes_of_two_files_are_listed_and_flown_to() {
    let mut old = lanes(6);
    old.paths.attributes.set(1, "speed", Value::Float(9.0));
    let disk = TestServices::with([("old.arrow", old), ("new.arrow", lanes(5))]);
    let mut window = TestWindow::open(&disk, &["old.arrow", "new.arrow"], Some("cpu"));
    window.wait(|app| {
        let layers = app.files.layers();
        layers.iter().all(|layer| layer.document().is_some())
    });
    let ctx = window.harness.ctx.clone();
    window.app().perform(Command::Compare, &ctx);
    assert_eq!(window.app().bottom.view, Some(BottomView::Compare));
    let counts = |window: &mut TestWindow| {
        window.wait(|app| {
            let changed = app.bottom.comparison.changed(&app.files);
            changed.is_some() && !app.bottom.comparison.is_busy()
        });
        window.harness.run_steps(3);
        let app = window.app();
        let changed = app.bottom.comparison.changed(&app.files).unwrap().unwrap();
        let kinds = [ChangeKind::Gone, ChangeKind::New, ChangeKind::Changed];
        kinds.map(|kind| changed.count(kind))
    };
    assert_eq!(
        counts(&mut window),
        [3, 0, 1],
        "a path and its nodes are gone"
    );
    let changed = "path lane 1: speed is 0.5, was 9";
    window.harness.get_by_label(changed).click();
    window.harness.run_steps(3);
    assert_eq!(window.selected(), [1]);
    window.harness.get_by_label("path lane 5: is gone").click();
    window.harness.run_steps(3);
    let seen = window.app().canvas.camera.view().unwrap().world_bounds();
    assert!(seen.contains(Point::new(5.0, 10.0)));
    assert_eq!(window.selected(), [1], "it is not in this file");
    // An edit is compared at once.
    window.key(NONE, Key::Delete);
    window.wait(|app| {
        let changed = app.bottom.comparison.changed(&app.files);
        changed.is_some_and(|changed| changed.is_ok_and(|c| c.count(ChangeKind::Gone) == 6))
    });
}
