//! Nav2 writer: the route server loads each graph, and only listed losses differ.

use crate::common::{assert_losses_are_differences, read, read_real, shared};
use guideway_formats::geojson::{WriteOptions, write_route_graph};
use guideway_formats::{Losses, Target};
use guideway_layout::{Direction, Layout, NewPath, Quantity, Value};
use guideway_spline::{Point, Runs};
use serde_json::Value as Json;
use std::collections::HashSet;

fn write(layout: &Layout) -> (String, Losses) {
    let mut bytes = Vec::new();
    let losses = write_route_graph(layout, &mut bytes, &WriteOptions::default()).unwrap();
    (String::from_utf8(bytes).unwrap(), losses)
}

/// Loads a graph by the rules of the route server. Returns the number of nodes and edges.
///
/// # Panics
/// When the route server would refuse the graph.
fn load(text: &str) -> [usize; 2] {
    let graph: Json = serde_json::from_str(text).unwrap();
    let features = graph["features"].as_array().unwrap();
    let is_node = |feature: &&Json| feature["geometry"]["type"] == "Point";
    let id = |json: &Json| u32::try_from(json.as_u64().expect("a number")).expect("32 bits");
    let mut ids = HashSet::new();
    let nodes: HashSet<u32> = features
        .iter()
        .filter(is_node)
        .map(|node| id(&node["properties"]["id"]))
        .collect();
    let mut count = [0, 0];
    for feature in features {
        let properties = &feature["properties"];
        assert!(ids.insert(id(&properties["id"])), "{feature}");
        if let Some(metadata) = properties.get("metadata") {
            assert_is_metadata(metadata);
        }
        if let Some(operations) = properties.get("operations") {
            for operation in operations.as_object().unwrap().values() {
                assert!(operation["type"].is_string() && operation["trigger"].is_string());
            }
        }
        if is_node(&feature) {
            count[0] += 1;
            continue;
        }
        count[1] += 1;
        for end in ["startid", "endid"] {
            assert!(nodes.contains(&id(&properties[end])), "{feature}");
        }
        if let Some(speed) = properties["metadata"].get("abs_speed_limit") {
            assert!(speed.is_f64(), "the route server casts {speed} to a float");
        }
    }
    count
}

fn assert_is_metadata(json: &Json) {
    let is_plain = |json: &Json| !json.is_null() && !json.is_object() && !json.is_array();
    match json {
        Json::Object(fields) => fields.values().for_each(assert_is_metadata),
        Json::Array(items) => assert!(items.iter().all(is_plain), "{json}"),
        json => assert!(is_plain(json), "{json}"),
    }
}

/// Files with nodes and edges of the graph, and the losses.
const FILES: &[(&str, [usize; 2], &[&str])] = &[
    ("layouts/nav2_geojson/aws_graph.geojson", [40, 84], &[]),
    ("layouts/nav2_geojson/no_frame.json", [40, 84], &[]),
    ("layouts/nav2_geojson/sample_graph.geojson", [9, 24], &[]),
    (
        "layouts/nav2_geojson/turtlebot3_graph.geojson",
        [20, 65],
        &[],
    ),
    (
        "layouts/nav2_geojson/warehouse_graph.geojson",
        [96, 172],
        &[],
    ),
    ("conformance/real/nav2_tb3.geojson", [20, 65], &[]),
    ("cases/geojson/g05_nav2_dups.geojson", [3, 4], &["paths"]),
    ("cases/geojson/g05b_nav2_curve.geojson", [2, 1], &[]),
    ("cases/geojson/g05c_nav2_stringids.geojson", [2, 1], &[]),
    ("cases/geojson/g11b_nav2_bigids.geojson", [2, 1], &[]),
    (
        "layouts/rmf_building/office.building.yaml",
        [37, 60],
        &[
            "nodes",
            "paths",
            "directions",
            "vehicle types",
            "levels",
            "layout properties",
        ],
    ),
    (
        "conformance/real/eiu_nav_graph.yaml",
        [7, 14],
        &["paths", "levels", "layout properties"],
    ),
];

#[test]
fn the_route_server_loads_real_files() {
    let Some(folder) = shared("") else {
        return;
    };
    for (file, expected, lost) in FILES {
        let layout = read_real(&folder.join(file));
        let (text, losses) = write(&layout);
        assert_eq!(load(&text), *expected, "{file}");
        let again = read(&text);
        assert_losses_are_differences(&layout, &again, &losses, file);
        let whats: HashSet<_> = losses.iter().map(|loss| loss.what.as_str()).collect();
        assert_eq!(whats, lost.iter().copied().collect(), "{file}");
        assert_eq!(Target::of_source(&again), Some(Target::Nav2), "{file}");
    }
}

fn two_nodes(ids: [&str; 2]) -> Layout {
    let mut layout = Layout::default();
    for (id, x) in ids.into_iter().zip([0.0, 5.0]) {
        layout.nodes.push(id, Point::new(x, 0.0), None);
    }
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(5.0, 0.0));
    layout.paths.push(&NewPath {
        id: "1",
        runs: &runs,
        start_node: Some(0),
        end_node: Some(1),
        direction: Direction::Both,
        ..NewPath::default()
    });
    layout
}

#[test]
fn identifiers_are_numbers_and_the_original_ones_come_back() {
    for ids in [["a", "b"], ["0", "0"], ["1", "4294967296"], ["007", ""]] {
        let mut layout = two_nodes(ids);
        layout.paths.set_direction(0, Direction::Forward);
        let (text, losses) = write(&layout);
        assert_eq!(load(&text), [2, 1], "{ids:?}");
        assert!(losses.is_empty(), "{losses:?}");
        assert_losses_are_differences(&layout, &read(&text), &losses, "numbers");
    }
}

#[test]
fn a_two_way_path_is_two_edges() {
    let layout = two_nodes(["a", "b"]);
    let (text, losses) = write(&layout);
    assert_eq!(load(&text), [2, 2]);
    let whats: Vec<_> = losses.iter().map(|loss| loss.what.as_str()).collect();
    assert_eq!(whats, ["directions"]);
    let again = read(&text);
    assert_losses_are_differences(&layout, &again, &losses, "two edges");
    let reverse = again.paths.get(1);
    assert_eq!(reverse.id(), "1~2");
    assert_eq!(
        (reverse.start_node(), reverse.end_node()),
        (Some(1), Some(0))
    );
    let (start, end) = reverse.ends().unwrap();
    assert!(start.x == 5.0 && end.x == 0.0);
}

#[test]
fn columns_are_metadata_that_the_route_server_reads() {
    let mut layout = two_nodes(["0", "2"]);
    layout.paths.set_direction(0, Direction::Forward);
    let attributes = &mut layout.paths.attributes;
    attributes.set_quantity(0, "maxSpeed", 2.0, Quantity::Speed);
    attributes.set(0, "cost", Value::Int(7));
    attributes.set(0, "tags", Value::Json(r#"["a",1]"#));
    attributes.set(0, "actions", Value::Json(r#"[{"type": "lift"}]"#));
    attributes.set(0, "startid", Value::Int(3));
    attributes.set(0, "nan", Value::Float(f64::NAN));
    let (text, losses) = write(&layout);
    load(&text);
    let edge = &serde_json::from_str::<Json>(&text).unwrap()["features"][2]["properties"];
    assert_eq!(edge["metadata"]["abs_speed_limit"], 2.0);
    assert_eq!(edge["cost"], 7);
    let whats: HashSet<_> = losses.iter().map(|loss| loss.what.as_str()).collect();
    let expected = ["column actions", "column startid", "column nan"];
    assert_eq!(whats, expected.into());
    assert_losses_are_differences(&layout, &read(&text), &losses, "columns");
}

#[test]
fn a_graph_without_edges_keeps_its_identifiers() {
    let mut layout = Layout::default();
    layout.nodes.push("dock", Point::new(1.0, 2.0), None);
    layout
        .nodes
        .attributes
        .set(0, "name", Value::Text("Dock 1"));
    let (text, losses) = write(&layout);
    assert_losses_are_differences(&layout, &read(&text), &losses, "no edges");
}
