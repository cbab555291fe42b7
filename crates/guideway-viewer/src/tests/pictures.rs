//! The order of painting, and exported pictures against the screen.

use std::thread;
use std::time::Duration;

use eframe::egui::{Color32, CursorIcon, Event, Key, Modifiers, Pos2, Shape};
use egui_kittest::kittest::Queryable;
use guideway_scene::LineRule;

use super::appearance::small_drawing;
use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::app::App;
use crate::canvas::{HOVER_COLOR, SELECTION_COLOR, shown_legends};
use crate::editing::MarkedSeverities;
use crate::services::PictureRequest;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Places in the order of painting of the shapes that fit.
fn painted(window: &TestWindow, is: impl Fn(&Shape) -> bool) -> Vec<usize> {
    let shapes = window.harness.output().shapes.iter().enumerate();
    let shapes = shapes.filter(|(_, shape)| is(&shape.shape));
    shapes.map(|(place, _)| place).collect()
}

/// Returns `true` for opaque lines of this color.
fn is_line(shape: &Shape, color: Color32) -> bool {
    match shape {
        Shape::LineSegment { stroke, .. } => stroke.color == color,
        _ => false,
    }
}

/// Places of the arrow near a point, and of the names that begin so.
fn marks(window: &TestWindow, near: Pos2, name: &str) -> Vec<usize> {
    painted(window, |shape| match shape {
        Shape::Mesh(mesh) => {
            let mut corners = mesh.vertices.iter();
            corners.any(|corner| corner.pos.distance(near) < 6.0)
        }
        Shape::Text(text) => text.galley.text().starts_with(name),
        _ => false,
    })
}

#[test]
fn hover_and_selection_are_above_lines_arrows_symbols_and_names_of_all_files() {
    let mut other = lanes(4);
    other.retain_paths(&[3]);
    let disk = TestServices::with([("a.arrow", other), ("b.arrow", lanes(3))]);
    let mut window = TestWindow::open(&disk, &["a.arrow", "b.arrow"], Some("cpu"));
    window.wait(|app| app.is_settled());
    window.key(NONE, Key::F);
    window.wait(|app| app.is_settled());
    let [selected, hovered, elsewhere] = [0.0, 4.0, 6.0].map(|y| window.at(3.0, y));
    window.click(selected);
    for (pointer, color) in [(hovered, HOVER_COLOR), (elsewhere, HOVER_COLOR)] {
        window.harness.event(Event::PointerMoved(pointer));
        window.harness.run_steps(3);
        let middle = window.at(5.0, 4.0);
        let marks = marks(&window, middle, "lane");
        assert!(marks.len() >= 4, "an arrow and three names: {marks:?}");
        let last = marks.last().copied();
        for color in [SELECTION_COLOR, color] {
            let lines = painted(&window, |shape| is_line(shape, color));
            assert!(!lines.is_empty());
            assert!(lines.first().copied() > last, "{lines:?} {marks:?}");
        }
    }
}

#[test]
fn pointer_means_the_node_or_station_that_a_click_would_select() {
    let mut layout = lanes(3);
    layout.stations.push("dock", None, vec![3], None);
    let mut window = TestWindow::showing(layout);
    // A pin over a node would tell its finding.
    window.app().findings.marked = MarkedSeverities([false; 3]);
    window.wait(|app| app.is_settled());
    let rings = |window: &TestWindow, color: Color32| {
        let is_ring = |shape: &Shape| match shape {
            Shape::Circle(circle) => circle.stroke.color == color,
            _ => false,
        };
        painted(window, is_ring).len()
    };
    for ((x, y), said) in [((0.0, 2.0), "node n1 0"), ((10.0, 2.0), "station dock")] {
        let at = window.at(x, y);
        window.harness.event(Event::PointerMoved(at));
        window.harness.run_steps(3);
        assert!(window.harness.query_by_label(said).is_some(), "{said}");
        assert_eq!(rings(&window, HOVER_COLOR), 1);
        let lines = painted(&window, |shape| is_line(shape, HOVER_COLOR));
        assert!(lines.is_empty(), "the path is below: {lines:?}");
        assert_eq!(window.cursor(), CursorIcon::PointingHand);
        window.click(at);
        assert_eq!(window.cursor(), CursorIcon::Move);
        let selected = window.document().selected();
        assert_eq!(selected.nodes.len() + selected.stations.len(), 1);
        assert!(selected.paths.is_empty());
    }
    // A tool that draws shows its target instead.
    window.key(NONE, Key::D);
    let at = window.at(0.0, 4.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.run_steps(3);
    let app = window.app();
    assert_eq!(app.tools.hovered_symbol(app.files.document()), None);
}

/// Exports the picture on the screen with this width in pixels.
fn exported(window: &mut TestWindow, width_px: u32) -> PictureRequest {
    window.key(CTRL, Key::E);
    let prompt = window.app().dialogs.prompt.open_mut().unwrap();
    (prompt.text, prompt.width_px) = (format!("{width_px}.png"), width_px);
    window.key(NONE, Key::Enter);
    take_picture(window)
}

fn take_picture(window: &mut TestWindow) -> PictureRequest {
    window.wait(|app| !app.writer.is_busy() && !app.dialogs.prompt.is_open());
    let picture = window.disk.pictures.lock().unwrap().pop();
    picture.expect("it was written").1
}

/// Radius of a line, height of a text and size of an arrow, in pixels per pixel of the view.
fn sizes(picture: &PictureRequest, canvas_px: f64) -> [f64; 3] {
    let factor = f64::from(picture.view.size().width()) / canvas_px;
    let radius = picture
        .style
        .line_rule
        .radius_px(None, picture.view.px_per_m());
    let text = picture
        .marks
        .texts
        .iter()
        .find(|text| text.text == "lane 1");
    let of_arrow = picture.marks.fills[0].polygons[0].array_windows();
    let arrow: f64 = of_arrow.map(|[a, b]| a.distance(*b)).sum();
    [radius, text.unwrap().height_px(), arrow].map(|size_px| size_px / factor)
}

#[test]
fn pictures_show_lines_arrows_and_names_as_large_as_the_screen_does() {
    let mut on_small_screen = [0.0; 3];
    for px_per_point in [1.0, 2.0] {
        let mut window = TestWindow::showing(lanes(3));
        window.harness.set_pixels_per_point(px_per_point);
        window.key(NONE, Key::F);
        window.wait(|app| app.is_settled());
        let view = window.app().canvas.camera.view().unwrap();
        let width = view.size().width();
        let settings = &window.app().settings;
        let rule = settings.line_rule(LineRule::default(), f64::from(px_per_point));
        let on_screen_px = rule.radius_px(None, view.px_per_m());
        let shown = sizes(&exported(&mut window, width), width.into());
        assert_eq!(shown[0], on_screen_px);
        // The names of the screen are as high.
        let texts = window.harness.output().shapes.iter();
        let mut heights = texts.filter_map(|shape| match &shape.shape {
            Shape::Text(text) if text.galley.text() == "lane 1" => {
                Some(text.galley.job.sections[0].format.font_id.size)
            }
            _ => None,
        });
        let height = heights.next_back().expect("the name is on the screen");
        assert!((f64::from(height * px_per_point) - shown[1]).abs() < 0.01);
        for factor in [2, 4] {
            let larger = sizes(&exported(&mut window, factor * width), width.into());
            for (larger, shown) in larger.into_iter().zip(shown) {
                assert!((larger - shown).abs() < 1e-6 * shown, "{larger} {shown}");
            }
        }
        // SVG and PDF are in pixels of the screen.
        for (modifiers, key) in [(CTRL, Key::P), (CTRL.plus(Modifiers::SHIFT), Key::E)] {
            window.key(modifiers, key);
            window.key(NONE, Key::Enter);
            let vector = take_picture(&mut window);
            assert_eq!((vector.view, vector.style.line_rule), (view, rule));
            assert_eq!(sizes(&vector, width.into()), shown);
        }
        // Twice the pixels show the same sizes on paper and on the screen.
        let in_points = shown.map(|size_px| size_px / f64::from(px_per_point));
        match px_per_point {
            1.0 => on_small_screen = in_points,
            _ => assert!((in_points[1] - on_small_screen[1]).abs() < 1e-6),
        }
        let LineRule::World { min_px, .. } = rule else {
            panic!("the thesis' rule is off");
        };
        assert_eq!(min_px, 1.5 * f64::from(px_per_point));
    }
}

#[test]
fn picture_has_the_widths_of_each_file() {
    let files = [("plan.dxf", small_drawing()), ("site.arrow", lanes(2))];
    let disk = TestServices::with(files);
    let mut window = TestWindow::open(&disk, &["plan.dxf", "site.arrow"], Some("cpu"));
    window.wait(|app| app.is_settled());
    let radius_px = |rule: LineRule| rule.radius_px(None, 1_000.0);
    let shown = window.app().picture().unwrap();
    assert_eq!(radius_px(shown.others[0].line_rule), 0.5);
    assert_eq!(radius_px(shown.style.line_rule), 6.0);
    let larger = exported(&mut window, 2 * shown.view.size().width());
    assert_eq!(radius_px(larger.others[0].line_rule), 1.0);
    assert_eq!(radius_px(larger.style.line_rule), 12.0);
}

#[test]
fn crowd_of_paths_is_shown_as_density_until_the_user_decides() {
    let mut window = TestWindow::showing(lanes(3));
    window.harness.run_steps(3);
    assert!(
        !window.app().settings.shows_density(),
        "three lanes are none"
    );
    drop(window);
    let mut window = TestWindow::showing(lanes(12_000));
    let is_shown = |app: &App| !shown_legends(&app.files, &app.settings).is_empty();
    // Each step takes a quarter of a second of the window: news can leave before its picture is
    // there.
    let mut is_told = false;
    for _ in 0..5_000 {
        // As on a screen, there is a frame only where one is asked for.
        match window.harness.ctx.has_requested_repaint() {
            true => window.harness.step(),
            false => thread::sleep(Duration::from_millis(2)),
        }
        is_told |= has_notice(window.app(), "so it shows their density");
        if is_shown(window.app()) {
            break;
        }
    }
    assert!(is_shown(window.app()));
    assert!(is_told);
    let app = window.app();
    let legends = shown_legends(&app.files, &app.settings);
    assert_eq!(legends[0].column, "paths per pixel");
    // It is no setting that outlives the file.
    assert!(!window.app().settings.is_density);
    window.key(NONE, Key::Y);
    assert!(!window.app().settings.shows_density());
    window.key(NONE, Key::F);
    window.wait(|app| app.files.is_settled());
    assert!(
        !window.app().settings.shows_density(),
        "the user has decided"
    );
    window.app().settings.is_crowded = true;
    window.key(CTRL, Key::W);
    assert!(!window.app().settings.shows_density());
}
