//! VDA 5050 orders: real files, and the differences between versions.

use crate::common::{assert_counts, codes, count, ends, read, real, real_layouts, shared};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Layout, Quantity, Severity};
use guideway_spline::Point;

/// Reference counts of another program, from the list of sources of the real layouts.
const REAL: &[(&str, &str)] = &[
    (
        "order_v1_1_nullOptionalFields.json",
        "nodes 2, edges 2, trajectories 1",
    ),
    (
        "order_v2_0_jsonSampleFull.json",
        "nodes 2, edges 1, trajectories 1",
    ),
];

/// Reads three nodes at 0, 10 and 20 m, with sequence ids 0, 2 and 4, and the given edges.
fn order(edges: &str) -> Layout {
    read(&format!(
        r#"{{"orderId": "O", "version": "3.0.0", "nodes": [
            {{"nodeId": "A", "sequenceId": 0,
             "nodePosition": {{"x": 0, "y": 0, "mapId": "hall"}}}},
            {{"nodeId": "B", "sequenceId": 2,
             "nodePosition": {{"x": 10, "y": 0, "mapId": "hall"}}}},
            {{"nodeId": "C", "sequenceId": 4,
             "nodePosition": {{"x": 20, "y": 0, "mapId": "roof"}}}}],
          "edges": [{edges}]}}"#
    ))
}

/// Reads a shared case, if it is there.
fn case(file: &str) -> Option<Layout> {
    let path = shared("cases/vda")?.join(file);
    Some(read_file(&path, &ReadOptions::default()).unwrap())
}

#[test]
fn real_files_have_the_reference_counts() {
    let Some(folder) = real_layouts("vda5050") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, expected) in REAL {
        let layout = real("vda5050", file).unwrap();
        assert_counts(&layout, &["nodes", "edges", "trajectories"], expected, file);
        assert_eq!(layout.provenance.format, "VDA 5050", "{file}");
        assert_eq!(layout.provenance.format_version, "1.1 to 2.1", "{file}");
        assert_eq!(layout.diagnostics.count(Code::Version), 1, "`version`");
        let edges = layout.path_count() as u64;
        assert_eq!(edges, count(&layout, "edges"), "{file}");
    }
}

#[test]
fn one_point_trajectory_draws_the_straight_line() {
    if let Some(layout) = real("vda5050", "order_v2_0_jsonSampleFull.json") {
        assert_eq!(layout.diagnostics.count(Code::TooFewPoints), 1);
        let (start, end) = ends(&layout, "some-edge-id");
        assert!(start.distance(Point::new(1.2, 3.4)) < 1e-12);
        assert!(end.distance(Point::new(5.6, 7.8)) < 1e-12);
        assert_eq!(layout.paths.get(0).level(), Some(0));
        assert_eq!(layout.levels[0].id, "some-map-id");
    }
}

#[test]
fn nodes_without_a_position_are_no_errors() {
    if let Some(layout) = real("vda5050", "order_v1_1_nullOptionalFields.json") {
        assert_eq!((layout.nodes.len(), layout.paths.len()), (1, 0));
        // Its edges name nodes that do not exist.
        assert!(layout.refused.iter().all(|r| r.code == Code::UnknownNode));
        assert_eq!(
            layout.diagnostics.count(Code::BadWeight),
            0,
            "a weight may be 0"
        );
    }
    if let Some(layout) = case("v12_nopos.json") {
        assert_eq!((layout.nodes.len(), layout.paths.len()), (2, 1));
        let found = &layout.diagnostics;
        assert_eq!(found.count_at_least(Severity::Warning), 0);
        assert_eq!(found.count(Code::NotDrawn), 2);
        assert_eq!(ends(&layout, "e").1, Point::new(10.0, 0.0));
        assert_eq!(layout.nodes.position_m(1), Point::new(10.0, 0.0));
    }
}

#[test]
fn version_3_0_connects_edges_by_sequence_id() {
    let layout = order(r#"{"edgeId": "E", "sequenceId": 1, "maximumSpeed": 2}"#);
    assert_eq!(codes(&layout), []);
    assert_eq!(layout.provenance.format_version, "3.0.0");
    let expected = (Point::new(0.0, 0.0), Point::new(10.0, 0.0));
    assert_eq!(ends(&layout, "E"), expected);
    let edge = layout.paths.get(0);
    assert_eq!((edge.start_node(), edge.end_node()), (Some(0), Some(1)));
}

#[test]
fn sequence_ids_connect_edges_and_names_confirm_them() {
    let edge = r#"{"edgeId": "E", "sequenceId": 1, "startNodeId": "B", "endNodeId": "B"}"#;
    let layout = order(edge);
    assert_eq!(codes(&layout), [Code::UnknownValue, Code::Version]);
    let expected = (Point::new(0.0, 0.0), Point::new(10.0, 0.0));
    assert_eq!(ends(&layout, "E"), expected);
}

#[test]
fn names_connect_edges_without_a_sequence_id() {
    let layout = order(r#"{"edgeId": "E", "startNodeId": "B", "endNodeId": "A"}"#);
    assert_eq!(codes(&layout), [Code::Version]);
    let expected = (Point::new(10.0, 0.0), Point::new(0.0, 0.0));
    assert_eq!(ends(&layout, "E"), expected);
}

#[test]
fn a_node_with_two_positions_is_found_by_its_sequence_id() {
    let Some(layout) = case("v05_same_node.json") else {
        return;
    };
    assert_eq!((layout.nodes.len(), layout.paths.len()), (3, 2));
    let nodes = |path: usize| {
        let path = layout.paths.get(path);
        (path.start_node(), path.end_node())
    };
    assert_eq!(nodes(0), (Some(0), Some(1)));
    assert_eq!(nodes(1), (Some(1), Some(2)));
    let without_sequence = read(
        r#"{"nodes": [
            {"nodeId": "1", "nodePosition": {"x": 0, "y": 0}},
            {"nodeId": "1", "nodePosition": {"x": 9, "y": 0}},
            {"nodeId": "2", "nodePosition": {"x": 9, "y": 9}}],
          "edges": [{"edgeId": "e", "startNodeId": "1", "endNodeId": "2"}]}"#,
    );
    assert_eq!(codes(&without_sequence), [Code::DuplicateId]);
}

#[test]
fn refuses_edges_between_maps() {
    let layout = order(r#"{"edgeId": "lift", "sequenceId": 3}"#);
    let refused = layout.refused.iter().next().unwrap();
    assert_eq!((refused.id, refused.code), ("lift", Code::CrossLevel));
    assert!(refused.detail.contains("`hall`") && refused.detail.contains("`roof`"));
}

#[test]
fn draws_a_trajectory_without_nodes_and_knots() {
    let layout = order(
        r#"{"edgeId": "E", "sequenceId": 7, "trajectory": {"degree": 2, "controlPoints":
            [{"x": 0, "y": 1}, {"x": 5, "y": 9}, {"x": 10, "y": 1}]}}"#,
    );
    assert_eq!(codes(&layout), [Code::MissingKnots, Code::UnknownNode]);
    let expected = (Point::new(0.0, 1.0), Point::new(10.0, 1.0));
    assert_eq!(ends(&layout, "E"), expected);
}

#[test]
fn members_of_all_versions_have_the_same_columns() {
    let layout = order(
        r#"{"edgeId": "E", "sequenceId": 1, "released": true, "maximumSpeed": 1.5,
            "orientationType": "GLOBAL", "orientation": 0.5, "actions": [{}, {}], "direction": null,
            "corridor": {"leftWidth": 0.4, "corridorReferencePoint": "KINEMATIC_CENTER"},
            "lenght": 9, "vendor": {"a": [1]}}"#,
    );
    let get = |name: &str| {
        let value = layout.paths.attributes.value(0, name);
        value.map(|v| v.to_string())
    };
    for (name, expected) in [
        ("sequenceId", "1"),
        ("released", "true"),
        ("maxSpeed", "1.5"),
        ("vehicleOrientation", "0.5"),
        ("orientationType", "GLOBAL"),
        ("actions", "[{},{}]"),
        ("length", "9"),
        ("corridor.leftWidth", "0.4"),
        ("corridor.referencePoint", "KINEMATICCENTER"),
        ("other", r#"{"vendor":{"a":[1]}}"#),
    ] {
        assert_eq!(get(name).as_deref(), Some(expected), "{name}");
    }
    assert_eq!(get("direction"), None);
    let speed = layout.paths.attributes.get("maxSpeed").unwrap();
    assert_eq!(speed.quantity, Some(Quantity::Speed));
}

#[test]
fn merges_a_node_that_is_passed_twice() {
    let layout = read(
        r#"{"nodes": [
            {"nodeId": "A", "sequenceId": 0, "nodePosition": {"x": 0, "y": 0}},
            {"nodeId": "B", "sequenceId": 2,
             "nodePosition": {"x": 10, "y": 0}},
            {"nodeId": "A", "sequenceId": 4,
             "nodePosition": {"x": 0, "y": 0}}],
          "edges": [{"edgeId": "there", "sequenceId": 1}, {"edgeId": "back", "sequenceId": 3}]}"#,
    );
    assert_eq!((layout.nodes.len(), layout.paths.len()), (2, 2));
    assert_eq!(layout.paths.get(1).end_node(), Some(0));
    assert_eq!(count(&layout, "nodes"), 3);
}
