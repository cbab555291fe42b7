//! The look of paths and names: walls, widths of lines, colors of numbers, fonts and halos.

use eframe::egui::accesskit::Role;
use eframe::egui::epaint::TextShape;
use eframe::egui::{Color32, FontFamily, Key, Modifiers, Shape};
use egui_kittest::kittest::{By, Queryable};
use guideway_document::{Document, PropertyRef, SelectMode};
use guideway_formats::ReadOptions;
use guideway_layout::{Layout, Value};
use guideway_scene::{Palette, Table};
use guideway_spline::Point;

use super::services::lanes;
use super::test_window::TestWindow;
use crate::canvas::shown_legends;
use crate::language::Language;
use crate::panels::SideTab;

/// Two lanes and a wall across them, which stands above them in the file of another program.
const BUILDING: &str = "coordinate_system: reference_image
levels:
  L1:
    elevation: 0
    measurements:
      - [0, 1, {distance: [3, 10]}]
    vertices:
      - [0, 0, 0, a]
      - [100, 0, 0, b]
      - [100, 50, 0, c]
      - [50, -40, 0, \"\"]
      - [50, 40, 0, \"\"]
    lanes:
      - [0, 1, {bidirectional: [4, true], graph_idx: [2, 0]}]
      - [1, 2, {bidirectional: [4, false], graph_idx: [2, 0]}]
    walls:
      - [3, 4, {}]
name: site
";

fn building() -> Layout {
    let bytes = BUILDING.as_bytes();
    let read = guideway_formats::read_bytes("a.building.yaml", bytes, &ReadOptions::default());
    read.expect("the file is sound")
}

/// Rows of the walls, and of the lanes.
fn walls_and_lanes(layout: &Layout) -> [Vec<u32>; 2] {
    let rows = 0..layout.paths.len() as u32;
    let (lanes, walls) = rows.partition(|row| layout.paths.is_driven(*row as usize));
    [walls, lanes]
}

#[test]
fn walls_of_a_building_look_other_than_lanes_and_lie_below_them() {
    let mut window = TestWindow::showing(building());
    let [walls, lanes] = walls_and_lanes(window.document().layout());
    assert_eq!((walls.len(), lanes.len()), (1, 2));
    let scene = window.document().scene();
    let [gray, blue] = [walls[0], lanes[0]].map(|row| scene.color(row));
    assert_ne!(gray, blue);
    assert!(gray.r == gray.g && gray.g == gray.b, "{gray}");
    assert_eq!(scene.draw_order()[0], walls[0]);
    // A click at their crossing selects the lane, which is on top.
    let bounds = scene.bounds().unwrap();
    let crossing = lane_over_wall(window.document());
    assert!(bounds.contains(crossing));
    let at = window.at(crossing.x, crossing.y);
    window.click(at);
    assert_eq!(window.selected(), [lanes[0]]);
    // A copy of a wall is a wall, and what is no wall any more is as blue as a lane.
    let wall = walls[0];
    window.change(move |document| {
        document.select([wall].into_iter().collect(), SelectMode::Replace);
    });
    window.edit(|document| document.copy_selection(1, Point::new(20.0, 0.0)));
    let copy = window.document().scene().row_count() as u32 - 1;
    assert_eq!(window.document().scene().color(copy), gray);
    window.edit(move |document| {
        let element = PropertyRef {
            of: Table::Paths,
            name: "element",
            vehicle_type: None,
        };
        let rows = [copy].into_iter().collect();
        document.set_property(element, &rows, Some(Value::Text("lane")))
    });
    window.wait(|app| {
        app.document()
            .is_some_and(|document| document.scene().color(copy) == blue)
    });
    let scene = window.document().scene();
    assert_eq!((scene.color(wall), scene.draw_order()[0]), (gray, wall));
}

/// The place where the first lane crosses the wall, in meters.
fn lane_over_wall(document: &Document) -> Point<f64> {
    let [walls, lanes] = walls_and_lanes(document.layout());
    let ends = |row: u32| document.layout().paths.get(row as usize).ends().unwrap();
    let (wall, lane) = (ends(walls[0]), ends(lanes[0]));
    // One is upright, the other one level.
    Point::new(wall.0.x, lane.0.y)
}

/// A drawing of lanes that are centimeters long.
pub(super) fn small_drawing() -> Layout {
    let mut drawing = lanes(3);
    drawing.retain_nodes_and_stations(&[], &[]);
    let smaller = guideway_spline::Affine::scale(0.07, 0.07, Point::default());
    drawing.paths.transform(0..3, smaller);
    drawing.provenance.format = "DXF".to_owned();
    drawing
}

#[test]
fn lines_are_as_wide_as_suits_the_file_until_the_user_sets_a_width() {
    let radius_px = |window: &mut TestWindow| {
        window.wait(|app| app.is_settled());
        let layer = &window.app().files.layers()[0];
        let requested = layer.picture.requested().expect("a picture is shown");
        let px_per_m = requested.view.px_per_m();
        let marks = &layer.slot.overlay().last().unwrap().marks;
        let radius_px = requested.style.line_rule.radius_px(None, px_per_m);
        assert_eq!(marks.line_radius_px, radius_px, "marks know the lines");
        (radius_px, px_per_m)
    };
    let mut window = TestWindow::showing(small_drawing());
    window.key(Modifiers::NONE, Key::F);
    // A tenth of a meter would be more than a hundred pixels.
    let (hairline, px_per_m) = radius_px(&mut window);
    assert!(hairline == 0.5 && px_per_m > 1_000.0, "{px_per_m}");
    for key in [Key::Minus, Key::Plus, Key::Plus] {
        window.key(Modifiers::NONE, key);
        assert_eq!(radius_px(&mut window).0, hairline, "at any scale");
    }
    window.app().side.open(SideTab::View);
    window.harness.run_steps(3);
    let shown = |window: &TestWindow| window.harness.query_all_by_label("automatic").count();
    assert_eq!(shown(&window), 1);
    window.harness.get_by_label("Width").click();
    window.harness.run_steps(3);
    assert_eq!(shown(&window), 0);
    assert!(window.app().settings.width_m.is_some());
    assert!(radius_px(&mut window).0 > 2.0);
    drop(window);
    let mut window = TestWindow::showing(lanes(3));
    window.key(Modifiers::NONE, Key::F);
    let (radius, px_per_m) = radius_px(&mut window);
    let expected = (0.05 * px_per_m).clamp(0.75, 6.0);
    assert!((radius - expected).abs() < 1e-9, "{radius} {px_per_m}");
}

/// The texts that are painted on the canvas.
fn painted_texts(window: &TestWindow) -> Vec<TextShape> {
    let shapes = window.harness.output().shapes.iter();
    let texts = shapes.filter_map(|shape| match &shape.shape {
        Shape::Text(text) => Some(text.clone()),
        _ => None,
    });
    texts.collect()
}

#[test]
fn names_are_in_the_font_of_the_window_and_stand_out_by_their_halos() {
    let mut layout = lanes(2);
    layout.paths.set_ids(&[(1, "WWWWWWWWWW")]);
    let mut window = TestWindow::showing(layout);
    window.key(Modifiers::NONE, Key::F);
    window.wait(|app| app.is_settled());
    window.harness.step();
    for (name, columns) in [("lane 0", 6.0), ("WWWWWWWWWW", 10.0)] {
        let texts = painted_texts(&window).into_iter();
        let copies: Vec<_> = texts.filter(|text| text.galley.text() == name).collect();
        let [halo @ .., letters] = &copies[..] else {
            panic!("{name} is not shown");
        };
        let font = &letters.galley.job.sections[0].format.font_id;
        assert_eq!(font.family, FontFamily::Proportional, "{name}");
        // No wider than the space that is kept for it.
        let space = columns * 11.0 * 0.6;
        assert!(letters.galley.size().x <= space + 1.0, "{name}");
        assert_eq!(halo.len(), 4);
        let is_paper = |copy: &TextShape| copy.override_text_color == Some(Color32::WHITE);
        assert!(halo.iter().all(is_paper) && !is_paper(letters));
        assert!(halo.iter().all(|copy| copy.pos != letters.pos));
    }
}

fn box_with(window: &TestWindow, value: &str) -> bool {
    let combo = By::new().role(Role::ComboBox).value(value);
    window.harness.query(combo).is_some()
}

#[test]
fn palette_and_range_of_numbers_are_chosen_beside_their_column() {
    let mut window = TestWindow::showing(lanes(12));
    window.app().side.open(SideTab::View);
    window.harness.run_steps(3);
    assert!(!box_with(&window, "warm"), "no column colors the paths");
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.wait(|app| app.is_settled());
    let colors = |window: &mut TestWindow| {
        window.wait(|app| app.is_settled());
        let scene = window.document().scene();
        [0, 2, 4, 11].map(|row| scene.color(row))
    };
    let tick_count = |window: &mut TestWindow| {
        let app = window.app();
        shown_legends(&app.files, &app.settings)[0].entries.len()
    };
    let (warm, ticks) = (colors(&mut window), tick_count(&mut window));
    let combo = By::new().role(Role::ComboBox).value("warm");
    window.harness.get(combo).click();
    window.harness.run_steps(3);
    window.harness.get_by_label("viridis").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().settings.palette, Palette::Viridis);
    let viridis = colors(&mut window);
    assert!(warm.iter().zip(&viridis).all(|(a, b)| a != b));
    // The ends are those of the column at first: nothing changes.
    for label in ["Range from", "up to"] {
        window.harness.get_by_label(label).click();
        window.harness.run_steps(3);
    }
    assert_eq!(window.app().settings.range, [Some(0.0), Some(5.5)]);
    assert_eq!(colors(&mut window), viridis);
    window.type_over_number("5.50", "2");
    assert_eq!(window.app().settings.range, [Some(0.0), Some(2.0)]);
    let narrow = colors(&mut window);
    assert_eq!((narrow[0], narrow[2]), (viridis[0], viridis[3]));
    assert_eq!(
        narrow[2], narrow[3],
        "numbers beyond have the color of the end"
    );
    assert_ne!(narrow[1], viridis[1]);
    assert_ne!(tick_count(&mut window), ticks, "the legend has the range");
    window.harness.get_by_label("up to").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().settings.range, [Some(0.0), None]);
    assert_eq!(colors(&mut window), viridis);
    // Colors stand out from dark paper too.
    window.key(Modifiers::NONE, Key::B);
    assert_ne!(colors(&mut window), viridis);
    // Another column has numbers of its own, or none.
    window.app().settings.color_by = Some("direction".into());
    window.app().recolor();
    window.wait(|app| app.is_settled());
    window.harness.run_steps(3);
    assert!(!box_with(&window, "viridis"));
}

#[test]
fn class_breaks_are_typed_or_taken_from_the_scale() {
    let mut window = TestWindow::showing(lanes(12));
    window.app().side.open(SideTab::View);
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    let labels = |window: &mut TestWindow| -> Vec<String> {
        window.wait(|app| app.is_settled());
        window.harness.run_steps(3);
        let app = window.app();
        let legends = shown_legends(&app.files, &app.settings);
        let entries = legends[0].entries.iter();
        entries.map(|entry| entry.label.clone()).collect()
    };
    let is_told = |window: &TestWindow, text: &str| {
        let mut found = window.harness.query_all_by_label_contains(text);
        found.next().is_some()
    };
    let continuous = labels(&mut window);
    let field = || By::new().role(Role::TextInput).label("Class breaks");
    window.harness.get(field()).focus();
    window.answer("0,5 2");
    let classes = ["below 0.5", "0.5 to 2", "2 and more"];
    assert_eq!(labels(&mut window), classes);
    let scene = window.document().scene();
    let [low, start, end, high, last] = [0, 1, 3, 4, 11].map(|row| scene.color(row));
    assert!(low != start && start == end && end != high && high == last);
    assert!(!is_told(&window, "Range from") && is_told(&window, "take the place of a range"));
    // A mistake is told, and the classes stay.
    window.harness.get(field()).focus();
    window.answer("2 0.5");
    assert_eq!(labels(&mut window), classes);
    assert!(is_told(&window, "0.5 comes after 2"));
    window.app().settings.language = Some(Language::German);
    window.harness.run_steps(3);
    assert_eq!(
        labels(&mut window),
        ["unter 0.5", "0.5 bis 2", "2 und mehr"]
    );
    assert!(is_told(&window, "0.5 kommt nach 2"));
    window.app().settings.language = Some(Language::English);
    window.harness.run_steps(3);
    window.harness.get_by_label("From the scale").click();
    window.harness.run_steps(3);
    assert_eq!(window.app().settings.breaks.text(), "1, 2, 3, 4, 5");
    assert_eq!(labels(&mut window).len(), 6);
    // Without a text the scale is continuous.
    window.harness.get(field()).focus();
    window.harness.run_steps(2);
    window.key(Modifiers::COMMAND, Key::A);
    window.key(Modifiers::NONE, Key::Delete);
    assert_eq!(labels(&mut window), continuous);
    assert!(is_told(&window, "Range from"));
}

#[test]
fn painted_legend_is_that_of_density_while_density_is_shown() {
    let mut window = TestWindow::showing(lanes(3));
    window.app().settings.color_by = Some("speed".into());
    window.app().recolor();
    window.wait(|app| app.files.is_settled());
    let has = |window: &TestWindow, title: &str| {
        let texts = painted_texts(window);
        texts.iter().any(|text| text.galley.text() == title)
    };
    window.wait(|app| !shown_legends(&app.files, &app.settings).is_empty());
    window.harness.step();
    assert!(has(&window, "speed") && !has(&window, "paths per pixel"));
    window.app().settings.is_density = true;
    window.wait(|app| {
        let legends = shown_legends(&app.files, &app.settings);
        legends
            .first()
            .is_some_and(|of| of.column == "paths per pixel")
    });
    window.harness.step();
    assert!(!has(&window, "speed") && has(&window, "paths per pixel"));
}
