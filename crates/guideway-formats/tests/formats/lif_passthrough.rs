//! LIF passthrough: a write to the same version keeps the members that the model does not hold.

use std::fs;
use std::time::SystemTime;

use crate::common::real_layouts;
use guideway_formats::lif::{Version, WriteOptions, write_layout};
use guideway_formats::{ReadOptions, read_bytes, read_file};
use guideway_layout::Layout;
use guideway_spline::Affine;
use serde_json::{Value, json};

fn written(layout: &Layout, version: Version) -> Value {
    let mut out = Vec::new();
    let exported = SystemTime::UNIX_EPOCH;
    write_layout(layout, &mut out, &WriteOptions { version, exported }).unwrap();
    serde_json::from_slice(&out).unwrap()
}

fn read(file: &Value) -> Layout {
    let text = file.to_string();
    read_bytes("site.json", text.as_bytes(), &ReadOptions::default()).unwrap()
}

/// Two nodes and an edge between them, for two vehicle types of different speed.
fn site() -> Value {
    let action =
        json!({ "actionType": "pick", "requirementType": "REQUIRED", "blockingType": "HARD" });
    let node = |id: &str, x: f64| {
        json!({
            "nodeId": id, "nodeDescription": "by the gate", "mapId": "m",
            "nodePosition": { "x": x, "y": 0.0 },
            "vehicleTypeNodeProperties": [
                { "vehicleTypeId": "a", "theta": 1.5, "actions": [action] },
                { "vehicleTypeId": "c" },
            ],
        })
    };
    let line = json!({
        "degree": 1, "knotVector": [0.0, 0.0, 1.0, 1.0],
        "controlPoints": [{ "x": 0.5, "y": 0.0 }, { "x": 4.0, "y": 0.0 }],
    });
    json!({
        "metaInformation": {
            "projectIdentification": "our site", "creator": "us",
            "exportTimestamp": "2026-01-01T00:00:00Z", "lifVersion": "1.0.0",
        },
        "ours": { "mark": 7 },
        "layouts": [{
            "layoutId": "hall", "layoutVersion": "12", "layoutDescription": "the hall",
            "nodes": [node("n1", 0.0), node("n2", 4.0)],
            "edges": [{
                "edgeId": "e", "edgeDescription": "to the gate",
                "startNodeId": "n1", "endNodeId": "n2",
                "vehicleTypeEdgeProperties": [
                    {
                        "vehicleTypeId": "a", "maxSpeed": 1.0, "actions": [action],
                        "trajectory": line,
                    },
                    { "vehicleTypeId": "b", "maxSpeed": 2.0, "trajectory": line },
                ],
            }],
            "stations": [{
                "stationId": "s", "interactionNodeIds": ["n1"], "stationDescription": "racks",
                "stationPosition": { "x": 1.0, "y": 2.0, "theta": 3.0 },
            }],
        }],
    })
}

/// Collects the places where a written file lacks a value of its source, or has another one.
fn differences(before: &Value, after: &Value, place: &str, found: &mut Vec<String>) {
    match (before, after) {
        (Value::Object(before), Value::Object(after)) => {
            for (key, value) in before {
                let place = format!("{place}.{key}");
                match after.get(key) {
                    Some(other) => differences(value, other, &place, found),
                    None => found.push(place),
                }
            }
        }
        (Value::Array(before), Value::Array(after)) if before.len() == after.len() => {
            for (before, after) in before.iter().zip(after) {
                differences(before, after, &format!("{place}[]"), found);
            }
        }
        (Value::Number(before), Value::Number(after)) if before.as_f64() == after.as_f64() => {}
        (before, after) if before == after => {}
        _ => found.push(place.to_owned()),
    }
}

/// Returns whether the writer replaces the value at a place.
fn is_replaced(place: &str) -> bool {
    place.starts_with(".metaInformation.")
        && !place.ends_with("Identification")
        && !place.ends_with("lifId")
}

#[test]
fn passes_unmodeled_members_through() {
    let before = site();
    let mut found = Vec::new();
    differences(
        &before,
        &written(&read(&before), Version::V1),
        "",
        &mut found,
    );
    found.retain(|place| !is_replaced(place));
    // The writer adds vehicle types of edges to their nodes, and writes curves with new knots.
    found.retain(|place| {
        !place.ends_with("vehicleTypeNodeProperties") && !place.contains(".trajectory")
    });
    assert_eq!(found, <[&str; 0]>::default());
    differences(&before, &json!({ "ours": {} }), "", &mut found);
    assert!(found.contains(&".ours.mark".to_owned()) && found.contains(&".layouts".to_owned()));
}

#[test]
fn writes_changed_positions_and_curves() {
    let mut layout = read(&site());
    let up = Affine::translation(guideway_spline::Point::new(0.0, 5.0));
    layout.transform(up);
    let after = written(&layout, Version::V1);
    let hall = &after["layouts"][0];
    let node = &hall["nodes"][0];
    assert_eq!(node["nodePosition"], json!({ "x": 0.0, "y": 5.0 }));
    let types: Vec<_> = node["vehicleTypeNodeProperties"]
        .as_array()
        .unwrap()
        .iter()
        .collect();
    let names: Vec<_> = types
        .iter()
        .map(|t| t["vehicleTypeId"].as_str().unwrap())
        .collect();
    assert_eq!(
        (names, types[0]["theta"].as_f64()),
        (vec!["a", "c", "b"], Some(1.5))
    );
    let place = &hall["stations"][0]["stationPosition"];
    assert_eq!(*place, json!({ "x": 1.0, "y": 7.0, "theta": 3.0 }));
    let entries = &hall["edges"][0]["vehicleTypeEdgeProperties"];
    for (i, speed) in [1.0, 2.0].into_iter().enumerate() {
        assert_eq!(entries[i]["maxSpeed"].as_f64(), Some(speed));
        assert_eq!(
            entries[i]["trajectory"]["controlPoints"][0]["y"].as_f64(),
            Some(5.0)
        );
    }
    // No passthrough without the text, and none to another version.
    assert!(read(&after).provenance.text.is_some());
    layout.provenance.text = None;
    assert_eq!(written(&layout, Version::V1)["ours"], Value::Null);
    assert_eq!(written(&read(&site()), Version::V2)["ours"], Value::Null);
}

#[test]
fn keeps_entries_of_vehicle_types_with_their_curves() {
    let mut file = site();
    let edge = &mut file["layouts"][0]["edges"][0]["vehicleTypeEdgeProperties"];
    edge[1].as_object_mut().unwrap().remove("trajectory");
    let after = written(&read(&file), Version::V1);
    let edges = after["layouts"][0]["edges"].as_array().unwrap();
    let ids: Vec<_> = edges
        .iter()
        .map(|edge| edge["edgeId"].as_str().unwrap())
        .collect();
    assert_eq!(ids, ["e [a]", "e [b]"]);
    for (edge, speed) in edges.iter().zip([1.0, 2.0]) {
        assert_eq!(edge["edgeDescription"], "to the gate");
        let entries = edge["vehicleTypeEdgeProperties"].as_array().unwrap();
        assert_eq!(entries.len(), 1);
        assert_eq!(entries[0]["maxSpeed"].as_f64(), Some(speed));
    }
}

#[test]
fn keeps_repeated_entries_of_a_vehicle_type() {
    let mut file = site();
    let entries = &mut file["layouts"][0]["edges"][0]["vehicleTypeEdgeProperties"];
    entries[1]["vehicleTypeId"] = "a".into();
    let layout = read(&file);
    let types: Vec<&str> = layout.paths.vehicle_types().of(0).collect();
    assert_eq!(types, ["a"]);
    let again = written(&layout, Version::V1);
    let again = &again["layouts"][0]["edges"][0]["vehicleTypeEdgeProperties"];
    let speeds = |entries: &Value| -> Vec<Value> {
        let entries = entries.as_array().unwrap().iter();
        entries.map(|entry| entry["maxSpeed"].clone()).collect()
    };
    assert_eq!(speeds(again), [1.0, 2.0]);
}

#[test]
fn real_files_pass_through_completely() {
    let Some(folder) = real_layouts("lif") else {
        return;
    };
    let mut files = 0;
    for file in fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let before: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let layout = read_file(&path, &ReadOptions::default()).unwrap();
        let version = match layout.provenance.format_version.as_str() {
            "1.0" => Version::V1,
            _ => Version::V2,
        };
        let mut found = Vec::new();
        differences(&before, &written(&layout, version), "", &mut found);
        found.retain(|place| !is_replaced(place) && !place.contains(".trajectory"));
        found.retain(|place| !place.ends_with("TypeNodeProperties"));
        assert_eq!(found, <[&str; 0]>::default(), "{}", path.display());
        files += 1;
    }
    assert!(files > 10);
}
