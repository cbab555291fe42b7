//! The grid that is shown, snapped to and told, and the marks of what the pointer snaps to.

use eframe::egui::accesskit::Role;
use eframe::egui::{Key, Modifiers, Pos2, Shape};
use egui_kittest::kittest::{By, NodeT, Queryable};
use guideway_spline::Point;

use super::drawing::{click, new_layout};
use super::services::lanes;
use super::test_window::{TestWindow, drawn_texts};
use crate::canvas::HOVER_COLOR;

const NONE: Modifiers = Modifiers::NONE;

/// Returns `true` if a position lies on an upright and a level line of the grid that is drawn.
fn is_on_drawn_grid(window: &mut TestWindow, at_m: Point<f64>) -> bool {
    let app = window.app();
    let view = app.canvas.camera.view().unwrap();
    let at_px = view.pixel_from_world(at_m);
    let grid = app.settings.grid(&view, app.canvas.px_per_point());
    let lines: Vec<_> = (grid.fills.iter().flat_map(|fill| &fill.polygons))
        .map(|corners| guideway_spline::Bounds::of_points(corners.iter().copied()).unwrap())
        .filter(|line| line.contains(at_px))
        .collect();
    let is_upright = |line: &guideway_spline::Bounds<f64>| line.size().x < line.size().y;
    lines.iter().any(is_upright) && !lines.iter().all(is_upright)
}

/// Creates a node by a click. Returns its position.
fn created(window: &mut TestWindow, x: f64, y: f64) -> Point<f64> {
    click(window, x, y);
    let document = window.document();
    let node = document.selected().nodes.min().unwrap();
    document.node_position_m(node)
}

#[test]
fn points_snap_to_the_grid_that_is_shown() {
    let mut window = new_layout();
    window.app().tools.snaps.to_grid = true;
    window.key(NONE, Key::W);
    // Lines 0.25 m apart would be too close at this scale.
    for (step_m, x, y) in [
        (Some(0.25), 3.3, 4.1),
        (Some(1.5), -8.3, 4.2),
        (None, 9.1, -6.2),
    ] {
        window.app().settings.grid_step_m = step_m;
        let at_m = created(&mut window, x, y);
        assert!(is_on_drawn_grid(&mut window, at_m), "{step_m:?} {at_m:?}");
        assert!(!is_on_drawn_grid(&mut window, Point::new(x, y)));
    }
    // Nothing snaps to a grid that is hidden.
    window.app().settings.has_grid = false;
    let at_m = created(&mut window, -3.3, -7.7);
    let by_m = at_m.distance(Point::new(-3.3, -7.7));
    assert!(by_m < 0.05, "a click is a whole pixel: {at_m:?}");
    window.harness.run_steps(3);
    let grid = window
        .harness
        .get_by_role_and_label(Role::CheckBox, "grid of");
    assert!(grid.accesskit_node().is_disabled());
}

/// The shapes in the color of what is under the pointer, of which one is at a place.
fn markers(window: &TestWindow, is: impl Fn(&Shape) -> bool) -> usize {
    let shapes = window.harness.output().shapes.iter();
    shapes.filter(|shape| is(&shape.shape)).count()
}

fn is_circle(shape: &Shape, at: Pos2) -> bool {
    match shape {
        Shape::Circle(circle) => {
            circle.center.distance(at) < 1.0 && circle.stroke.color == HOVER_COLOR
        }
        _ => false,
    }
}

fn is_triangle(shape: &Shape, at: Pos2) -> bool {
    match shape {
        Shape::Path(path) => path.closed && path.points.len() == 3 && path.points[0].x == at.x,
        _ => false,
    }
}

#[test]
fn marker_and_name_tell_what_the_pointer_snaps_to() {
    let mut window = TestWindow::showing(lanes(2));
    window.app().settings.grid_step_m = Some(1.0);
    window.key(NONE, Key::W);
    let names = ["node", "middle", "grid"];
    let told = |window: &TestWindow| {
        let texts = drawn_texts(window);
        names.map(|name| texts.iter().any(|text| text == name))
    };
    window.hover(3.2, 0.9);
    assert_eq!(told(&window), [false; 3]);
    let node = window.at(10.0, 2.0);
    window.hover(10.05, 2.05);
    assert_eq!(told(&window), [true, false, false]);
    assert_eq!(markers(&window, |shape| is_circle(shape, node)), 1);
    let middle = window.at(5.0, 2.0);
    window.hover(5.05, 2.05);
    assert_eq!(told(&window), [false, true, false]);
    assert_eq!(markers(&window, |shape| is_triangle(shape, middle)), 1);
    window.app().tools.snaps.to_grid = true;
    window.hover(3.2, 0.9);
    assert_eq!(told(&window), [false, false, true]);
}

#[test]
fn status_bar_tells_the_place_that_the_pointer_snaps_to() {
    let mut window = TestWindow::showing(lanes(2));
    window.key(NONE, Key::W);
    window.hover(5.05, 2.05);
    let place = |x: f64, y: f64| format!("x {x:>9.3} y {y:>9.3} m");
    let middle = place(5.0, 2.0);
    assert!(window.harness.query_by_label(&middle).is_some());
    // The tool that selects snaps to nothing.
    window.key(NONE, Key::V);
    window.hover(5.05, 2.05);
    assert!(window.harness.query_by_label(&middle).is_none());
    assert!(
        window
            .harness
            .query_by_label_contains("x     5.0")
            .is_some()
    );
}

#[test]
fn step_of_the_grid_is_told_chosen_and_typed_in_the_bar() {
    let mut window = new_layout();
    window.harness.run_steps(3);
    let combo = |window: &TestWindow, text: &str| {
        let combo = By::new().role(Role::ComboBox).value(text);
        window.harness.get(combo).rect().center()
    };
    // 20 pixels per meter: the lines are at least 96 points apart.
    let at = combo(&window, "automatic (5 m)");
    window.click(at);
    window.harness.get_by_label("0.5 m").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().settings.grid_step_m, Some(0.5));
    assert!(window.harness.query_by_label("0.25 m").is_none(), "closed");
    let at = combo(&window, "0.5 m");
    window.click(at);
    // Other fields are in the side panel.
    let right = window.app().canvas.screen().rect.right();
    let fields = window.harness.get_all_by_role(Role::SpinButton);
    let fields: Vec<Pos2> = fields.map(|field| field.rect().center()).collect();
    let field = fields.iter().find(|at| at.x < right);
    window.click(*field.expect("the field is shown"));
    window.answer("0.75");
    assert_eq!(window.app().settings.grid_step_m, Some(0.75));
    window.key(NONE, Key::Escape);
    window.app().settings.grid_step_m = Some(0.05);
    window.harness.run_steps(3);
    combo(&window, "0.05 m (0.5 m shown)");
}
