//! GeoJSON writer: layouts round-trip, except for the listed losses.

use crate::common::{codes, read, real_layouts};
use guideway_formats::geojson::{WriteOptions, write_layout};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Layout, NewPath, Value};
use guideway_spline::{Point, Runs, arc_to_runs, polyline_to_runs};
use proptest::prelude::*;

/// Writes a layout; returns the text and the names of the losses.
fn written(layout: &Layout) -> (String, Vec<String>) {
    let mut bytes = Vec::new();
    let losses = write_layout(layout, &mut bytes, &WriteOptions::default()).unwrap();
    (
        String::from_utf8(bytes).unwrap(),
        losses.iter().map(|loss| loss.what.clone()).collect(),
    )
}

fn vertices(layout: &Layout, path: usize) -> Vec<Point<f64>> {
    let segments = layout.paths.get(path).runs().flat_map(|run| run.segments());
    let ends = segments.flat_map(|s| {
        [
            guideway_spline::uniform::start(&s),
            guideway_spline::uniform::end(&s),
        ]
    });
    ends.collect()
}

fn assert_same(a: &Layout, b: &Layout) {
    assert_eq!(a.paths.len(), b.paths.len());
    assert_eq!(a.nodes.len(), b.nodes.len());
    for node in 0..a.nodes.len() as u32 {
        assert_eq!(a.nodes.id(node), b.nodes.id(node));
        let apart = a.nodes.position_m(node).distance(b.nodes.position_m(node));
        assert!(apart <= 1e-6, "node {node}: {apart} m");
    }
    for (p, q) in a.paths.iter().zip(b.paths.iter()) {
        assert_eq!(p.id(), q.id());
        assert_eq!(
            (p.start_node(), p.end_node()),
            (q.start_node(), q.end_node())
        );
        let (v, w) = (vertices(a, p.row()), vertices(b, q.row()));
        assert_eq!(v.len(), w.len(), "path {}", p.id());
        assert!(
            v.iter().zip(&w).all(|(v, w)| v.distance(*w) <= 2e-6),
            "{v:?} {w:?}"
        );
    }
    for column in a.paths.attributes.iter() {
        let other = b.paths.attributes.get(&column.name).unwrap();
        for row in 0..a.paths.len() {
            assert_eq!(
                column.values.get(row),
                other.values.get(row),
                "{}",
                column.name
            );
        }
    }
}

#[test]
fn round_trips_real_graphs_and_roads() {
    for folder in ["nav2_geojson", "geojson_roads"] {
        let Some(folder) = real_layouts(folder) else {
            return;
        };
        for entry in folder.read_dir().unwrap() {
            let path = entry.unwrap().path();
            let layout = read_file(&path, &ReadOptions::default()).unwrap();
            let (text, losses) = written(&layout);
            let again = read(&text);
            assert_eq!(losses, [""; 0], "{}", path.display());
            assert_same(&layout, &again);
            assert_eq!(again.diagnostics.count(Code::AssumedUnit), 0);
            assert_eq!(written(&again).0, text, "{}", path.display());
        }
    }
}

#[test]
fn lists_losses() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    arc_to_runs(Point::new(0.0, 0.0), 5.0, 0.0, 3.0, 1e-4, &mut runs);
    let row = layout.paths.push(&NewPath {
        id: "bow",
        runs: &runs,
        vehicle_types: &["fork", "tug"],
        ..NewPath::default()
    });
    layout.paths.set_width_m(vec![0.5]);
    layout.paths.attributes.set(row, "id", Value::Int(3));
    layout.stations.push("S", None, Vec::new(), None);
    layout.refused.push("R", Code::UnknownNode, "no nodes");
    let (text, losses) = written(&layout);
    let expected = ["refused paths", "widths", "column id", "stations", "curves"];
    assert_eq!(losses, expected);
    let again = read(&text);
    let types = again.paths.attributes.get("vehicle_types").unwrap();
    assert_eq!(types.values.get(0), Some(Value::Text("fork, tug")));
    for point in vertices(&again, 0) {
        assert!((point.norm() - 5.0).abs() < 1e-3, "{point:?}");
    }
}

#[test]
fn keeps_gaps() {
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(1.0, 0.0));
    runs.push_line(Point::new(5.0, 0.0), Point::new(6.0, 0.0));
    let mut layout = Layout::default();
    layout.paths.push(&NewPath {
        id: "E",
        runs: &runs,
        ..NewPath::default()
    });
    let again = read(&written(&layout).0);
    assert_eq!(codes(&again), []);
    assert_same(&layout, &again);
}

fn arbitrary_layout() -> impl Strategy<Value = Layout> {
    let point = (-1e6..1e6, -1e6..1e6).prop_map(|(x, y)| Point::new(x, y));
    let line = prop::collection::vec(point, 2..6);
    let path = ("[ -~]{1,8}", line, any::<i64>(), any::<bool>(), -1e9..1e9);
    let paths = prop::collection::vec(path, 1..8);
    paths.prop_map(|paths| {
        let mut layout = Layout::default();
        let mut runs = Runs::default();
        for (i, (id, points, whole, truth, number)) in paths.iter().enumerate() {
            runs.clear();
            polyline_to_runs(points, &mut runs);
            let start = layout.nodes.push(&format!("{i} from"), points[0], None);
            let end = layout
                .nodes
                .push(&i.to_string(), points[points.len() - 1], None);
            let row = layout.paths.push(&NewPath {
                id,
                runs: &runs,
                start_node: Some(start),
                end_node: Some(end),
                ..NewPath::default()
            });
            let attributes = &mut layout.paths.attributes;
            attributes.set(row, "whole", Value::Int(*whole));
            attributes.set(row, "truth", Value::Bool(*truth));
            attributes.set(row, "a.number", Value::Float(*number));
            attributes.set(row, "\"text\"\n", Value::Text(id));
        }
        layout
    })
}

proptest! {
    #[test]
    fn round_trips_any_layout_of_lines(layout in arbitrary_layout()) {
        let (text, losses) = written(&layout);
        prop_assert!(losses.is_empty(), "{:?}", losses);
        assert_same(&layout, &read(&text));
    }
}

#[test]
#[should_panic(expected = "left == right")]
fn comparison_detects_a_different_layout() {
    let line = |x: f64| {
        let mut layout = Layout::default();
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, 0.0), Point::new(x, 0.0));
        layout.paths.push(&NewPath {
            id: &x.to_string(),
            runs: &runs,
            ..NewPath::default()
        });
        layout
    };
    assert_same(&line(1.0), &line(2.0));
}
