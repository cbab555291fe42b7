//! LIF structure: vehicle types, attributes, nodes, identifiers and types of fields.

use guideway_layout::{Code, Value};
use guideway_spline::Point;

use crate::common::{codes, ends, read};
use crate::lif_texts::{ARCH, edge_with};

#[test]
fn splits_an_edge_by_the_curves_of_vehicle_types() {
    let curve = format!(r#""trajectory": {{"degree": 3, {ARCH}}}"#);
    let layout = read(&edge_with(&format!(
        r#"{{"vehicleTypeId": "V1", "maxSpeed": 1.5}}, {{"vehicleTypeId": "V2", {curve}}},
           {{"vehicleTypeId": "V3", "maxSpeed": 2}}, {{"vehicleTypeId": "V4", {curve}}}"#
    )));
    let ids: Vec<&str> = layout.paths.iter().map(|p| p.id()).collect();
    assert_eq!(ids, ["E [V1, V3]", "E [V2, V4]"]);
    let types: Vec<&str> = layout.paths.vehicle_types().of(1).collect();
    assert_eq!(types, ["V2", "V4"]);
    let speed = |path, name| layout.paths.value_for(path, name, "maxSpeed");
    assert_eq!(speed(0, "V1"), Some(Value::Float(1.5)));
    assert_eq!(speed(0, "V3"), Some(Value::Float(2.0)));
    assert_eq!(layout.paths.value(1, "maxSpeed"), None);
    assert_eq!(layout.paths.value(1, "edgeId"), Some(Value::Text("E")));
    assert!(!codes(&layout).contains(&Code::Attribute));
}

#[test]
fn reads_attributes_as_columns() {
    let layout = read(&edge_with(
        r#"{"vehicleTypeId": "V", "maxSpeed": 1.5, "rotationAllowed": true, "actions": [{}, {}],
            "orientationType": "GLOBAL", "maxHeight": null,
            "loadRestriction": {"loaded": false, "loadSetNames": ["a", "b"]}}"#,
    ));
    assert!(layout.diagnostics.is_empty(), "{:?}", codes(&layout));
    let get = |name: &str| {
        let column = layout.paths.attributes.get(name);
        column.and_then(|c| c.values.get(0)).map(|v| v.to_string())
    };
    assert_eq!(get("maxSpeed").as_deref(), Some("1.5"));
    assert_eq!(get("rotationAllowed").as_deref(), Some("true"));
    assert_eq!(get("actions").as_deref(), Some("[{},{}]"));
    assert_eq!(get("orientationType").as_deref(), Some("GLOBAL"));
    assert_eq!(get("loadRestriction.loaded").as_deref(), Some("false"));
    assert_eq!(
        get("loadRestriction.loadSetNames").as_deref(),
        Some(r#"["a","b"]"#)
    );
    assert_eq!(get("maxHeight"), None);
}

#[test]
fn refuses_edges_with_unknown_nodes_and_no_trajectory() {
    let known = edge_with(r#"{"vehicleTypeId": "V"}"#);
    let layout = read(&known.replace(r#""endNodeId": "B""#, r#""endNodeId": "X""#));
    assert!(layout.paths.is_empty());
    let refused = layout.refused.iter().next().unwrap();
    assert_eq!((refused.id, refused.code), ("E", Code::UnknownNode));
    assert!(refused.detail.contains("`X`"), "{}", refused.detail);

    let curve = edge_with(&format!(r#"{{"trajectory": {{"degree": 3, {ARCH}}}}}"#));
    let layout = read(&curve.replace(r#""endNodeId": "B""#, r#""endNodeId": "X""#));
    assert_eq!(layout.paths.len(), 1);
    assert_eq!(layout.diagnostics.count(Code::UnknownNode), 1);
}

#[test]
fn resolves_repeated_ids_within_their_layout() {
    let layout = |id: &str, y: u32| {
        format!(
            r#"{{"layoutId": "{id}", "nodes": [
                {{"nodeId": "A", "nodePosition": {{"x": 0, "y": {y}}}}},
                {{"nodeId": "B", "nodePosition": {{"x": 10, "y": {y}}}}}],
              "edges": [{{"edgeId": "E{id}", "startNodeId": "A", "endNodeId": "B",
                "vehicleTypeEdgeProperties": [{{}}]}}]}}"#
        )
    };
    let layout = read(&format!(
        r#"{{"layouts": [{}, {}]}}"#,
        layout("1", 0),
        layout("2", 7)
    ));
    assert_eq!(codes(&layout), []);
    assert_eq!(ends(&layout, "E1").0.y, 0.0);
    assert_eq!(ends(&layout, "E2").0.y, 7.0);
}

#[test]
fn escapes_control_characters_in_messages() {
    let text = edge_with("{}").replace(r#""endNodeId": "B""#, r#""endNodeId": "\u001b[2J""#);
    let layout = read(&text);
    let message = &layout.diagnostics.iter().next().unwrap().message;
    assert!(message.contains(r"\u{1b}[2J"), "{message}");
}

#[test]
fn wrong_types_lose_only_their_field() {
    let text = edge_with(r#"{"vehicleTypeId": 7, "maxSpeed": "fast"}"#)
        .replace(r#""x": 10"#, r#""x": "10""#)
        .replace(r#""nodeId": "A""#, r#""nodeId": "A", "nodeName": [1]"#);
    let layout = read(&text);
    assert_eq!(codes(&layout), [Code::WrongType]);
    assert_eq!(layout.diagnostics.count(Code::WrongType), 4);
    let kept = layout.paths.value(0, "vehicleTypeOther");
    assert_eq!(kept, Some(Value::Json(r#"{"maxSpeed":"fast"}"#)));
    let kept = layout.nodes.attributes.value(0, "other");
    assert_eq!(kept, Some(Value::Json(r#"{"nodeName":[1]}"#)));
    assert_eq!(ends(&layout, "E").1, Point::new(10.0, 0.0));
    assert_eq!(layout.paths.vehicle_types().of(0).next(), Some("7"));
}

#[test]
fn reads_numbers_exactly() {
    let x = 0.333_333_333_333_333_26_f64;
    let layout = read(&edge_with("{}").replace(r#""x": 10"#, &format!(r#""x": {x:?}"#)));
    assert_eq!(layout.nodes.position_m(1).x.to_bits(), x.to_bits());
}
