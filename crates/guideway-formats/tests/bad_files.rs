//! Bad files have the outcome stated in their table, and no file causes a panic.
//!
//! Files and tables are those of `guideway_bad_files`. Names with the prefix `generated:` refer to
//! `hostile`.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod hostile;
mod outcome;

use std::fs;

use guideway_bad_files::{folder, inputs};
use guideway_layout::Severity;
use serde_json::Value;

use outcome::{check, check_any, check_error, read};

/// The bytes of a stored file, named by format and name.
fn bad_file(path: &str) -> Vec<u8> {
    guideway_bad_files::input(path).unwrap()
}

fn bad_text(path: &str) -> String {
    String::from_utf8(bad_file(path)).unwrap()
}

/// Checks each line of the table of a format, and that each stored file has a line.
fn check_format(format: &str) {
    let table = fs::read_to_string(folder(format).join("expect.tsv")).unwrap();
    let lines: Vec<(&str, &str)> = table.lines().filter_map(|l| l.split_once('\t')).collect();
    let archive = inputs(format).unwrap();
    let mut failures = Vec::new();
    for &(name, expected) in &lines {
        let bytes = match name.strip_prefix("generated:") {
            Some(recipe) => hostile::generate(format, recipe).expect(name),
            None => archive.get(name).expect(name).to_vec(),
        };
        failures.extend(check(name, &bytes, expected).err().map(|f| f.to_string()));
    }
    for (name, _) in archive.iter() {
        if !lines.iter().any(|(listed, _)| *listed == name) {
            failures.push(format!("{name}: not in the table"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn bad_lif_files() {
    check_format("lif");
}

#[test]
fn bad_open_tcs_files() {
    check_format("opentcs");
}

#[test]
fn bad_vda_5050_files() {
    check_format("vda5050");
}

#[test]
fn bad_dxf_files() {
    check_format("dxf");
}

#[test]
fn bad_geojson_files() {
    check_format("geojson");
}

#[test]
fn bad_rmf_files() {
    check_format("rmf");
}

#[test]
fn bad_svg_files() {
    check_format("svg");
}

#[test]
fn bad_opendrive_files() {
    check_format("opendrive");
}

#[test]
fn bad_lanelet2_files() {
    check_format("lanelet2");
}

#[test]
fn bad_files_of_any_kind() {
    check_format("any");
}

#[test]
fn check_detects_wrong_expectations() {
    let file = b"{\"layouts\": []}";
    assert_eq!(check("right", file, "ok"), Ok(()));
    for wrong in ["ok version", "error syntax", "error", "okay", ""] {
        assert!(check("wrong", file, wrong).is_err(), "{wrong}");
    }
    assert!(check("wrong", b"{", "error syntax").is_err());
    assert!(check("wrong", b"{", "ok").is_err());
}

/// Valid files.
const VALID: [&str; 12] = [
    "dxf/valid.dxf",
    "dxf/valid-binary.dxf",
    "dxf/valid-narrow.dxf",
    "geojson/valid.geojson",
    "geojson/valid-graph.geojson",
    "lanelet2/valid.osm",
    "lif/valid.json",
    "opendrive/valid.xodr",
    "opentcs/valid.xml",
    "svg/valid.svg",
    "vda5050/valid.json",
    "vda5050/valid-3.json",
];

/// A text cut at any byte is an error.
#[test]
fn rejects_every_truncation() {
    for file in VALID {
        let whole = bad_file(file);
        let content = whole.trim_ascii_end().len();
        for length in 0..content {
            let error = match read(file, &whole[..length]).unwrap() {
                // A drawing is read up to the cut, and says that it is cut.
                Ok(layout) if file.starts_with("dxf/") => {
                    assert!(layout.diagnostics.count_at_least(Severity::Error) > 0);
                    continue;
                }
                Ok(_) => panic!("{file} can be read from {length} bytes"),
                Err(error) => error,
            };
            check_error(file, &error).unwrap();
            let codes = ["empty", "truncated", "unknown-format"];
            assert!(codes.contains(&error.code()), "{file} at {length}: {error}");
        }
        check(file, &whole[..content], "ok").unwrap();
    }
}

/// A truncated YAML text may be valid.
const VALID_YAML: [&str; 2] = ["rmf/valid.yaml", "rmf/valid-graph.yaml"];

#[test]
fn truncated_yaml_does_not_panic() {
    for file in VALID_YAML {
        let whole = bad_file(file);
        for length in 0..whole.len() {
            check_any(file, &whole[..length]);
        }
    }
}

/// Replaces each byte of a file by several others.
#[test]
fn single_byte_changes_do_not_panic() {
    for file in VALID.into_iter().chain(VALID_YAML) {
        let whole = bad_file(file);
        for at in 0..whole.len() {
            for byte in [
                0, b'"', b'<', b'&', b'-', b'9', b'{', b']', b'*', b' ', 0x80, 0xFF,
            ] {
                let mut bytes = whole.clone();
                bytes[at] = byte;
                check_any(file, &bytes);
            }
        }
    }
}

/// A LIF file with every field that the reader uses.
const EVERY_FIELD: &str = r#"{
  "metaInformation": {"lifVersion": "1.0.0"},
  "layouts": [{"layoutId": "L", "layoutName": "Hall", "nodes": [
      {"nodeId": "A", "nodeName": "a", "mapId": "m", "nodePosition": {"x": 0, "y": 0}},
      {"nodeId": "B", "nodePosition": {"x": 10, "y": 0}}],
    "edges": [{"edgeId": "E", "startNodeId": "A", "endNodeId": "B", "vehicleTypeEdgeProperties": [
      {"vehicleTypeId": "V", "maxSpeed": 1, "rotationAllowed": true, "actions": [{}],
       "loadRestriction": {"loaded": true, "loadSetNames": ["s"]},
       "trajectory": {"degree": 1, "knotVector": [0, 0, 1, 1],
         "controlPoints": [{"x": 0, "y": 0, "weight": 1}, {"x": 10, "y": 0}]}}]}],
    "stations": [{"stationId": "S", "interactionNodeIds": ["A"], "stationName": "s",
      "stationHeight": 1, "stationPosition": {"x": 0, "y": 0}}]}],
  "origins": [{"layouts": [{"layoutId": "M", "nodes": [], "edges": [{"edgeId": "F",
      "startNodeId": "A", "endNodeId": "B", "mobileRobotTypeEdgeProperties": [
      {"mobileRobotTypes": [{"manufacturer": "m", "seriesName": "s"}],
       "corridor": {"maximumLeftWidth": 1}}]}]}]}]
}"#;

#[test]
fn fields_of_other_types_do_not_panic() {
    change_every_field(EVERY_FIELD, 60);
    for (file, fields) in [
        ("vda5050/valid.json", 50),
        ("geojson/valid.geojson", 20),
        ("geojson/valid-graph.geojson", 30),
    ] {
        change_every_field(&bad_text(file), fields);
    }
}

/// Replaces each value of a JSON text by values of other types; the text has more than `min`
/// values.
fn change_every_field(text: &str, min: usize) {
    let whole: Value = serde_json::from_str(text).unwrap();
    let mut pointers = Vec::new();
    collect_pointers(&whole, String::new(), &mut pointers);
    assert!(pointers.len() > min);
    let others = [
        "null",
        "true",
        "-7",
        "1e300",
        "\"x\"",
        "\"\"",
        "[]",
        "[[1]]",
        "{}",
        "{\"x\":{}}",
    ];
    for pointer in &pointers {
        for other in others {
            let mut changed = whole.clone();
            *changed.pointer_mut(pointer).unwrap() = serde_json::from_str(other).unwrap();
            check_any(pointer, changed.to_string().as_bytes());
        }
    }
}

/// Collects the JSON pointers of all nested values.
fn collect_pointers(value: &Value, at: String, all: &mut Vec<String>) {
    let children: Vec<(String, &Value)> = match value {
        Value::Object(fields) => fields.iter().map(|(k, v)| (k.clone(), v)).collect(),
        Value::Array(items) => items
            .iter()
            .enumerate()
            .map(|(i, v)| (i.to_string(), v))
            .collect(),
        _ => Vec::new(),
    };
    for (key, child) in children {
        collect_pointers(child, format!("{at}/{key}"), all);
    }
    if !at.is_empty() {
        all.push(at);
    }
}

#[test]
fn attributes_of_other_values_do_not_panic() {
    for file in [
        "opentcs/valid.xml",
        "svg/valid.svg",
        "opendrive/valid.xodr",
        "lanelet2/valid.osm",
    ] {
        let whole = bad_text(file);
        change_every_attribute(&whole);
    }
}

fn change_every_attribute(whole: &str) {
    let quotes: Vec<usize> = whole.match_indices(['"', '\'']).map(|(at, _)| at).collect();
    assert!(quotes.len() > 30);
    for ends in quotes.chunks_exact(2) {
        for other in [
            "",
            "x",
            "NaN",
            "-1",
            "1e999",
            "0",
            "9223372036854775808",
            "A",
            "&amp;",
        ] {
            let changed = [&whole[..=ends[0]], other, &whole[ends[1]..]].concat();
            check_any("changed", changed.as_bytes());
        }
    }
}
