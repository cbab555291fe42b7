//! Findings of `check` about files that the standards and their tools mean as they are.

use guideway_layout::{CheckOptions, Code, Diagnostics, Layout, Severity, check};
use serde_json::{Value, json};

use crate::common::{read, real, real_layouts};

fn found(layout: &Layout) -> Diagnostics {
    let mut found = check(layout, &CheckOptions::default());
    found.append(layout.diagnostics.clone());
    found
}

fn warnings(layout: &Layout) -> Vec<String> {
    let found = found(layout);
    let warnings = found.iter().filter(|d| d.severity > Severity::Info);
    let text = |d: &guideway_layout::Diagnostic| format!("{}: {}: {}", d.code, d.place, d.message);
    warnings.map(text).collect()
}

fn node(id: &str, [x, y]: [f64; 2]) -> Value {
    json!({ "nodeId": id, "nodePosition": { "x": x, "y": y },
            "vehicleTypeNodeProperties": [{ "vehicleTypeId": "amr" }] })
}

fn edge(id: &str, [start, end]: [&str; 2], properties: &Value) -> Value {
    let mut entry = json!({ "vehicleTypeId": "amr", "rotationAllowed": false });
    for (name, value) in properties.as_object().unwrap() {
        entry[name] = value.clone();
    }
    json!({ "edgeId": id, "startNodeId": start, "endNodeId": end,
            "vehicleTypeEdgeProperties": [entry] })
}

fn lif(nodes: &[Value], edges: &[Value]) -> Layout {
    let file = json!({
        "metaInformation": { "projectIdentification": "p", "creator": "c", "lifVersion": "1.0.0",
                             "exportTimestamp": "2025-01-01T00:00:00Z" },
        "layouts": [{ "layoutId": "L", "nodes": nodes, "edges": edges, "stations": [] }],
    });
    read(&file.to_string())
}

#[test]
fn rotation_edges_of_lif_are_no_finding() {
    let nodes = [
        node("A", [0.0, 0.0]),
        node("A2", [0.0, 0.0]),
        node("B", [5.0, 0.0]),
    ];
    let edges = [
        edge(
            "turn",
            ["A", "A2"],
            &json!({ "orientationType": "TANGENTIAL" }),
        ),
        edge(
            "back",
            ["A2", "A"],
            &json!({ "orientationType": "TANGENTIAL" }),
        ),
        edge("self", ["B", "B"], &json!({})),
        edge("go", ["A2", "B"], &json!({ "maxSpeed": 1.0 })),
    ];
    let layout = lif(&nodes, &edges);
    assert_eq!(layout.paths.len(), 4);
    assert_eq!(warnings(&layout), [""; 0]);
    assert_eq!(found(&layout).count(Code::SameCurve), 0);
}

#[test]
fn rotation_edges_of_an_order_are_no_finding() {
    let node = |id: &str, sequence: u64, y: f64, theta: f64| {
        json!({ "nodeId": id, "sequenceId": sequence, "released": true, "actions": [],
                "nodePosition": { "x": 0, "y": y, "mapId": "map", "theta": theta } })
    };
    let edge = |sequence: u64, start: &str, end: &str| {
        json!({ "edgeId": format!("e{sequence}"), "sequenceId": sequence, "released": true,
                "startNodeId": start, "endNodeId": end, "actions": [] })
    };
    let order = json!({
        "headerId": 1, "timestamp": "2025-01-01T00:00:00.00Z", "version": "2.0.0",
        "manufacturer": "m", "serialNumber": "s", "orderId": "o", "orderUpdateId": 0,
        "nodes": [node("A", 0, 0.0, 0.0), node("A_r", 2, 0.0, 1.57), node("B", 4, 5.0, 1.57)],
        "edges": [edge(1, "A", "A_r"), edge(3, "A_r", "B")],
    });
    let layout = read(&order.to_string());
    assert_eq!(layout.paths.len(), 2);
    assert_eq!(warnings(&layout), [""; 0]);
}

#[test]
fn lanes_that_differ_in_load_and_speed_are_no_duplicates() {
    let nodes = [node("A", [0.0, 0.0]), node("B", [5.0, 0.0])];
    let restricted = |loaded: bool, speed: f64| {
        json!({ "maxSpeed": speed,
                "loadRestriction": { "loaded": loaded, "unloaded": !loaded } })
    };
    let edges = [
        edge("full", ["A", "B"], &restricted(true, 0.5)),
        edge("empty", ["A", "B"], &restricted(false, 1.0)),
        edge("empty too", ["A", "B"], &restricted(false, 1.0)),
    ];
    let layout = lif(&nodes, &edges[..2]);
    assert_eq!(warnings(&layout), [""; 0]);
    let all = found(&layout);
    let difference = all.iter().find(|d| d.code == Code::SameCurve).unwrap();
    for part in [
        "maxSpeed: 0.5 and 1",
        "loadRestriction.loaded: true and false",
    ] {
        assert!(difference.message.contains(part), "{}", difference.message);
    }
    let layout = lif(&nodes, &edges);
    let warnings = warnings(&layout);
    let [duplicate] = warnings.as_slice() else {
        panic!("{warnings:?}");
    };
    assert!(duplicate.contains("path \"empty too\""), "{duplicate}");
    let of = "has the curve of path \"empty\"";
    assert!(duplicate.contains(of), "{duplicate}");
}

#[test]
fn hall_in_millimeters_is_implausible() {
    let nodes = [node("A", [0.0, 0.0]), node("B", [60_000.0, 40_000.0])];
    for properties in [json!({ "maxSpeed": 1.5 }), json!({})] {
        let layout = lif(&nodes, &[edge("e1", ["A", "B"], &properties)]);
        let all = found(&layout);
        let first = all.iter().next().unwrap();
        assert_eq!(
            (first.code, first.severity),
            (Code::Implausible, Severity::Warning)
        );
        assert!(
            first.message.contains("the layout is 60 km wide"),
            "{}",
            first.message
        );
    }
}

#[test]
fn examples_of_the_lif_standard_have_no_advice_to_remove_a_lane() {
    let Some(folder) = real_layouts("lif") else {
        return;
    };
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let layout = real("lif", &name).unwrap();
        let found = found(&layout);
        // Edge NB-N2 of example 16 states the nodes of edge NA-N2: a mistake of the example.
        let duplicates = found.iter().filter(|d| d.code == Code::DuplicatePath);
        let duplicates: Vec<_> = duplicates.map(|d| d.place.element.as_str()).collect();
        let is_mistaken = name.contains("example16");
        let expected = &["path \"NB-N2\""][..usize::from(is_mistaken)];
        assert_eq!(duplicates, expected, "{name}");
        assert_eq!(found.count(Code::ZeroLength), 0, "{name}");
        let different = found.iter().filter(|d| d.code == Code::SameCurve);
        for finding in different {
            assert!(
                finding.message.contains("they differ in "),
                "{name}: {}",
                finding.message
            );
        }
    }
}

#[test]
fn drawing_in_a_wrong_unit_has_one_warning_about_the_unit() {
    for file in ["ezdxf_3_us_main.dxf", "ezdxf_usa.dxf"] {
        let Some(layout) = real("dxf", file) else {
            return;
        };
        let found = found(&layout);
        assert_eq!(
            found.iter().next().unwrap().code,
            Code::Implausible,
            "{file}"
        );
        assert_eq!(found.count(Code::Implausible), 1, "{file}");
        let alike = found.count(Code::DuplicatePath) + found.count(Code::SameCurve);
        assert!(alike < 5, "{file}: {alike} paths on the same curve");
    }
}
