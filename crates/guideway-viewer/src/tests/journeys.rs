use std::sync::Arc;
use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use guideway_cpu::Cpu;
use guideway_scene::{Budget, Cancel, Frame, Method};
use guideway_spline::Point;

use super::desk::Desk;
use super::table::{Table, lanes};
use crate::app::Tool;
use crate::work::renderer::{Outcome, Renderer, Shot};

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn a_file_is_shown_whole_and_accounted_for() {
    let mut desk = Desk::looking_at(lanes(5));
    let view = desk.app().camera.view().unwrap();
    let bounds = desk.document().scene().bounds().unwrap();
    assert!(view.world_bounds().contains(bounds.min) && view.world_bounds().contains(bounds.max));
    let report = &desk.app().layers[0].shown.as_ref().unwrap().report;
    assert_eq!((report.total, report.drawn), (5, 5));
    desk.wait(|app| app.layers[0].findings.is_some());
}

#[test]
fn the_picture_is_the_one_that_the_method_draws() {
    let layout = Arc::new(lanes(7));
    let look = crate::app::Look {
        color_by: Some("speed".into()),
        ..crate::app::Look::default()
    };
    let options = look.scene_options();
    let scene = guideway_scene::Scene::new(layout, &options).unwrap();
    let size = guideway_scene::FrameSize::new(300, 200).unwrap();
    let shot = Shot {
        view: guideway_scene::View::fit(size, scene.bounds()).unwrap(),
        style: look.style(),
    };
    let scene = Arc::new(scene);
    let services = Table::with([]);
    let renderer = Renderer::start(services, "cpu", Arc::new(|| {}));
    renderer.set_scene(Arc::clone(&scene));
    renderer.ask(shot);
    let picture = (0..5_000).find_map(|_| {
        std::thread::sleep(Duration::from_millis(2));
        match renderer.outcome() {
            Ok(Outcome::Picture(picture)) => Some(picture),
            _ => None,
        }
    });
    let picture = picture.expect("a picture comes");
    // Over the paper of the window it is what `guideway render` draws on white.
    let mut frame = Frame::new(size);
    let mut prepared = Cpu.prepare(scene, &Budget::default()).unwrap();
    let style = guideway_scene::Style {
        background: guideway_scene::Rgba::WHITE,
        ..shot.style
    };
    prepared
        .render(&shot.view, &style, &Cancel::default(), &mut frame)
        .unwrap();
    for (over, on_white) in picture.image.pixels.iter().zip(frame.pixels()) {
        let [r, g, b, a] = over.to_array();
        for (over, on_white) in [r, g, b].into_iter().zip(on_white) {
            let seen = i32::from(over) + 255 - i32::from(a);
            assert!(
                (seen - i32::from(*on_white)).abs() <= 2,
                "{over:?} {on_white:?}"
            );
        }
    }
    let is_drawn = picture.image.pixels.iter().any(|pixel| pixel.a() > 128);
    assert!(is_drawn);
}

#[test]
fn clicks_and_boxes_select() {
    let mut desk = Desk::looking_at(lanes(5));
    let at = desk.at(5.0, 4.0);
    desk.click(at);
    assert_eq!(desk.selected(), [2]);
    let at = desk.at(5.0, 6.0);
    desk.click_with(at, Modifiers::SHIFT);
    assert_eq!(desk.selected(), [2, 3]);
    desk.click_with(at, Modifiers::ALT);
    assert_eq!(desk.selected(), [2]);
    let at = desk.at(5.0, 5.0);
    desk.click(at);
    assert!(desk.selected().is_empty(), "there is nothing");
    // From the left only what is inside, from the right all that it meets.
    let (left, right) = (desk.at(-0.5, 3.0), desk.at(9.0, 7.0));
    desk.drag(left, right);
    assert!(desk.selected().is_empty());
    desk.drag(right, left);
    assert_eq!(desk.selected(), [2, 3]);
    desk.key(CTRL, Key::A);
    assert_eq!(desk.selected().len(), 5);
    desk.key(NONE, Key::Escape);
    assert!(desk.selected().is_empty());
}

#[test]
fn a_path_is_drawn_click_by_click() {
    let mut desk = Desk::looking_at(lanes(3));
    desk.key(NONE, Key::D);
    for (x, y) in [(10.0, 0.0), (13.0, 2.0), (10.0, 4.0)] {
        let at = desk.at(x, y);
        desk.click(at);
    }
    desk.key(NONE, Key::Enter);
    assert_eq!(desk.selected(), [3]);
    let path = desk.document().layout().paths.get(3);
    assert_eq!(
        (path.start_node(), path.end_node()),
        (Some(1), Some(5)),
        "at the nodes there"
    );
}

#[test]
fn the_view_moves_by_wheel_keys_and_hand() {
    let mut desk = Desk::looking_at(lanes(5));
    let scale = |desk: &mut Desk| desk.app().camera.view().unwrap().px_per_m();
    let fitted = scale(&mut desk);
    let at = desk.at(2.0, 2.0);
    desk.wheel(at, 3.0);
    assert!(scale(&mut desk) > 1.5 * fitted);
    let now = desk.at(2.0, 2.0);
    assert!(now.distance(at) < 0.1, "the place under the pointer stays");
    desk.key(NONE, Key::F);
    assert!((scale(&mut desk) / fitted - 1.0).abs() < 0.02);
    desk.key(Modifiers::ALT, Key::ArrowLeft);
    assert!(scale(&mut desk) > 1.5 * fitted, "back to where it was");
    desk.key(NONE, Key::Minus);
    desk.key(NONE, Key::ArrowRight);
    let (from, to) = (desk.at(5.0, 5.0), desk.at(5.0, 5.0) + Vec2::new(40.0, 30.0));
    desk.key(NONE, Key::M);
    desk.drag(from, to);
    let moved = desk.at(5.0, 5.0);
    assert!(moved.distance(to) < 2.0, "{moved:?} {to:?}");
}

#[test]
fn a_query_selects_and_a_wrong_one_says_why() {
    let mut desk = Desk::looking_at(lanes(6));
    desk.harness.get_by_label("Query").click();
    desk.harness.run_steps(2);
    desk.harness.get_by_label("Query").type_text("speed >= 2");
    desk.harness.run_steps(2);
    desk.key(NONE, Key::Enter);
    desk.wait(|app| {
        app.document()
            .is_some_and(|document| document.selection().len() == 2)
    });
    assert_eq!(desk.selected(), [4, 5]);
    desk.app().find.query = "spede > 2".into();
    desk.harness.run_steps(2);
    desk.harness.get_by_label("Select these").click();
    desk.harness.run_steps(3);
    assert!(
        desk.app()
            .find
            .query_trouble
            .as_ref()
            .unwrap()
            .contains("speed")
    );
    assert_eq!(desk.selected(), [4, 5], "as before");
}

#[test]
fn a_name_is_looked_for_and_flown_to() {
    let mut desk = Desk::looking_at(lanes(50));
    desk.key(CTRL, Key::F);
    desk.harness.event(Event::Text("LANE 37".into()));
    desk.harness.run_steps(2);
    desk.key(NONE, Key::Enter);
    desk.wait(|app| {
        app.document()
            .is_some_and(|document| !document.selection().is_empty())
    });
    assert_eq!(desk.selected(), [37]);
    let seen = desk.app().camera.view().unwrap().world_bounds();
    desk.key(CTRL, Key::F);
    desk.key(NONE, Key::Escape);
    desk.key(NONE, Key::P);
    assert_eq!(desk.app().tool, Tool::Points, "Escape leaves the field");
    assert!(seen.contains(Point::new(5.0, 74.0)) && !seen.contains(Point::new(5.0, 0.0)));
}

#[test]
fn colors_asked_for_while_the_layout_is_edited_come_all_the_same() {
    let mut desk = Desk::looking_at(lanes(6));
    desk.app().look.color_by = Some("speed".into());
    desk.app().recolor();
    desk.document().select_all();
    desk.document()
        .copy_selection(1, Point::new(0.0, 50.0))
        .unwrap();
    desk.wait(|app| {
        app.document()
            .is_some_and(|document| document.scene().legend().is_some())
    });
    let scene = desk.document().scene();
    assert_eq!(
        scene.color(3),
        scene.color(9),
        "a copy has the color of its path"
    );
    desk.app().look.color_by = Some("no such column".into());
    desk.app().recolor();
    desk.wait(|app| {
        app.notices
            .iter()
            .any(|notice| notice.contains("no such column"))
    });
    assert!(desk.document().scene().legend().is_some(), "as it was");
}

#[test]
fn both_paths_of_a_pair_are_reached_by_clicks() {
    let mut layout = lanes(3);
    let mut runs = guideway_spline::Runs::default();
    runs.push_line(Point::new(10.0, 2.0), Point::new(0.0, 2.0));
    layout.paths.push(&guideway_layout::NewPath {
        id: "back",
        runs: &runs,
        ..guideway_layout::NewPath::default()
    });
    let mut desk = Desk::looking_at(layout);
    let at = desk.at(5.0, 2.0);
    for expected in [3, 1, 3] {
        desk.click(at);
        assert_eq!(desk.selected(), [expected]);
        assert!(
            desk.harness
                .query_by_label_contains("and back by lane 1")
                .is_some()
        );
    }
    let other = desk.at(5.0, 4.0);
    for _ in 0..2 {
        desk.click(other);
        assert_eq!(desk.selected(), [2], "it is no pair");
    }
}

/// What drew the picture of the first file.
fn drawn_by(app: &crate::App) -> Option<&'static str> {
    Some(app.layers[0].shown.as_ref()?.report.method)
}

#[test]
fn the_best_way_of_drawing_is_found_and_another_is_a_click_away() {
    let table = Table::with([("site.arrow", lanes(3))]);
    let mut desk = Desk::with(&table, &["site.arrow"], None);
    desk.wait(|app| drawn_by(app) == Some("device"));
    assert_eq!(desk.app().drawing.method(), "device");
    desk.harness.get_by_label("Drawing").click();
    desk.harness.run_steps(8);
    desk.harness.get_by_label("Way of drawing").click();
    desk.harness.run_steps(8);
    desk.harness.get_by_label("cpu").click();
    desk.wait(|app| drawn_by(app) == Some("cpu"));
}

#[test]
fn a_device_that_is_lost_is_replaced_by_the_processor_for_all_files() {
    let table = Table::with([("a.arrow", lanes(3)), ("b.arrow", lanes(4))]);
    let mut desk = Desk::with(&table, &["a.arrow", "b.arrow"], None);
    desk.wait(|app| drawn_by(app) == Some("device") && app.layers[1].shown.is_some());
    desk.wait(|app| app.document().is_some());
    desk.key(CTRL, Key::A);
    desk.key(NONE, Key::R);
    table.lose_device();
    desk.key(NONE, Key::Plus);
    desk.wait(|app| drawn_by(app) == Some("cpu"));
    let app = desk.app();
    assert_eq!(app.drawing.method(), "cpu");
    let said = app
        .notices
        .iter()
        .filter(|n| n.contains("device was lost") && n.contains("cpu"));
    assert_eq!(said.count(), 1, "{:?}", app.notices);
    assert!(app.layers[1].is_changed(), "what was done is still there");
}

#[test]
fn what_lies_under_the_pointer_may_be_gone() {
    let table = Table::with([("few.arrow", lanes(2)), ("many.arrow", lanes(9))]);
    let mut desk = Desk::with(&table, &["few.arrow", "many.arrow"], Some("cpu"));
    desk.wait(|app| app.layers.iter().all(|layer| layer.document.is_some()));
    desk.key(NONE, Key::F);
    let at = desk.at(5.0, 16.0);
    let point = |desk: &mut Desk| {
        desk.harness.event(Event::PointerMoved(at));
        desk.wait(|app| app.hovered().is_some_and(|hit| hit.path == 8));
    };
    point(&mut desk);
    desk.key(NONE, Key::PageDown);
    assert!(desk.app().hovered().is_none(), "another file is edited now");
    desk.key(NONE, Key::PageDown);
    point(&mut desk);
    let shorter = [("many.arrow".into(), lanes(3))];
    table.files.lock().unwrap().extend(shorter);
    desk.app().reload(1, true);
    desk.wait(|app| app.document().is_some_and(|d| d.scene().row_count() == 3));
    assert!(desk.app().hovered().is_none());
}

#[test]
fn what_is_hidden_and_how_it_looks_is_redrawn() {
    let mut desk = Desk::looking_at(lanes(6));
    let at = desk.at(5.0, 2.0);
    desk.click(at);
    desk.key(NONE, Key::H);
    let drawn = |app: &crate::App, count| {
        app.layers[0]
            .shown
            .as_ref()
            .is_some_and(|shown| shown.report.drawn == count)
    };
    desk.wait(|app| drawn(app, 5));
    desk.key(NONE, Key::U);
    desk.wait(|app| drawn(app, 6));
    for key in [Key::B, Key::Y, Key::T, Key::G, Key::A, Key::L, Key::N] {
        desk.key(NONE, key);
    }
    assert!(desk.app().look.is_dark && desk.app().look.is_density);
    desk.app().look.color_by = Some("speed".into());
    desk.app().recolor();
    desk.wait(|app| {
        app.document()
            .is_some_and(|document| document.scene().legend().is_some())
    });
    desk.wait(|app| drawn(app, 6));
}

#[test]
fn the_keys_are_shown_and_put_away() {
    let mut desk = Desk::looking_at(lanes(1));
    desk.key(NONE, Key::F1);
    assert!(
        desk.harness
            .query_by_label_contains("Wheel: zoom")
            .is_some()
    );
    desk.key(NONE, Key::Escape);
    desk.harness.run_steps(8);
    assert!(
        desk.harness
            .query_by_label_contains("Wheel: zoom")
            .is_none()
    );
    assert_ne!(desk.at(0.0, 0.0), Pos2::ZERO);
}

#[test]
fn marks_that_are_left_out_are_told_of() {
    let mut desk = Desk::looking_at(lanes(400));
    let hint = "zoom in for all marks";
    desk.wait(|app| app.layers[0].is_settled());
    desk.harness.step();
    assert!(desk.harness.query_by_label(hint).is_some());
    for _ in 0..12 {
        desk.key(NONE, Key::Plus);
    }
    desk.wait(|app| app.layers[0].is_settled());
    desk.harness.step();
    assert!(desk.harness.query_by_label(hint).is_none());
}
