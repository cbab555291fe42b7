//! Tests of the places of findings: a line in every text format, a column where it is known, a row
//! in a table.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::support::{command, json as answer};

/// The finding of a kind at a place.
fn finding(file: &Path, more: &[&str], code: &str, place: &str) -> Value {
    let mut check = command();
    check.args(["check", "--json"]).args(more).arg(file);
    let report = answer(&check.output().unwrap(), "check");
    let found = report["findings"].as_array().unwrap();
    let found = found
        .iter()
        .find(|f| f["code"] == code && f["place"] == place);
    found
        .unwrap_or_else(|| panic!("no {code} at {place} in {report:#}"))
        .clone()
}

/// Asserts that the finding of a kind at an element has the line of its text, from 1.
fn assert_line(name: &str, text: &str, more: &[&str], code: &str, place: &str, begins: &str) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, text).unwrap();
    let found = finding(&file, more, code, place);
    let line = text.lines().position(|line| line.contains(begins)).unwrap() + 1;
    assert_eq!(found["line"], json!(line), "{name}: {found:#}");
}

const LIF: &str = r#"{
  "metaInformation": {"projectIdentification": "a", "creator": "b",
    "exportTimestamp": "2026-01-01T00:00:00Z", "lifVersion": "1.0.0"},
  "layouts": [{"layoutId": "ground",
    "nodes": [
      {"nodeId": "a", "nodePosition": {"x": 0, "y": 0}, "vehicleTypeNodeProperties": []},
      {"nodeId": "b", "nodePosition": {"x": 9, "y": 0}, "vehicleTypeNodeProperties": []},
      {"nodeId": "c", "nodePosition": {"x": 20, "y": 0}, "vehicleTypeNodeProperties": []}
    ],
    "edges": [
      {"edgeId": "e1", "startNodeId": "a", "endNodeId": "b",
       "vehicleTypeEdgeProperties": [{"vehicleTypeId": "agv"}]},
      {"edgeId": "e2", "startNodeId": "a", "endNodeId": "b",
       "vehicleTypeEdgeProperties": [{"vehicleTypeId": "agv"}]},
      {"edgeId": "e3", "startNodeId": "a", "endNodeId": "nowhere",
       "vehicleTypeEdgeProperties": [{"vehicleTypeId": "agv"}]}
    ],
    "stations": [
      {"stationId": "s", "interactionNodeIds": [],
       "stationPosition": {"x": 1, "y": 1}}
    ]
  }]
}
"#;

#[test]
fn lif_elements_have_lines() {
    for (code, place, begins) in [
        ("unused-node", "node \"c\"", "{\"nodeId\": \"c\""),
        ("duplicate-path", "path \"e2\"", "{\"edgeId\": \"e2\""),
        (
            "station-without-node",
            "station \"s\"",
            "{\"stationId\": \"s\"",
        ),
        // A finding of the reader, at a field, and that of the refused path.
        (
            "unknown-node",
            "layouts[0].edges[2].endNodeId",
            "{\"edgeId\": \"e3\"",
        ),
        ("unknown-node", "path \"e3\"", "{\"edgeId\": \"e3\""),
    ] {
        assert_line("a.lif.json", LIF, &[], code, place, begins);
        assert_line(
            "b.lif.json",
            &format!("\u{FEFF}{LIF}"),
            &[],
            code,
            place,
            begins,
        );
    }
}

#[test]
fn a_file_on_one_line_has_columns() {
    let text = LIF.replace('\n', "");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.json");
    fs::write(&file, &text).unwrap();
    let found = finding(&file, &[], "unused-node", "node \"c\"");
    let column = text.find("{\"nodeId\": \"c\"").unwrap() + 1;
    assert_eq!(
        (&found["line"], &found["column"]),
        (&json!(1), &json!(column))
    );
    let found = finding(&file, &[], "unknown-node", "layouts[0].edges[2].endNodeId");
    let column = text.find("\"nowhere\"").unwrap() + 1;
    assert_eq!(found["column"], json!(column));
}

#[test]
fn geojson_features_have_lines() {
    let line = |id: &str| {
        format!(
            r#"{{"type": "Feature", "id": "{id}", "properties": {{}},
               "geometry": {{"type": "LineString", "coordinates": [[0, 0], [900, 0]]}}}}"#
        )
    };
    let lines = [line("a"), line("b")];
    let collection = format!(
        "{{\"type\": \"FeatureCollection\",\n\"features\": [\n{}\n]}}",
        lines.join(",\n")
    );
    let begins = "\"id\": \"b\"";
    let place = "path \"b\"";
    assert_line(
        "a.geojson",
        &collection,
        &[],
        "duplicate-path",
        place,
        begins,
    );
    // GeoJSON lines, and an array of features.
    let sequence = lines
        .each_ref()
        .map(|line| line.replace('\n', " "))
        .join("\n");
    assert_line(
        "b.geojsonl",
        &sequence,
        &[],
        "duplicate-path",
        place,
        begins,
    );
    let list = format!("[\n{}\n]", lines.join(",\n"));
    assert_line("c.json", &list, &[], "duplicate-path", place, begins);
}

#[test]
fn orders_have_lines_also_inside_of_messages() {
    let order = r#"{"headerId": 1, "timestamp": "2026-01-01T00:00:00Z", "version": "2.0.0",
  "manufacturer": "m", "serialNumber": "s", "orderId": "o", "orderUpdateId": 0,
  "nodes": [
    {"nodeId": "a", "sequenceId": 0, "released": true, "actions": [],
     "nodePosition": {"x": 0, "y": 0, "mapId": "m"}},
    {"nodeId": "b", "sequenceId": 2, "released": true, "actions": [],
     "nodePosition": {"x": 9, "y": 0, "mapId": "m"}},
    {"nodeId": "c", "sequenceId": 8, "released": true, "actions": [],
     "nodePosition": {"x": 90, "y": 0, "mapId": "m"}}
  ],
  "edges": [
    {"edgeId": "e", "sequenceId": 1, "released": true, "actions": [],
     "startNodeId": "a", "endNodeId": "b"}
  ]}"#;
    let begins = "{\"nodeId\": \"c\"";
    assert_line("a.json", order, &[], "unused-node", "node \"c\"", begins);
    let message = format!("{{\n\"topic\": \"t\",\n\"payload\": {order}\n}}");
    assert_line("b.json", &message, &[], "unused-node", "node \"c\"", begins);
}

#[test]
fn elements_of_xml_have_lines() {
    let plant = r#"<?xml version="1.0" encoding="UTF-8"?>
<model version="6.0.0" name="m">
  <point name="A" positionX="0" positionY="0"
    positionZ="0" vehicleOrientationAngle="NaN" type="HALT_POSITION"/>
  <point name="B" positionX="9000" positionY="0"
    positionZ="0" vehicleOrientationAngle="NaN" type="HALT_POSITION"/>
  <point name="C" positionX="9000" positionY="9000"
    positionZ="0" vehicleOrientationAngle="NaN" type="HALT_POSITION"/>
  <path name="A --- B" sourcePoint="A" destinationPoint="B" length="9000"
    maxVelocity="1000" maxReverseVelocity="0" locked="false"/>
  <path name="A --- X"
    sourcePoint="A" destinationPoint="X" length="9000"
    maxVelocity="1000" maxReverseVelocity="0" locked="false"/>
  <locationType name="T"/>
  <location name="L" positionX="0" positionY="0" positionZ="0" type="T" locked="false"/>
</model>
"#;
    for (code, place, begins) in [
        ("unused-node", "node \"C\"", "<point name=\"C\""),
        (
            "station-without-node",
            "station \"L\"",
            "<location name=\"L\"",
        ),
        ("unknown-node", "path \"A --- X\"", "<path name=\"A --- X\""),
    ] {
        assert_line("a.xml", plant, &[], code, place, begins);
    }
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm">
  <path id="a" d="M 0 0 L 90 0" stroke="black"/>
  <g>
    <path id="b" d="M 0 0 L 90 0" stroke="black"/>
  </g>
</svg>
"#;
    assert_line(
        "a.svg",
        svg,
        &[],
        "duplicate-path",
        "path \"b\"",
        "id=\"b\"",
    );
    let osm = r#"<osm version="0.6">
  <node id="1" lat="49.0" lon="8.0"/>
  <node id="2" lat="49.001" lon="8.0"/>
  <way id="3"><nd ref="1"/><nd ref="2"/></way>
  <way id="4">
    <nd ref="1"/><nd ref="2"/></way>
</osm>
"#;
    assert_line(
        "a.osm",
        osm,
        &[],
        "duplicate-path",
        "path \"4\"",
        "<way id=\"4\"",
    );
    let road = r#"<OpenDRIVE><header revMajor="1" revMinor="6"/>
<road name="r" length="20" id="7" junction="-1">
  <planView><geometry s="0" x="0" y="0" hdg="0" length="20"><arc curvature="0.1"/></geometry>
  </planView>
  <lanes><laneSection s="0">
    <center><lane id="0" type="none" level="false"/></center>
    <right>
      <lane id="-1" type="driving" level="false"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>
    </right>
  </laneSection></lanes>
</road></OpenDRIVE>
"#;
    let more = ["--min-radius", "50"];
    assert_line(
        "a.xodr",
        road,
        &more,
        "curvature",
        "path \"7.0.-1\"",
        "<lane id=\"-1\"",
    );
}

#[test]
fn elements_of_yaml_have_lines() {
    let building = "name: site
levels:
  L1:
    elevation: 0
    lanes:
      - [0, 1, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, \"\"]}]
      - [0, 1, {bidirectional: [4, true], graph_idx: [2, 0], orientation: [1, \"\"]}]
    measurements:
      - [0, 1, {distance: [3, 10]}]
    vertices:
      - [0, 0, 0, a]
      - [100, 0, 0, b]
      - [200, 0, 0, c]
";
    let place = "node \"c\"";
    assert_line(
        "a.building.yaml",
        building,
        &[],
        "unused-node",
        place,
        "[200, 0, 0, c]",
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.building.yaml");
    fs::write(&file, building).unwrap();
    let lane = finding(&file, &[], "duplicate-path", "path \"L1.lanes[1]\"");
    assert_eq!(lane["line"], 7, "{lane:#}");
}

#[test]
fn entities_of_drawings_have_lines() {
    let line = |handle: &str| {
        let ends = "10\n0\n20\n0\n11\n9\n21\n0\n";
        format!("0\nLINE\n5\n{handle}\n8\nA\n{ends}")
    };
    let header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n";
    let (first, second) = (line("1A"), line("1B"));
    let text = format!("{header}0\nSECTION\n2\nENTITIES\n{first}{second}0\nENDSEC\n0\nEOF\n");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.dxf");
    fs::write(&file, &text).unwrap();
    let found = finding(&file, &[], "duplicate-path", "path \"1B\"");
    let line = found["line"].as_u64().unwrap() as usize;
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[line - 1..line + 3],
        ["0", "LINE", "5", "1B"],
        "{found:#}"
    );
}

#[test]
fn elements_of_tables_have_rows() {
    let folder = tempfile::tempdir().unwrap();
    let [lif, arrow] = ["a.lif.json", "a.arrow"].map(|name| folder.path().join(name));
    let two = LIF.replace("nowhere", "c");
    fs::write(&lif, two).unwrap();
    let converted = command()
        .arg("convert")
        .args([&lif, &arrow])
        .output()
        .unwrap();
    assert_eq!(converted.status.code(), Some(0));
    let found = finding(&arrow, &[], "duplicate-path", "path \"e2\"");
    assert_eq!((&found["line"], &found["row"]), (&Value::Null, &json!(2)));
}
