//! LIF writer: layouts round-trip through 1.0 and 2.0, except for the listed losses.

use std::time::{Duration, SystemTime};

use crate::common::{codes, read};
use crate::same::{
    apart_m, arbitrary_layout, assert_same_curves, assert_same_ids, assert_same_network, broken,
    lost,
};
use guideway_formats::Losses;
use guideway_formats::lif::{Version, WriteOptions, write_layout};
use guideway_layout::{Code, Direction, Layout, Level, NewPath, Value};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

const VERSIONS: [Version; 2] = [Version::V1, Version::V2];

fn written(layout: &Layout, version: Version) -> (String, Losses) {
    let mut bytes = Vec::new();
    let exported = SystemTime::UNIX_EPOCH + Duration::from_millis(1_700_000_000_120);
    let losses = write_layout(layout, &mut bytes, &WriteOptions { version, exported });
    (String::from_utf8(bytes).unwrap(), losses.unwrap())
}

fn types(layout: &Layout, path: usize) -> Vec<&str> {
    layout.paths.vehicle_types().of(path).collect()
}

fn column<'a>(layout: &'a Layout, name: &str, path: usize) -> Option<Value<'a>> {
    layout.paths.attributes.get(name)?.values.get(path)
}

proptest! {
    #[test]
    fn round_trips_any_layout(layout in arbitrary_layout()) {
        for version in VERSIONS {
            let (text, losses) = written(&layout, version);
            let mut lost = lost(&losses);
            lost.retain(|(what, _)| *what != "column rotationAllowed");
            prop_assert!(lost.is_empty(), "{losses:?}");
            let again = read(&text);
            assert_same_curves(&layout, &again, "LIF");
            assert_same_ids(&layout, &again, "LIF");
            assert_same_network(&layout, &again, "LIF");
            for path in 0..layout.paths.len() {
                prop_assert_eq!(types(&again, path), types(&layout, path));
                let speed = |of| column(of, "maxSpeed", path);
                prop_assert_eq!(speed(&again), speed(&layout));
            }
            // No diagnostics, although curves and nodes are apart.
            prop_assert!(codes(&again).is_empty(), "{:?} in {text}", codes(&again));
        }
    }
}

/// Four paths without nodes: three connected, the last of them two-way, and one separate.
fn bare() -> Layout {
    let mut layout = Layout::default();
    for (id, from, to, direction) in [
        ("a", (0.0, 0.0), (5.0, 0.0), Direction::Forward),
        ("b", (5.0, 0.0005), (5.0, 5.0), Direction::Forward),
        ("b", (5.0, 5.0), (0.0, 5.0), Direction::Both),
        ("c", (9.0, 9.0), (9.0, 12.0), Direction::Forward),
    ] {
        let mut runs = Runs::default();
        runs.push_line(Point::new(from.0, from.1), Point::new(to.0, to.1));
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            direction,
            ..NewPath::default()
        });
    }
    layout
}

#[test]
fn adds_shared_end_nodes_to_paths_without_nodes() {
    for version in VERSIONS {
        let (text, losses) = written(&bare(), version);
        let mut expected = vec![
            ("levels", 4),
            ("nodes", 6),
            ("vehicle types", 4),
            ("directions", 1),
        ];
        if version == Version::V1 {
            expected.push(("column rotationAllowed", 4));
        }
        assert_eq!(lost(&losses), expected);
        let again = read(&text);
        assert_eq!((again.nodes.len(), again.paths.len()), (6, 5));
        let ids: Vec<&str> = again.paths.iter().map(|p| p.id()).collect();
        assert_eq!(ids, ["a", "b", "b", "b~2", "c"]);
        let ends: Vec<_> = again
            .paths
            .iter()
            .map(|p| (p.start_node(), p.end_node()))
            .collect();
        assert_eq!(ends[0].1, ends[1].0);
        assert_eq!((ends[3].0, ends[3].1), (ends[2].1, ends[2].0));
        assert_eq!(types(&again, 0), ["any"]);
        assert_eq!(again.levels[0].id, "layout");
        assert_eq!(codes(&again), []);
    }
}

#[test]
fn parallel_lines_keep_their_order() {
    let mut layout = Layout::default();
    let ids: Vec<String> = (0..9_000).map(|i| format!("path {i}")).collect();
    for (id, y) in ids.iter().zip(0..) {
        let y = f64::from(y);
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, y), Point::new(5.0, y));
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            ..NewPath::default()
        });
    }
    let again = read(&written(&layout, Version::V1).0);
    assert!(again.paths.iter().map(|path| path.id()).eq(&ids));
    assert_eq!(again.nodes.len(), 2 * ids.len());
    assert_same_curves(&layout, &again, "LIF");
}

#[test]
fn reverse_edge_has_the_reversed_curve() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push(
        &[(0.0, 0.0), (1.0, 2.0), (3.0, 2.0), (4.0, -1.0), (7.0, 0.0)]
            .map(|(x, y)| Point::new(x, y)),
    );
    layout.paths.push(&NewPath {
        id: "bow",
        runs: &runs,
        direction: Direction::Both,
        ..NewPath::default()
    });
    let again = read(&written(&layout, Version::V1).0);
    let (there, back) = (again.paths.get(0), again.paths.get(1));
    assert!(apart_m(there, back) < 1e-6);
    let ((start, end), (back_start, back_end)) = (there.ends().unwrap(), back.ends().unwrap());
    assert!(start.distance(back_end) < 1e-6 && end.distance(back_start) < 1e-6);
    assert!(start.distance(end) > 1.0);
}

#[test]
fn makes_names_unique_and_lists_losses() {
    let mut layout = bare();
    for _ in 0..2 {
        layout.nodes.push("N", Point::new(1.0, 1.0), None);
    }
    layout.nodes.push("N~2", Point::new(2.0, 1.0), None);
    layout.stations.push("S", None, vec![1], None);
    layout
        .stations
        .attributes
        .set(0, "kind", Value::Text("dock"));
    layout.paths.set_width_m(vec![f32::NAN, 0.5, 0.5, f32::NAN]);
    layout.refused.push("x", Code::NonFinite, "");
    let attributes = &mut layout.paths.attributes;
    attributes.set(1, "mood", Value::Int(3));
    attributes.set(0, "maxSpeed", Value::Text("fast"));
    attributes.set(2, "maxSpeed", Value::Text("1.5"));
    let (text, losses) = written(&layout, Version::V1);
    for expected in [
        ("refused paths", 1),
        ("widths", 2),
        ("column kind", 1),
        ("nodes", 1),
        ("column mood", 1),
        ("column maxSpeed", 1),
    ] {
        assert!(
            lost(&losses).contains(&expected),
            "{expected:?} in {losses:?}"
        );
    }
    let again = read(&text);
    let nodes: Vec<&str> = (0..3).map(|n| again.nodes.id(n)).collect();
    assert_eq!(nodes, ["N", "N~3", "N~2"]);
    assert_eq!(again.stations.nodes(0), [1]);
    assert_eq!(column(&again, "maxSpeed", 2), Some(Value::Float(1.5)));
}

#[test]
fn node_without_a_level_goes_to_that_of_its_path() {
    let mut layout = Layout::default();
    layout.levels.push(Level {
        id: "hall".into(),
        ..Level::default()
    });
    let (a, b) = (Point::new(0.0, 0.0), Point::new(9.0, 0.0));
    for stated in [[Some(0), None], [None, Some(0)]] {
        let mut layout = layout.clone();
        let start_node = Some(layout.nodes.push("a", a, stated[0]));
        let end_node = Some(layout.nodes.push("b", b, stated[1]));
        let mut runs = Runs::default();
        runs.push_line(a, b);
        layout.paths.push(&NewPath {
            id: "ab",
            runs: &runs,
            start_node,
            end_node,
            ..NewPath::default()
        });
        for version in VERSIONS {
            let (text, losses) = written(&layout, version);
            assert!(lost(&losses).contains(&("levels", 1)), "{losses:?}");
            assert!(losses.iter().all(|loss| loss.what != "refused paths"));
            let again = read(&text);
            assert_eq!((again.levels.len(), again.paths.len()), (1, 1), "{text}");
            assert_eq!([again.nodes.level(0), again.nodes.level(1)], [Some(0); 2]);
        }
    }
}

#[test]
fn converts_properties_between_versions() {
    let mut layout = bare();
    let attributes = &mut layout.paths.attributes;
    attributes.set(0, "rotationAllowed", Value::Bool(true));
    attributes.set(0, "vehicleOrientation", Value::Float(0.5));
    attributes.set(0, "loadRestriction.unloaded", Value::Bool(true));
    attributes.set(0, "loadRestriction.loaded", Value::Bool(false));
    attributes.set(0, "loadRestriction.loadSetNames", Value::Text("EPAL, box"));
    let second = read(&written(&layout, Version::V2).0);
    assert_eq!(second.provenance.format_version, "2.0");
    let renamed = column(&second, "reachOrientationBeforeEntering", 0);
    assert_eq!(renamed, Some(Value::Bool(false)));
    let first = read(&written(&second, Version::V1).0);
    assert_eq!(first.provenance.format_version, "1.0");
    assert_eq!(
        column(&first, "rotationAllowed", 0),
        Some(Value::Bool(true))
    );
    assert_eq!(
        column(&first, "vehicleOrientation", 0),
        Some(Value::Float(0.5))
    );
    let sets = column(&first, "loadRestriction.loadSetNames", 0);
    assert_eq!(sets, Some(Value::Json(r#"["EPAL","box"]"#)));
}

/// W19: a weighted quarter circle of three points, a straight trajectory, and a broken one, by way
/// of the other version.
#[test]
fn curves_stay_as_they_were_written() {
    let edge = |id: &str, trajectory: &str| {
        format!(
            r#"{{"edgeId": "{id}", "startNodeId": "A", "endNodeId": "B",
                "vehicleTypeEdgeProperties": [{{"vehicleTypeId": "V", "rotationAllowed": true,
                "trajectory": {trajectory}}}]}}"#
        )
    };
    let compact = |text: &str| text.replace(char::is_whitespace, "");
    let arc = &compact(
        r#"{"degree": 2, "knotVector": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0], "controlPoints": [
            {"x": 1.0, "y": 0.0, "weight": 1.0},
            {"x": 1.0, "y": 1.0, "weight": 0.7071067811865476},
            {"x": 0.0, "y": 1.0, "weight": 1.0}]}"#,
    );
    let line = &compact(
        r#"{"degree": 1, "knotVector": [0.0, 0.0, 1.0, 1.0],
            "controlPoints": [{"x": 1.0, "y": 0.0}, {"x": 0.0, "y": 1.0}]}"#,
    );
    let broken = &compact(
        r#"{"degree": 3, "knotVector": [0, 1],
            "controlPoints": [{"x": 1.5, "y": 0}, {"x": 0, "y": 1.0}], "ours": 1}"#,
    );
    let edges = [edge("arc", arc), edge("line", line), edge("broken", broken)].join(",");
    let layout = read(&format!(
        r#"{{"layouts": [{{"layoutId": "L", "layoutVersion": "1", "nodes": [
            {{"nodeId": "A", "mapId": "m", "nodePosition": {{"x": 1, "y": 0}}}},
            {{"nodeId": "B", "mapId": "m", "nodePosition": {{"x": 0, "y": 1}}}}],
            "edges": [{edges}]}}]}}"#
    ));
    let (second, _) = written(&layout, Version::V2);
    for trajectory in [arc, line, broken] {
        assert!(second.contains(trajectory), "{second}");
    }
    let (first, _) = written(&read(&second), Version::V1);
    for trajectory in [arc, line, broken] {
        assert!(first.contains(trajectory), "{first}");
    }
}

#[test]
fn curves_of_one_edge_are_one_edge_again() {
    let line = |y: u32| {
        format!(
            r#""trajectory": {{"degree": 1, "knotVector": [0, 0, 1, 1], "controlPoints":
               [{{"x": 0, "y": {y}}}, {{"x": 10, "y": {y}}}]}}"#
        )
    };
    let layout = read(&crate::lif_texts::edge_with(&format!(
        r#"{{"vehicleTypeId": "a", "maxSpeed": 1, {}}}, {{"vehicleTypeId": "b", {}}},
           {{"vehicleTypeId": "c", "maxSpeed": 3, {}}}"#,
        line(1),
        line(2),
        line(1)
    )));
    assert_eq!(layout.paths.len(), 2);
    let (text, _) = written(&layout, Version::V2);
    assert_eq!(text.matches("\"edgeId\"").count(), 1, "{text}");
    let again = read(&text);
    for (row, path) in layout.paths.iter().enumerate() {
        assert_eq!(again.paths.id(row), path.id());
        assert_eq!(types(&again, row), types(&layout, row));
        for name in types(&layout, row) {
            let speed = |of: &Layout| {
                of.paths
                    .value_for(row, name, "maxSpeed")
                    .map(|v| v.to_string())
            };
            assert_eq!(speed(&again), speed(&layout));
        }
    }
}

#[test]
fn keeps_gaps() {
    let layout = broken(Point::new(6.0, 0.0), Direction::Forward);
    let again = read(&written(&layout, Version::V1).0);
    assert_same_curves(&layout, &again, "broken");
    assert_eq!(codes(&again), [Code::KnotMultiplicity]);
}

/// A curve that a writer made takes as many control points as before, whether it is written with
/// degree 3 or, where it is straight, with degree 1.
#[test]
fn written_curves_come_back_with_as_many_control_points() {
    let bend = |i: usize| Point::new(i as f64, (i as f64 * 1.7).sin());
    let curved: Vec<_> = (0..11).map(bend).collect();
    // Single precision makes the steps uneven, as in many files.
    let even = |i: usize| Point::new(f64::from(-1131.5_f32 + 0.387_973_f32 * i as f32), 609.25);
    let straight: Vec<_> = (0..11).map(even).collect();
    let mut layout = Layout::default();
    for points in [&curved, &straight] {
        let mut runs = Runs::default();
        runs.push(points);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    for version in VERSIONS {
        let (text, _) = written(&layout, version);
        assert!(text.contains(r#""degree":1"#) && text.contains(r#""degree":3"#));
        let again = read(&text);
        assert_same_curves(&layout, &again, "control points");
        for path in again.paths.iter() {
            let lengths: Vec<usize> = path.runs().map(|run| run.len()).collect();
            assert_eq!(lengths, [11], "path {}", path.row());
        }
        assert!(again.paths.written_curves().is_empty());
    }
}

#[test]
#[should_panic(expected = "m off")]
fn comparison_detects_a_moved_curve() {
    let mut other = bare();
    other.paths = read(&written(&bare(), Version::V1).0).paths;
    let mut moved = Layout::default();
    for path in other.paths.iter() {
        let mut runs = Runs::default();
        for run in path.runs() {
            let points: Vec<_> = run.iter().map(|p| p + Point::new(0.0, 2e-4)).collect();
            runs.push(&points);
        }
        moved.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    assert_same_curves(&other, &moved, "moved");
}
