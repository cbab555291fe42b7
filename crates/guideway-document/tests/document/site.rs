//! Test layouts and helpers.

use std::sync::Arc;

use guideway_document::{Document, SelectMode};
use guideway_layout::{Block, Direction, Layout, Level, Member, NewPath, Quantity, Value};
use guideway_scene::{FrameSize, View};
use guideway_scene::{Scene, SceneOptions};
use guideway_spline::{Point, Runs};

pub(crate) fn p(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

/// `count` straight paths of 10 m, one meter apart, named `path-0` and so on; every third one is
/// two-way.
pub(crate) fn lanes(count: usize) -> Layout {
    let mut layout = Layout::default();
    for row in 0..count {
        let y = row as f64;
        let mut runs = Runs::default();
        runs.push_line(p(0.0, y), p(10.0, y));
        layout.nodes.push(&format!("node-{row}"), p(0.0, y), None);
        let both = row.is_multiple_of(3);
        layout.paths.push(&NewPath {
            id: &format!("path-{row}"),
            runs: &runs,
            direction: if both {
                Direction::Both
            } else {
                Direction::Forward
            },
            vehicle_types: if row == 1 { &["truck", "tug"] } else { &[] },
            ..NewPath::default()
        });
        let attributes = &mut layout.paths.attributes;
        attributes.set(row, "speed", Value::Float(0.5 * y));
        if row.is_multiple_of(2) {
            attributes.set(row, "zone", Value::Text("Hall A"));
        }
    }
    layout
}

pub(crate) fn scene_of(layout: Layout) -> Scene {
    Scene::new(Arc::new(layout), &SceneOptions::default()).expect("default options fit any layout")
}

pub(crate) fn document_of(layout: Layout) -> Document {
    let layout = Arc::new(layout);
    Document::new(layout, &SceneOptions::default()).expect("default options fit any layout")
}

/// A document of some [`lanes`].
pub(crate) fn document(count: usize) -> Document {
    document_of(lanes(count))
}

pub(crate) fn view(center: Point<f64>, px_per_m: f64) -> View {
    let size = FrameSize::new(800, 600).expect("a valid size");
    View::new(size, center, px_per_m).expect("a view near the origin")
}

/// Start and end of a path.
pub(crate) fn ends(document: &Document, path: usize) -> (Point<f64>, Point<f64>) {
    document
        .layout()
        .paths
        .get(path)
        .ends()
        .expect("a path with a curve")
}

/// Returns `true` if two points coincide up to rounding.
pub(crate) fn is_near(a: Point<f64>, b: Point<f64>) -> bool {
    a.distance(b) < 1e-9
}

/// Replaces the selection.
pub(crate) fn select(document: &mut Document, rows: impl IntoIterator<Item = u32>) {
    document.select(rows.into_iter().collect(), SelectMode::Replace);
}

/// Two paths from a to b and b to c, the second one bent.
pub(crate) fn two_joined() -> Document {
    let mut layout = Layout::default();
    let [a, b, c] = [("a", 0.0), ("b", 10.0), ("c", 20.0)]
        .map(|(id, x)| layout.nodes.push(id, p(x, 0.0), None));
    let mut straight = Runs::default();
    straight.push_line(p(0.0, 0.0), p(10.0, 0.0));
    let mut bent = Runs::default();
    bent.push_bezier(&[p(10.0, 0.0), p(12.0, 5.0), p(18.0, 5.0), p(20.0, 0.0)]);
    for (id, runs, start, end) in [("ab", straight, a, b), ("bc", bent, b, c)] {
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..NewPath::default()
        });
    }
    document_of(layout)
}

/// Four nodes of a square of 10 m with a path along each side, from `a` by `b`, `c` and `d`. The
/// tugger and the stacker may use `ab`, the others are open to all. Station `dock` is at `a`, one
/// meter below; station `rack` between `b` and `c`, one meter to the right.
pub(crate) fn square() -> Layout {
    let mut layout = Layout::default();
    let corners = [
        ("a", 0.0, 0.0),
        ("b", 10.0, 0.0),
        ("c", 10.0, 10.0),
        ("d", 0.0, 10.0),
    ];
    for level in ["ground", "upper"] {
        layout.levels.push(Level {
            id: level.into(),
            ..Level::default()
        });
    }
    for (id, x, y) in corners {
        layout.nodes.push_for_types(id, p(x, y), Some(0), &["tug"]);
    }
    for (row, id) in ["ab", "bc", "cd", "da"].into_iter().enumerate() {
        let ends = [row as u32, (row as u32 + 1) % 4];
        let [start, end] = ends.map(|node| layout.nodes.position_m(node));
        let mut runs = Runs::default();
        runs.push_line(start, end);
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(ends[0]),
            end_node: Some(ends[1]),
            level: Some(0),
            vehicle_types: if row == 0 { &["tug", "stacker"] } else { &[] },
            ..NewPath::default()
        });
        let attributes = &mut layout.paths.attributes;
        attributes.set_quantity(row, "maxSpeed", 1.5, Quantity::Speed);
    }
    let (dock, rack) = (Some(p(0.0, -1.0)), Some(p(11.0, 5.0)));
    layout.stations.push("dock", dock, vec![0], Some(0));
    layout.stations.push("rack", rack, vec![1, 2], Some(0));
    layout.blocks.push(Block {
        id: "crossing".into(),
        members: vec![Member::Path(1), Member::Node(1), Member::Station(1)],
        ..Block::default()
    });
    layout
}
