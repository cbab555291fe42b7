//! Everyday work: view, select, search, draw, edit, change settings.

use std::sync::Arc;
use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable;
use guideway_cpu::Cpu;
use guideway_scene::{Budget, Cancel, Frame, Method};
use guideway_spline::Point;

use super::lane_network::network;
use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::panels::SideTab;
use crate::render_queue::{Pixels, RenderEvent, RenderRequest, Renderer, WindowDevice};
use crate::tools::Tool;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

#[test]
fn opened_file_fills_the_view_and_is_fully_reported() {
    let mut window = TestWindow::showing(lanes(5));
    let view = window.app().canvas.camera.view().unwrap();
    let bounds = window.document().scene().bounds().unwrap();
    assert!(view.world_bounds().contains(bounds.min) && view.world_bounds().contains(bounds.max));
    let report = &window.app().files.layers()[0]
        .picture
        .shown()
        .unwrap()
        .report;
    assert_eq!((report.total, report.drawn), (5, 5));
    window.wait(|app| app.files.layers()[0].tasks.findings().is_some());
}

#[test]
fn picture_over_the_background_equals_the_render_command() {
    let layout = Arc::new(lanes(7));
    let widths = guideway_compose::usual_widths(&layout);
    let settings = crate::display_settings::DisplaySettings {
        color_by: Some("speed".into()),
        ..crate::display_settings::DisplaySettings::default()
    };
    let options = settings.scene_options();
    let scene = guideway_scene::Scene::new(layout, &options).unwrap();
    let size = guideway_scene::FrameSize::new(300, 200).unwrap();
    let request = RenderRequest {
        view: guideway_scene::View::fit(size, scene.bounds()).unwrap(),
        style: settings.style(settings.line_rule(widths, 1.0)),
    };
    let scene = Arc::new(scene);
    let services = TestServices::with([]);
    let renderer = Renderer::start(services, "cpu", Arc::new(|| {}), WindowDevice::default());
    renderer.set_scene(Arc::clone(&scene));
    renderer.request(request);
    let picture = (0..5_000).find_map(|_| {
        std::thread::sleep(Duration::from_millis(2));
        match renderer.try_event() {
            Ok(RenderEvent::Picture(picture)) => Some(picture),
            _ => None,
        }
    });
    let picture = picture.expect("a picture arrives");
    let Pixels::InMemory(image) = picture.pixels else {
        panic!("no window shares its device");
    };
    // Composited over white it equals what `guideway render` draws on white.
    let mut frame = Frame::new(size);
    let mut prepared = Cpu.prepare(scene, &Budget::default()).unwrap();
    let style = guideway_scene::Style {
        background: guideway_scene::Rgba::WHITE,
        ..request.style
    };
    prepared
        .render(&request.view, &style, &Cancel::default(), &mut frame)
        .unwrap();
    for (over, on_white) in image.pixels.iter().zip(frame.pixels()) {
        let [r, g, b, a] = over.to_array();
        for (over, on_white) in [r, g, b].into_iter().zip(on_white) {
            let seen = i32::from(over) + 255 - i32::from(a);
            assert!(
                (seen - i32::from(*on_white)).abs() <= 2,
                "{over:?} {on_white:?}"
            );
        }
    }
    let is_drawn = image.pixels.iter().any(|pixel| pixel.a() > 128);
    assert!(is_drawn);
}

#[test]
fn clicks_and_boxes_select_paths() {
    let mut window = TestWindow::showing(lanes(5));
    let at = window.at(5.0, 4.0);
    window.click(at);
    assert_eq!(window.selected(), [2]);
    let at = window.at(5.0, 6.0);
    window.click_with(at, Modifiers::SHIFT);
    assert_eq!(window.selected(), [2, 3]);
    window.click_with(at, Modifiers::ALT);
    assert_eq!(window.selected(), [2]);
    let at = window.at(5.0, 5.0);
    window.click(at);
    assert!(window.selected().is_empty(), "no path is there");
    // From left to right only paths inside, from right to left all that it crosses.
    let (left, right) = (window.at(-0.5, 3.0), window.at(9.0, 7.0));
    window.drag(left, right);
    assert!(window.selected().is_empty());
    window.drag(right, left);
    assert_eq!(window.selected(), [2, 3]);
    window.key(CTRL, Key::A);
    assert_eq!(window.selected().len(), 5);
    window.key(NONE, Key::Escape);
    assert!(window.selected().is_empty());
}

#[test]
fn all_is_selected_and_deleted_with_nodes_and_stations() {
    let mut window = TestWindow::showing(network(6));
    window.key(CTRL, Key::A);
    let selected = window.document().selected();
    let counts = [&selected.paths, &selected.nodes, &selected.stations].map(|rows| rows.len());
    assert_eq!(counts, [10, 12, 2]);
    window.key(NONE, Key::Delete);
    let left = window.document().to_layout();
    let left = [left.paths.len(), left.nodes.len(), left.stations.len()];
    assert_eq!(left, [0, 0, 0]);
    window.key(CTRL, Key::Z);
    assert_eq!(window.document().to_layout().stations.len(), 2);
}

#[test]
fn draws_a_path_by_clicks() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::C);
    for (x, y) in [(10.0, 0.0), (13.0, 2.0), (10.0, 4.0)] {
        let at = window.at(x, y);
        window.click(at);
    }
    window.key(NONE, Key::Enter);
    assert_eq!(window.selected(), [3]);
    let path = window.document().layout().paths.get(3);
    assert_eq!(
        (path.start_node(), path.end_node()),
        (Some(1), Some(5)),
        "it ends at the nodes"
    );
}

#[test]
fn wheel_keys_and_drags_move_the_view() {
    let mut window = TestWindow::showing(lanes(5));
    let scale = |window: &mut TestWindow| window.app().canvas.camera.view().unwrap().px_per_m();
    let fitted = scale(&mut window);
    let at = window.at(2.0, 2.0);
    window.wheel(at, 3.0);
    assert!(scale(&mut window) > 1.5 * fitted);
    let now = window.at(2.0, 2.0);
    assert!(
        now.distance(at) < 0.1,
        "the position under the pointer stays"
    );
    window.key(NONE, Key::F);
    assert!((scale(&mut window) / fitted - 1.0).abs() < 0.02);
    window.key(Modifiers::ALT, Key::ArrowLeft);
    assert!(scale(&mut window) > 1.5 * fitted, "back to where it was");
    window.key(NONE, Key::Minus);
    window.key(NONE, Key::ArrowRight);
    let (from, to) = (
        window.at(5.0, 5.0),
        window.at(5.0, 5.0) + Vec2::new(40.0, 30.0),
    );
    window.key(NONE, Key::M);
    window.drag(from, to);
    let moved = window.at(5.0, 5.0);
    assert!(moved.distance(to) < 2.0, "{moved:?} {to:?}");
}

#[test]
fn query_selects_and_shows_its_error() {
    let mut window = TestWindow::showing(lanes(6));
    window.app().side.open(SideTab::Find);
    window.harness.run_steps(2);
    window.harness.get_by_label("Query").click();
    window.harness.run_steps(2);
    window.harness.get_by_label("Query").type_text("speed >= 2");
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.wait(|app| {
        app.document()
            .is_some_and(|document| document.selection().len() == 2)
    });
    assert_eq!(window.selected(), [4, 5]);
    window.app().find.query = "spede > 2".into();
    window.harness.run_steps(2);
    window.harness.get_by_label("Select matches").click();
    window.harness.run_steps(3);
    assert!(
        window
            .app()
            .find
            .query_error
            .as_ref()
            .unwrap()
            .contains("speed")
    );
    assert_eq!(window.selected(), [4, 5], "as before");
}

#[test]
fn search_zooms_to_the_found_path() {
    let mut window = TestWindow::showing(lanes(50));
    window.key(CTRL, Key::F);
    window.harness.event(Event::Text("LANE 37".into()));
    window.harness.run_steps(2);
    window.key(NONE, Key::Enter);
    window.wait(|app| {
        app.document()
            .is_some_and(|document| !document.selection().is_empty())
    });
    assert_eq!(window.selected(), [37]);
    let seen = window.app().canvas.camera.view().unwrap().world_bounds();
    window.key(CTRL, Key::F);
    window.key(NONE, Key::Escape);
    window.key(NONE, Key::P);
    assert_eq!(
        window.app().tools.tool(),
        Tool::Points,
        "Escape leaves the field"
    );
    assert!(seen.contains(Point::new(5.0, 74.0)) && !seen.contains(Point::new(5.0, 0.0)));
}

#[test]
fn recoloring_survives_an_edit() {
    let mut window = TestWindow::showing(lanes(6));
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.document().select_all();
    window
        .document()
        .copy_selection(1, Point::new(0.0, 50.0))
        .unwrap();
    window.wait(|app| {
        app.document()
            .is_some_and(|document| document.scene().legend().is_some())
    });
    let scene = window.document().scene();
    assert_eq!(
        scene.color(3),
        scene.color(9),
        "a copy has the color of its path"
    );
    window.app().settings.color_by = Some("no such column".into());
    window.app().recolor();
    window.wait(|app| has_notice(app, "no such column"));
    assert!(window.document().scene().legend().is_some(), "as it was");
}

#[test]
fn clicks_alternate_between_the_paths_of_a_reverse_pair() {
    let mut layout = lanes(3);
    let mut runs = guideway_spline::Runs::default();
    runs.push_line(Point::new(10.0, 2.0), Point::new(0.0, 2.0));
    layout.paths.push(&guideway_layout::NewPath {
        id: "back",
        runs: &runs,
        ..guideway_layout::NewPath::default()
    });
    let mut window = TestWindow::showing(layout);
    let at = window.at(5.0, 2.0);
    for expected in [3, 1, 3] {
        window.click(at);
        assert_eq!(window.selected(), [expected]);
        assert!(
            window
                .harness
                .query_by_label_contains("the reverse path lane 1")
                .is_some()
        );
    }
    let other = window.at(5.0, 4.0);
    for _ in 0..2 {
        window.click(other);
        assert_eq!(window.selected(), [2], "the lane has no reverse path");
    }
}

/// The path under the pointer.
fn hovered_path(app: &crate::app::App) -> Option<u32> {
    app.tools.hovered(app.document()).map(|hit| hit.path)
}

#[test]
fn hovered_path_is_forgotten_with_its_document() {
    let disk = TestServices::with([("few.arrow", lanes(2)), ("many.arrow", lanes(9))]);
    let mut window = TestWindow::open(&disk, &["few.arrow", "many.arrow"], Some("cpu"));
    window.wait(|app| {
        app.files
            .layers()
            .iter()
            .all(|layer| layer.document().is_some())
    });
    window.key(NONE, Key::F);
    let at = window.at(5.0, 16.0);
    let point = |window: &mut TestWindow| {
        window.harness.event(Event::PointerMoved(at));
        window.wait(|app| hovered_path(app) == Some(8));
    };
    point(&mut window);
    window.key(NONE, Key::PageDown);
    assert!(
        hovered_path(window.app()).is_none(),
        "another file is active"
    );
    window.key(NONE, Key::PageDown);
    point(&mut window);
    let shorter = [("many.arrow".into(), lanes(3))];
    disk.files.lock().unwrap().extend(shorter);
    window.app().reload(1, true);
    window.wait(|app| app.document().is_some_and(|d| d.scene().row_count() == 3));
    assert!(hovered_path(window.app()).is_none());
}

#[test]
fn hiding_and_display_settings_update_the_picture() {
    let mut window = TestWindow::showing(lanes(6));
    let at = window.at(5.0, 2.0);
    window.click(at);
    window.key(NONE, Key::H);
    let drawn = |app: &crate::app::App, count| {
        app.files.layers()[0]
            .picture
            .shown()
            .is_some_and(|shown| shown.report.drawn == count)
    };
    window.wait(|app| drawn(app, 5));
    window.key(NONE, Key::U);
    window.wait(|app| drawn(app, 6));
    for key in [Key::B, Key::Y, Key::T, Key::G, Key::A, Key::L, Key::N] {
        window.key(NONE, key);
    }
    assert!(window.app().settings.is_dark && window.app().settings.is_density);
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.wait(|app| {
        app.document()
            .is_some_and(|document| document.scene().legend().is_some())
    });
    window.wait(|app| drawn(app, 6));
}

#[test]
fn shortcuts_window_opens_and_closes() {
    let mut window = TestWindow::showing(lanes(1));
    window.key(NONE, Key::F1);
    assert!(
        window
            .harness
            .query_by_label_contains("Wheel: zoom")
            .is_some()
    );
    window.key(NONE, Key::Escape);
    window.harness.run_steps(8);
    assert!(
        window
            .harness
            .query_by_label_contains("Wheel: zoom")
            .is_none()
    );
    assert_ne!(window.at(0.0, 0.0), Pos2::ZERO);
}

#[test]
fn status_bar_reports_omitted_marks() {
    let mut window = TestWindow::showing(lanes(400));
    let hint = "Zoom in to show all marks";
    window.wait(|app| app.files.layers()[0].is_settled());
    window.harness.step();
    assert!(window.harness.query_by_label(hint).is_some());
    for _ in 0..12 {
        window.key(NONE, Key::Plus);
    }
    window.wait(|app| app.files.layers()[0].is_settled());
    window.harness.step();
    assert!(window.harness.query_by_label(hint).is_none());
}
