//! Drawing by clicks: lines, arcs, curves, nodes, stations, snapping.

use eframe::egui::{Event, Key, Modifiers, PointerButton, Shape, Vec2};
use guideway_document::Document;
use guideway_document::decorations::handles;
use guideway_scene::Table;
use guideway_spline::Point;

use super::services::{TestServices, lanes};
use super::test_window::{TestWindow, has_notice};
use crate::panels::SideTab;

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// A window with a new layout.
pub(super) fn new_layout() -> TestWindow {
    let mut window = TestWindow::open(&TestServices::with([]), &[], Some("cpu"));
    window.key(CTRL, Key::N);
    window.wait(|app| app.document().is_some());
    window
}

pub(super) fn click(window: &mut TestWindow, x: f64, y: f64) {
    let at = window.at(x, y);
    window.click(at);
}

pub(super) fn node_at(document: &Document, x: f64, y: f64) -> Option<u32> {
    document.node_near(Point::new(x, y), 1e-6)
}

fn ends(document: &Document, row: usize) -> [Option<u32>; 2] {
    let path = document.layout().paths.get(row);
    [path.start_node(), path.end_node()]
}

#[test]
fn bezier_curves_are_drawn_by_their_control_points() {
    let mut window = new_layout();
    window.key(Modifiers::SHIFT, Key::C);
    for point in ["0,0", "4,0", "8,4", "8,8"] {
        window.type_line(point);
    }
    window.key(NONE, Key::Enter);
    let document = window.document();
    assert_eq!(document.existing(Table::Nodes).count(), 2);
    let path = document.layout().paths.get(0);
    let middle = path.point_at(path.length_m() / 2.0).unwrap();
    assert!(middle.distance(Point::new(5.5, 2.5)) < 1e-3, "{middle:?}");
}

#[test]
fn arc_by_three_clicks_by_radius_and_on_from_a_path() {
    let mut window = new_layout();
    window.key(NONE, Key::O);
    for text in ["0,0", "4,0", "2,-2"] {
        window.type_line(text);
    }
    assert_eq!(
        window.document().existing(Table::Paths).count(),
        1,
        "it needs no Enter"
    );
    window.type_line("10,0");
    window.type_line("14,0");
    let at = window.at(12.0, 3.0);
    window.harness.event(Event::PointerMoved(at));
    window.harness.step();
    window.type_line("r1.9");
    let typed = window.app().tools.typed().cloned().unwrap();
    assert!(typed.error.unwrap().contains("too small"));
    window.key(NONE, Key::Escape);
    window.type_line("r2");
    let middle = |window: &mut TestWindow, row| {
        let path = window.document().layout().paths.get(row);
        path.point_at(path.length_m() / 2.0).unwrap()
    };
    let bulge = middle(&mut window, 1);
    assert!(bulge.distance(Point::new(12.0, 2.0)) < 1e-3, "{bulge:?}");
    // From the end of a path, two points are enough.
    window.type_line("4,0");
    window.type_line("6,4");
    window.key(NONE, Key::Enter);
    assert_eq!(window.document().existing(Table::Paths).count(), 3);
    // Without a path there, they are not, and the points stay.
    window.type_line("30,30");
    window.type_line("32,31");
    window.key(NONE, Key::Enter);
    assert!(has_notice(window.app(), "two points give no arc"));
    assert!(window.app().tools.has_gesture());
}

#[test]
fn curve_leads_through_the_clicked_points() {
    let mut window = TestWindow::showing(lanes(3));
    window.key(NONE, Key::C);
    for (x, y) in [(10.0, 0.0), (8.0, 1.1), (10.0, 4.0)] {
        click(&mut window, x, y);
    }
    window.key(NONE, Key::Enter);
    let document = window.document();
    let through = Point::new(8.0, 1.1);
    let nearest = guideway_document::nearest(document.layout(), 3, through, 1e-4).unwrap();
    // A click is a whole pixel.
    assert!(nearest.distance_m < 0.05, "{nearest:?}");
    assert_eq!(ends(document, 3), [Some(1), Some(5)]);
}

#[test]
fn node_tool_splits_paths_and_station_tool_uses_nodes() {
    let mut window = TestWindow::showing(lanes(2));
    window.key(NONE, Key::W);
    click(&mut window, 4.0, 0.0);
    let document = window.document();
    assert_eq!(
        document.existing(Table::Paths).count(),
        3,
        "it is in two pieces"
    );
    let split = document.selected().nodes.min().unwrap();
    assert!(
        document
            .node_position_m(split)
            .distance(Point::new(4.0, 0.0))
            < 0.05
    );
    click(&mut window, 4.0, 1.0);
    let free = window.document().selected().nodes.min().unwrap();
    assert_ne!(split, free);
    // A click on a node creates none.
    let count = window.document().existing(Table::Nodes).count();
    click(&mut window, 10.0, 2.0);
    assert_eq!(window.document().existing(Table::Nodes).count(), count);

    window.key(NONE, Key::S);
    click(&mut window, 10.0, 2.0);
    let document = window.document();
    let station = document.selected().stations.min().unwrap();
    assert_eq!(document.layout().stations.nodes(station), [3]);
    window.type_line("5,8");
    let document = window.document();
    let free = document.selected().stations.min().unwrap();
    assert!(document.layout().stations.nodes(free).is_empty());
    assert_eq!(
        document.station_position_m(free),
        Some(Point::new(5.0, 8.0))
    );
    window.key(NONE, Key::F2);
    window.answer("dock 7");
    assert_eq!(window.document().layout().stations.id(free), "dock 7");
}

#[test]
fn points_snap_to_places_of_paths_and_alt_suspends_it() {
    let mut window = TestWindow::showing(lanes(2));
    window.key(NONE, Key::D);
    let near = window.at(5.0, 0.05);
    window.click(near);
    let far = window.at(5.0, 1.1);
    window.click(far);
    window.key(NONE, Key::Enter);
    let middle = Point::new(5.0, 0.0);
    let node = window.document().node_near(middle, 1e-3);
    assert!(node.is_some(), "a node at the middle");
    // The lane is split there, so that the new path is connected.
    let at_node = window.document().index().paths_at(node.unwrap());
    assert_eq!(at_node.count(), 3);
    for _ in 0..2 {
        window.key(CTRL, Key::Z);
    }
    assert!(!window.document().is_changed());
    window.click_with(near, Modifiers::ALT);
    window.click_with(far, Modifiers::ALT);
    window.key(NONE, Key::Enter);
    assert_eq!(
        window.document().node_near(middle, 1e-3),
        None,
        "the pointer itself"
    );
    assert!(
        window
            .document()
            .node_near(Point::new(5.0, 0.05), 0.03)
            .is_some()
    );
}

#[test]
fn escape_takes_back_what_is_drawn_and_undo_its_last_point() {
    let mut window = new_layout();
    window.key(NONE, Key::C);
    for (x, y) in [(0.0, 0.0), (3.0, 2.0), (6.0, 0.0)] {
        click(&mut window, x, y);
    }
    window.key(CTRL, Key::Z);
    assert!(window.app().tools.has_gesture());
    window.key(NONE, Key::Escape);
    assert!(!window.app().tools.has_gesture());
    assert!(!window.document().is_changed());
    // A right drag pans, and finishes nothing.
    click(&mut window, 0.0, 0.0);
    click(&mut window, 5.0, 0.0);
    let (from, to) = (window.at(2.0, 2.0), window.at(4.0, 3.0));
    let events = [
        Event::PointerMoved(from),
        button(from, true),
        Event::PointerMoved(to),
        button(to, false),
    ];
    window.harness.input_mut().events.extend(events);
    window.harness.run_steps(2);
    assert!(window.app().tools.has_gesture());
}

fn button(pos: eframe::egui::Pos2, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button: PointerButton::Secondary,
        pressed,
        modifiers: NONE,
    }
}

#[test]
fn dragged_control_point_leaves_the_ends_on_their_nodes() {
    let mut window = new_layout();
    window.key(Modifiers::SHIFT, Key::C);
    for point in ["0,0", "4,0", "8,4", "8,8"] {
        window.type_line(point);
    }
    window.key(NONE, Key::Enter);
    window.key(NONE, Key::F);
    window.key(NONE, Key::P);
    let curve = window.document().layout().paths.get(0);
    let middle = curve.point_at(curve.length_m() / 2.0).unwrap();
    let at = window.at(middle.x, middle.y);
    window.click(at);
    // Control points lie beside the curve.
    for _ in 0..3 {
        window.key(NONE, Key::Minus);
    }
    let view = window.app().canvas.camera.view().unwrap();
    let handle = handles(window.document(), &view)[1].at_px;
    let from = window.app().canvas.origin() + Vec2::new(handle.x as f32, handle.y as f32);
    window.drag(from, from + Vec2::new(60.0, 90.0));
    let document = window.document();
    let path = document.layout().paths.get(0);
    let (start, end) = path.ends().unwrap();
    let nodes = [path.start_node(), path.end_node()].map(Option::unwrap);
    for (end, node) in [start, end].into_iter().zip(nodes) {
        assert!(
            end.distance(document.node_position_m(node)) < 1e-6,
            "{end:?}"
        );
    }
    let now = path.point_at(path.length_m() / 2.0).unwrap();
    assert!(
        now.distance(middle) > 0.05,
        "the curve is another one: {now:?}"
    );
}

#[test]
fn plot_of_a_drawn_arc_has_axes_with_units() {
    let mut window = new_layout();
    window.key(NONE, Key::O);
    for text in ["0,0", "4,0", "2,-2"] {
        window.type_line(text);
    }
    window.app().side.open(SideTab::Properties);
    window.harness.run_steps(4);
    let canvas = window.app().canvas.screen().rect;
    let shapes = window.harness.output().shapes.iter();
    let texts = shapes.filter_map(|shape| match &shape.shape {
        Shape::Text(text) if text.pos.x > canvas.right() => {
            Some((text.galley.text().to_owned(), text.visual_bounding_rect()))
        }
        _ => None,
    });
    let texts: Vec<_> = texts.collect();
    let place = |text: &str| {
        let found = texts.iter().find(|(other, _)| other == text);
        found.unwrap_or_else(|| panic!("{text}: {texts:?}")).1
    };
    // A half circle of radius 2 m to the left: curvatures upward, lengths to the right.
    let curvatures = ["0.50 /m", "0.00 /m", "-0.50 /m"].map(|text| place(text).center().y);
    assert!(curvatures.is_sorted(), "{curvatures:?}");
    let lengths = ["0 mm", "3.142 m", "6.283 m"].map(&place);
    assert!(lengths.is_sorted_by_key(|rect| rect.left()), "{lengths:?}");
    assert!(lengths.iter().all(|rect| rect.top() > curvatures[2]));
    let lines = window.harness.output().shapes.iter();
    let is_axis = |shape: &Shape| match shape {
        Shape::LineSegment { points, .. } => points.iter().all(|at| at.x > canvas.right()),
        _ => false,
    };
    assert!(lines.filter(|shape| is_axis(&shape.shape)).count() >= 3);
}
