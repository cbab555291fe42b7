//! Small layouts to look at.

use std::sync::Arc;

use guideway_document::Document;
use guideway_layout::{Direction, Layout, NewPath, Value};
use guideway_scene::{FrameSize, View};
use guideway_scene::{Scene, SceneOptions};
use guideway_spline::{Point, Runs};

pub(crate) fn p(x: f64, y: f64) -> Point<f64> {
    Point::new(x, y)
}

/// `count` straight paths of 10 m, one meter apart, named `path-0` and so on; every third goes both ways.
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
    Scene::new(Arc::new(layout), &SceneOptions::default()).expect("no level or column is asked for")
}

pub(crate) fn document_of(layout: Layout) -> Document {
    let layout = Arc::new(layout);
    Document::new(layout, &SceneOptions::default()).expect("no level or column is asked for")
}

/// A document of some [`lanes`].
pub(crate) fn document(count: usize) -> Document {
    document_of(lanes(count))
}

pub(crate) fn view(center: Point<f64>, px_per_m: f64) -> View {
    let size = FrameSize::new(800, 600).expect("a size that can be held");
    View::new(size, center, px_per_m).expect("a view near the origin")
}
