//! Checks of written VDA 5050 orders: nothing of an order is lost, other layouts follow the schema.

use std::time::SystemTime;

use crate::common::{read, shared};
use guideway_formats::vda5050::{Version, WriteOptions, write_layout};
use guideway_formats::{Losses, ReadOptions, WriteProblem, read_file};
use guideway_layout::{CompareOptions, Direction, Layout, Level, NewPath, Value, differences};
use guideway_spline::{Point, Runs};
use serde_json::Value as Json;

fn try_write(layout: &Layout, version: Version) -> Result<(String, Losses), WriteProblem> {
    let mut text = Vec::new();
    let exported = SystemTime::UNIX_EPOCH;
    let losses = write_layout(layout, &mut text, &WriteOptions { version, exported })?;
    Ok((String::from_utf8(text).unwrap(), losses))
}

fn whats(losses: &Losses) -> Vec<&str> {
    losses.iter().map(|loss| loss.what.as_str()).collect()
}

/// Returns whether an object has all required members of a list.
fn has_all(object: &Json, names: &[&str]) -> bool {
    names.iter().all(|name| !object[*name].is_null())
}

/// Checks what the schemas of both versions require.
fn assert_valid(text: &str, version: Version) {
    let order: Json = serde_json::from_str(text).unwrap();
    let header = [
        "headerId",
        "timestamp",
        "version",
        "manufacturer",
        "serialNumber",
        "orderId",
        "orderUpdateId",
    ];
    assert!(has_all(&order, &header), "{text}");
    let common = ["sequenceId", "released", "actions"];
    let [nodes, edges] = ["nodes", "edges"].map(|name| order[name].as_array().unwrap());
    assert_eq!(nodes.len(), edges.len() + 1);
    for (i, node) in nodes.iter().enumerate() {
        assert!(
            has_all(node, &common) && has_all(node, &["nodeId"]),
            "{node}"
        );
        assert_eq!(node["sequenceId"], 2 * i);
        let position = &node["nodePosition"];
        assert!(has_all(position, &["x", "y", "mapId"]), "{node}");
        let theta = position["theta"].as_f64().unwrap_or(0.0);
        assert!(theta.abs() <= std::f64::consts::PI, "{node}");
    }
    for (i, edge) in edges.iter().enumerate() {
        assert!(
            has_all(edge, &common) && has_all(edge, &["edgeId"]),
            "{edge}"
        );
        assert_eq!(edge["sequenceId"], 2 * i + 1);
        let names_nodes = has_all(edge, &["startNodeId", "endNodeId"]);
        assert_eq!(names_nodes, version == Version::V2, "{edge}");
        for action in edge["actions"].as_array().unwrap() {
            let required = ["actionType", "actionId", "blockingType"];
            assert!(has_all(action, &required), "{action}");
        }
        let curve = &edge["trajectory"];
        let knots = curve["knotVector"].as_array().into_iter().flatten();
        let mut knots = knots.map(|knot| knot.as_f64().unwrap());
        assert!(knots.all(|knot| (0.0..=1.0).contains(&knot)), "{edge}");
    }
}

/// A layout of three nodes and two paths from one to the next.
fn route() -> Layout {
    let mut layout = Layout::default();
    for (i, name) in ["A", "B", "C"].into_iter().enumerate() {
        let position = Point::new(10.0 * i as f64, 0.0);
        layout.nodes.push(name, position, None);
    }
    for (i, id) in ["ab", "bc"].into_iter().enumerate() {
        let mut runs = Runs::default();
        let from = Point::new(10.0 * i as f64, 0.0);
        runs.push_line(from, from + Point::new(10.0, 0.0));
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(i as u32),
            end_node: Some(i as u32 + 1),
            ..NewPath::default()
        });
    }
    layout
}

#[test]
fn orders_are_kept_whole() {
    let mut files = Vec::new();
    for folder in ["cases/vda", "layouts/vda5050"]
        .into_iter()
        .filter_map(shared)
    {
        files.extend(
            folder
                .read_dir()
                .unwrap()
                .map(|entry| entry.unwrap().path()),
        );
    }
    let mut kept = 0;
    for file in files {
        let Ok(layout) = read_file(&file, &ReadOptions::default()) else {
            continue;
        };
        let Some(version) = Version::of_layout(&layout) else {
            continue;
        };
        // Orders with a gap, such as an edge between maps, are no route.
        let Ok((text, losses)) = try_write(&layout, version) else {
            continue;
        };
        let again = read(&text);
        let found = differences(&layout, &again, &CompareOptions::default());
        let lost = found.iter().map(|difference| difference.what.as_str());
        let unlisted: Vec<&str> = lost.filter(|what| !whats(&losses).contains(what)).collect();
        assert!(unlisted.is_empty(), "{}: {found:?}", file.display());
        kept += usize::from(losses.is_empty());
    }
    if shared("cases/vda").is_some() {
        assert!(kept >= 8, "{kept} orders without losses");
    }
}

#[test]
fn passes_of_a_node_are_kept() {
    let text = r#"{"orderId": "O", "version": "2.1.0", "nodes": [
        {"nodeId": "A", "sequenceId": 4, "released": true, "actions": [],
         "nodePosition": {"x": 0, "y": 0, "mapId": "m", "theta": 1}},
        {"nodeId": "B", "sequenceId": 6, "released": true, "actions": [],
         "nodePosition": {"x": 9, "y": 0, "mapId": "m"}},
        {"nodeId": "A", "sequenceId": 8, "released": false, "actions": [{"actionType": "drop",
         "actionId": "1", "blockingType": "HARD"}],
         "nodePosition": {"x": 0, "y": 0, "mapId": "m", "theta": 2}}],
      "edges": [{"edgeId": "there", "sequenceId": 5, "released": true, "startNodeId": "A",
         "endNodeId": "B", "actions": []},
        {"edgeId": "back", "sequenceId": 7, "released": false, "startNodeId": "B",
         "endNodeId": "A", "actions": [], "vendor": 1}]}"#;
    let layout = read(text);
    let (written, losses) = try_write(&layout, Version::V2).unwrap();
    assert!(losses.is_empty(), "{losses:?}");
    let order: Json = serde_json::from_str(&written).unwrap();
    assert_eq!(order["nodes"][2]["nodePosition"]["theta"], 2);
    assert_eq!(order["nodes"][2]["actions"][0]["actionType"], "drop");
    assert_eq!(order["nodes"][2]["sequenceId"], 8);
    assert_eq!(order["edges"][1]["vendor"], 1);
    let found = differences(&layout, &read(&written), &CompareOptions::default());
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn other_layouts_follow_the_schema() {
    let mut layout = route();
    let attributes = &mut layout.paths.attributes;
    attributes.set(0, "maxSpeed", Value::Float(1.5));
    attributes.set(0, "corridor.leftWidth", Value::Float(0.5));
    attributes.set(1, "vehicleOrientation", Value::Float(4.0));
    let actions = r#"[{"actionType":"beep","blockingType":"NONE"}]"#;
    attributes.set(1, "actions", Value::Json(actions));
    layout
        .nodes
        .attributes
        .set(2, "theta", Value::Float(std::f64::consts::PI));
    for (version, speed) in [(Version::V2, "maxSpeed"), (Version::V3, "maximumSpeed")] {
        let (text, losses) = try_write(&layout, version).unwrap();
        assert_valid(&text, version);
        let expected = [
            "levels",
            "levels",
            "column vehicleOrientation",
            "column actions",
        ];
        assert_eq!(whats(&losses), expected);
        let order: Json = serde_json::from_str(&text).unwrap();
        assert_eq!(order["edges"][0][speed], 1.5);
        assert_eq!(order["edges"][0]["corridor"]["rightWidth"], 0.0);
        let turned = order["edges"][1]["orientation"].as_f64().unwrap();
        assert!((turned - (4.0 - std::f64::consts::TAU)).abs() < 1e-12);
    }
}

#[test]
fn paths_with_a_gap_are_no_route() {
    let mut layout = route();
    layout.retain_paths(&[1, 0]);
    let problem = try_write(&layout, Version::V2).unwrap_err();
    let expected = "an order holds one route, but path `bc` ends at the node `C`, but the next \
                    path `ab` begins at the node `A`";
    assert_eq!(problem.to_string(), expected);
    // Their places in the order put them right.
    for (row, number) in [(0, 7), (1, 5)] {
        let value = Value::Int(number);
        layout.paths.attributes.set(row, "sequenceId", value);
    }
    let (text, _) = try_write(&layout, Version::V2).unwrap();
    assert!(text.find("\"ab\"").unwrap() < text.find("\"bc\"").unwrap());
}

#[test]
fn two_way_paths_lose_a_direction() {
    let mut layout = route();
    layout.paths.set_direction(1, Direction::Both);
    let (_, losses) = try_write(&layout, Version::V3).unwrap();
    assert_eq!(whats(&losses), ["directions", "levels", "levels"]);
}

#[test]
fn a_node_that_is_passed_again_stays_on_its_map() {
    let mut layout = Layout::default();
    for level in ["ground", "first"] {
        layout.levels.push(Level {
            id: level.into(),
            ..Level::default()
        });
    }
    for (id, x) in [("A", 0.0), ("B", 10.0)] {
        layout.nodes.push(id, Point::new(x, 0.0), None);
    }
    // Without levels of their own, the nodes have those of the paths around them.
    for (id, [from, to], level) in [("there", [0, 1], 0), ("back", [1, 0], 1)] {
        let mut runs = Runs::default();
        let [start, end] = [from, to].map(|node| layout.nodes.position_m(node));
        runs.push_line(start, end);
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(from),
            end_node: Some(to),
            level: Some(level),
            ..NewPath::default()
        });
    }
    for version in [Version::V2, Version::V3] {
        let (text, _) = try_write(&layout, version).unwrap();
        let order: Json = serde_json::from_str(&text).unwrap();
        let maps = [0, 1, 2].map(|i| order["nodes"][i]["nodePosition"]["mapId"].as_str());
        assert_eq!(maps, [Some("ground"), Some("first"), Some("ground")]);
        assert_eq!(read(&text).nodes.len(), 2);
    }
}
