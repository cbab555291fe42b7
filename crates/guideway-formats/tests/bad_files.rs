//! Bad files: each has an outcome in the table beside it, and none may end in a panic.
//!
//! A line of `bad/*/expect.tsv` is a file, a tab, and either `error` with the code of the error, or `ok`
//! with the codes of all findings, if any. Files whose name begins with `generated:` are made here.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

mod hostile;

use std::collections::BTreeSet;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use guideway_formats::{ReadError, ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Code, Layout, Severity};
use serde_json::Value;

/// Reads bytes; a panic is the error.
fn read(name: &str, bytes: &[u8]) -> Result<Result<Layout, ReadError>, String> {
    let read = || read_bytes(name, bytes, &ReadOptions::default());
    catch_unwind(AssertUnwindSafe(read)).map_err(|_| format!("{name}: the reader panicked"))
}

/// Reads bytes and compares the outcome with the one expected.
fn check(name: &str, bytes: &[u8], expected: &str) -> Result<(), String> {
    let result = read(name, bytes)?;
    let outcome = match &result {
        Ok(layout) => {
            check_layout(name, layout)?;
            format!("ok {}", codes(layout).join(","))
        }
        Err(error) => {
            check_error(name, error)?;
            format!("error {}", error.code())
        }
    };
    if outcome.trim() == expected {
        return Ok(());
    }
    let said = match result {
        Ok(layout) => layout
            .diagnostics
            .iter()
            .map(|d| format!("\n  {}: {}", d.place, d.message))
            .collect(),
        Err(error) => format!("\n  {error}"),
    };
    Err(format!(
        "{name}: `{expected}` expected, `{}` found{said}",
        outcome.trim()
    ))
}

/// What reading finds, and what checking the layout warns of.
fn codes(layout: &Layout) -> Vec<&'static str> {
    let checked = guideway_layout::check(layout, &CheckOptions::default());
    let warned = checked
        .counts()
        .map(|(code, _)| code)
        .filter(|c| c.severity() > Severity::Info);
    let found = layout.diagnostics.counts().map(|(code, _)| code);
    let all: BTreeSet<Code> = found.chain(warned).collect();
    all.into_iter().map(Code::name).collect()
}

/// An error names the file, says something, and says what to do.
fn check_error(name: &str, error: &ReadError) -> Result<(), String> {
    let (text, remedy) = (error.to_string(), error.remedy());
    let sound = text.contains(name)
        && text.len() > name.len() + remedy.len() + 10
        && !remedy.is_empty()
        && text.contains(&remedy)
        && !text.contains('\0');
    sound
        .then_some(())
        .ok_or_else(|| format!("{name}: a poor error text: {text}"))
}

/// What was read can be drawn, and every finding says where, what, and what to do.
fn check_layout(name: &str, layout: &Layout) -> Result<(), String> {
    for path in layout.paths.iter() {
        let mut points = path.runs().flat_map(|run| run.iter());
        if !points.all(|p| p.is_finite()) {
            return Err(format!("{name}: the path {} is not finite", path.id()));
        }
    }
    for finding in layout.diagnostics.iter() {
        let texts = [&finding.place.element, &finding.message, &finding.remedy];
        if texts.iter().any(|text| text.is_empty()) {
            return Err(format!("{name}: a poor finding: {finding:?}"));
        }
    }
    Ok(())
}

fn bad_files() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

/// Checks every line of the table in a folder, and that every file there has a line.
fn check_folder(folder: &str) {
    let path = bad_files().join(folder);
    let table = fs::read_to_string(path.join("expect.tsv")).unwrap();
    let lines: Vec<(&str, &str)> = table.lines().filter_map(|l| l.split_once('\t')).collect();
    let mut failures = Vec::new();
    for &(name, expected) in &lines {
        let bytes = match name.strip_prefix("generated:") {
            Some(recipe) => hostile::generate(folder, recipe).expect(name),
            None => fs::read(path.join(name)).expect(name),
        };
        failures.extend(check(name, &bytes, expected).err());
    }
    let listed = |name: &str| name == "expect.tsv" || lines.iter().any(|(n, _)| *n == name);
    for entry in path.read_dir().unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if !listed(&name) {
            failures.push(format!("{name}: not in the table"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn bad_lif_files() {
    check_folder("lif");
}

#[test]
fn bad_open_tcs_files() {
    check_folder("opentcs");
}

#[test]
fn bad_vda_5050_files() {
    check_folder("vda5050");
}

#[test]
fn bad_dxf_files() {
    check_folder("dxf");
}

#[test]
fn bad_geojson_files() {
    check_folder("geojson");
}

#[test]
fn bad_rmf_files() {
    check_folder("rmf");
}

#[test]
fn bad_svg_files() {
    check_folder("svg");
}

#[test]
fn bad_opendrive_files() {
    check_folder("opendrive");
}

#[test]
fn bad_lanelet2_files() {
    check_folder("lanelet2");
}

#[test]
fn bad_files_of_any_kind() {
    check_folder("any");
}

#[test]
fn bad_arrow_files() {
    if bad_files().join("arrow/expect.tsv").is_file() {
        check_folder("arrow");
    } else {
        println!("SKIPPED: there is no table of bad Arrow files");
    }
}

#[test]
fn a_wrong_expectation_fails() {
    let file = b"{\"layouts\": []}";
    assert_eq!(check("right", file, "ok"), Ok(()));
    for wrong in ["ok version", "error syntax", "error", "okay", ""] {
        assert!(check("wrong", file, wrong).is_err(), "{wrong}");
    }
    assert!(check("wrong", b"{", "error syntax").is_err());
    assert!(check("wrong", b"{", "ok").is_err());
}

/// Sound files.
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

/// A text that is cut anywhere is an error, and never a panic.
#[test]
fn every_truncation_is_an_error() {
    for file in VALID {
        let whole = fs::read(bad_files().join(file)).unwrap();
        let content = whole.trim_ascii_end().len();
        for length in 0..content {
            let error = match read(file, &whole[..length]).unwrap() {
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

/// A YAML text that is cut may be a sound one that is shorter.
const VALID_YAML: [&str; 2] = ["rmf/valid.yaml", "rmf/valid-graph.yaml"];

#[test]
fn no_truncation_of_yaml_breaks_the_reader() {
    for file in VALID_YAML {
        let whole = fs::read(bad_files().join(file)).unwrap();
        for length in 0..whole.len() {
            check_any(file, &whole[..length]);
        }
    }
}

/// One byte of a file replaced by another: whatever comes of it, it is no panic.
#[test]
fn no_single_byte_breaks_the_reader() {
    for file in VALID.into_iter().chain(VALID_YAML) {
        let whole = fs::read(bad_files().join(file)).unwrap();
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

fn check_any(name: &str, bytes: &[u8]) {
    match read(name, bytes).unwrap() {
        Ok(layout) => check_layout(name, &layout).unwrap(),
        Err(error) => check_error(name, &error).unwrap(),
    }
}

/// A layout with every field that is read.
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
fn no_field_of_another_type_breaks_the_reader() {
    change_every_field(EVERY_FIELD, 60);
    for (file, fields) in [
        ("vda5050/valid.json", 50),
        ("geojson/valid.geojson", 20),
        ("geojson/valid-graph.geojson", 30),
    ] {
        change_every_field(&fs::read_to_string(bad_files().join(file)).unwrap(), fields);
    }
}

/// Puts values of other types in the place of every value of a JSON text of so many or more.
fn change_every_field(text: &str, least: usize) {
    let whole: Value = serde_json::from_str(text).unwrap();
    let mut pointers = Vec::new();
    collect_pointers(&whole, String::new(), &mut pointers);
    assert!(pointers.len() > least);
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

/// The JSON pointer of every value within a value.
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
fn no_attribute_of_another_value_breaks_the_reader() {
    for file in [
        "opentcs/valid.xml",
        "svg/valid.svg",
        "opendrive/valid.xodr",
        "lanelet2/valid.osm",
    ] {
        let whole = fs::read_to_string(bad_files().join(file)).unwrap();
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
