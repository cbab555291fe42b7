//! LIF save: a file that was not edited stays byte by byte; an edit changes its part alone.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use guideway_formats::lif::{Version, WriteOptions, write_layout};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{Layout, NewPath, Value};
use guideway_spline::{Affine, Point, Runs};

use crate::common::{real_cases, real_layouts};

pub(crate) fn read(text: &str) -> Layout {
    read_bytes("site.json", text.as_bytes(), &ReadOptions::default()).unwrap()
}

pub(crate) fn saved(layout: &Layout) -> String {
    let mut out = Vec::new();
    let options = WriteOptions {
        version: Version::of_layout(layout).unwrap(),
        exported: SystemTime::UNIX_EPOCH,
    };
    write_layout(layout, &mut out, &options).unwrap();
    String::from_utf8(out).unwrap()
}

/// Returns the lines that only one of two texts has, with a sign each.
pub(crate) fn changed_lines(before: &str, after: &str) -> Vec<String> {
    let (old, new): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
    let same = old.iter().zip(&new).take_while(|(a, b)| a == b).count();
    let rest = old.len().min(new.len()) - same;
    let pairs = old.iter().rev().zip(new.iter().rev()).take(rest);
    let same_end = pairs.take_while(|(a, b)| a == b).count();
    let middle = |lines: &[&str], sign: &str| -> Vec<String> {
        let lines = &lines[same..lines.len() - same_end];
        lines
            .iter()
            .map(|line| format!("{sign}{}", line.trim()))
            .collect()
    };
    [middle(&old, "-"), middle(&new, "+")].concat()
}

fn lif_files() -> Vec<PathBuf> {
    let folders = [real_layouts("lif"), real_cases("lif")];
    let files = folders.into_iter().flatten().flat_map(|folder| {
        let files = fs::read_dir(folder).unwrap();
        files.map(|file| file.unwrap().path()).collect::<Vec<_>>()
    });
    files.collect()
}

#[test]
fn untouched_files_stay_byte_by_byte() {
    let mut count = 0;
    for path in lif_files() {
        let bytes = fs::read(&path).unwrap();
        let name = path.display().to_string();
        let Ok(layout) = read_bytes(&name, &bytes, &ReadOptions::default()) else {
            continue;
        };
        assert_eq!(layout.provenance.format, "LIF", "{name}");
        // A file in another encoding is written in UTF-8.
        if bytes.contains(&0) {
            continue;
        }
        assert!(saved(&layout).as_bytes() == bytes, "{name} changed");
        count += 1;
    }
    if !lif_files().is_empty() {
        assert!(count > 30, "{count} files");
    }
}

/// Variants of a text: byte order mark, line breaks, white space, no newline at the end.
fn variants(text: &str) -> Vec<String> {
    let value: serde_json::Value = serde_json::from_str(text).unwrap();
    vec![
        text.to_owned(),
        format!("\u{FEFF}{text}\n\n"),
        text.replace('\n', "\r\n"),
        text.trim_end().to_owned(),
        value.to_string(),
        text.replace("  ", "\t"),
        text.replace(": ", " :  "),
    ]
}

const SITE: &str = r#"{
  "metaInformation": {
    "projectIdentification": "our site",
    "creator": "us",
    "exportTimestamp": "2026-01-01T00:00:00Z",
    "lifVersion": "1.0.0"
  },
  "ours": { "mark": 7 },
  "layouts": [
    {
      "layoutVersion": "12",
      "layoutId": "hall",
      "nodes": [
        {
          "nodeId": "n1",
          "nodeDescription": "by the gate",
          "mapId": "m",
          "nodePosition": { "x": 0.0, "y": 0, "z": 4 },
          "vehicleTypeNodeProperties": [
            { "vehicleTypeId": "a", "theta": 1.50 },
            { "vehicleTypeId": "b" }
          ]
        },
        {
          "nodeId": "n2",
          "mapId": "m",
          "nodePosition": {
            "x": 4.000,
            "y": 0
          },
          "vehicleTypeNodeProperties": [
            { "vehicleTypeId": "a" },
            { "vehicleTypeId": "b" }
          ]
        },
        {
          "nodeId": "n3",
          "mapId": "m",
          "nodePosition": {
            "x": 9,
            "y": 0
          },
          "vehicleTypeNodeProperties": []
        }
      ],
      "edges": [
        {
          "edgeId": "e1",
          "startNodeId": "n1",
          "endNodeId": "n2",
          "edgeName": "first",
          "color": "red",
          "vehicleTypeEdgeProperties": [
            {
              "vehicleTypeId": "a",
              "rotationAllowed": false,
              "maxSpeed": 1.50,
              "loadRestriction": { "unloaded": true, "loaded": false, "wet": 1 },
              "actions": [
                { "actionType": "beep", "blockingType": "NONE" }
              ]
            },
            {
              "vehicleTypeId": "b",
              "rotationAllowed": true,
              "maxSpeed": 2,
              "trajectory": {
                "degree": 2,
                "knotVector": [0, 0, 0, 1, 1, 1],
                "controlPoints": [
                  { "x": 0, "y": 0 },
                  { "x": 2, "y": 1.0, "weight": 0.5 },
                  { "x": 4, "y": 0 }
                ]
              }
            }
          ]
        },
        {
          "edgeId": "e2",
          "startNodeId": "n2",
          "endNodeId": "n1",
          "vehicleTypeEdgeProperties": [
            {
              "vehicleTypeId": "a",
              "rotationAllowed": false
            }
          ]
        }
      ],
      "stations": [
        {
          "stationId": "s1",
          "interactionNodeIds": ["n1", "n2"],
          "stationHeight": 0.10,
          "stationPosition": { "x": 1.0, "y": 2.0, "theta": 3.0 }
        }
      ]
    }
  ]
}
"#;

#[test]
fn any_formatting_stays() {
    for text in variants(SITE) {
        let layout = read(&text);
        assert!(layout.diagnostics.is_empty(), "{:?}", layout.diagnostics);
        assert_eq!(saved(&layout), text);
    }
}

/// Reads the site, edits it, and returns the lines that change.
fn lines_after(edit: impl FnOnce(&mut Layout)) -> Vec<String> {
    let mut layout = read(SITE);
    edit(&mut layout);
    let after = saved(&layout);
    let again = read(&after);
    assert_eq!(again.paths.len(), layout.paths.len(), "{after}");
    assert_eq!(saved(&again), after, "saving again changes nothing");
    changed_lines(SITE, &after)
}

#[test]
fn moved_node_changes_its_numbers() {
    let lines = lines_after(|layout| {
        layout.nodes.set_position_m(1, Point::new(4.0, 0.5));
    });
    assert_eq!(lines, ["-\"y\": 0", "+\"y\": 0.5"]);
    let lines = lines_after(|layout| {
        layout.nodes.set_position_m(0, Point::new(-1.0, 0.25));
    });
    assert_eq!(
        lines,
        [
            r#"-"nodePosition": { "x": 0.0, "y": 0, "z": 4 },"#,
            r#"+"nodePosition": { "x": -1.0, "y": 0.25, "z": 4 },"#
        ]
    );
}

#[test]
fn set_speed_changes_one_number() {
    let lines = lines_after(|layout| {
        let row = layout
            .paths
            .iter()
            .position(|p| p.id() == "e1 [b]")
            .unwrap();
        layout
            .paths
            .attributes
            .set(row, "maxSpeed", Value::Float(2.5));
    });
    assert_eq!(lines, ["-\"maxSpeed\": 2,", "+\"maxSpeed\": 2.5,"]);
    let lines = lines_after(|layout| {
        let row = layout.paths.iter().position(|p| p.id() == "e2").unwrap();
        layout
            .paths
            .attributes
            .set(row, "maxSpeed", Value::Float(2.5));
    });
    assert_eq!(
        lines,
        [
            "-\"rotationAllowed\": false",
            "+\"rotationAllowed\": false,",
            "+\"maxSpeed\": 2.5"
        ]
    );
    let lines = lines_after(|layout| layout.paths.attributes.clear(0, "maxSpeed"));
    assert_eq!(lines, ["-\"maxSpeed\": 1.50,"]);
}

#[test]
fn removed_rows_take_their_objects_along() {
    let without = |id: &str| {
        let mut layout = read(SITE);
        let rows: Vec<usize> = (0..layout.paths.len())
            .filter(|&row| !layout.paths.id(row).starts_with(id))
            .collect();
        layout.retain_paths(&rows);
        saved(&layout)
    };
    let after = without("e2");
    let lines = changed_lines(SITE, &after);
    assert!(lines.len() == 11 && lines.iter().all(|line| line.starts_with('-')));
    let value: serde_json::Value = serde_json::from_str(&after).unwrap();
    assert_eq!(value["layouts"][0]["edges"].as_array().unwrap().len(), 1);
    assert!(!without("e1").contains("trajectory"));
    assert!(without("e").contains("\"edges\": []"));
    let one_type = without("e1 [a]");
    assert!(one_type.contains("\"edgeId\": \"e1\"") && one_type.contains("\"weight\": 0.5"));
    assert!(!one_type.contains("\"maxSpeed\": 1.50"));
}

#[test]
fn renamed_node_changes_its_references() {
    let lines = lines_after(|layout| layout.nodes.set_ids(&[(1, "N 2")]));
    let added = |line: &&String| line.starts_with('+') && line.contains("N 2");
    assert_eq!(lines.iter().filter(added).count(), 4, "{lines:?}");
    assert!(lines.contains(&"+\"interactionNodeIds\": [\"n1\", \"N 2\"],".to_owned()));
}

#[test]
fn new_objects_look_like_their_neighbors() {
    let mut layout = read(SITE);
    let mut runs = Runs::default();
    runs.push_line(Point::new(4.0, 0.0), Point::new(9.0, 0.0));
    let row = layout.paths.push(&NewPath {
        id: "e3",
        runs: &runs,
        start_node: Some(1),
        end_node: Some(2),
        level: Some(0),
        vehicle_types: &["a"],
        ..NewPath::default()
    });
    layout
        .paths
        .attributes
        .set(row, "maxSpeed", Value::Float(0.5));
    layout
        .stations
        .push("s2", Some(Point::new(7.0, 1.0)), vec![2], Some(0));
    let after = saved(&layout);
    let edge = r#"
        },
        {
          "edgeId": "e3",
          "startNodeId": "n2",
          "endNodeId": "n3",
          "vehicleTypeEdgeProperties": [
            {
              "vehicleTypeId": "a",
              "maxSpeed": 0.5,
              "rotationAllowed": false
            }
          ]
        }
      ],"#;
    assert!(after.contains(edge), "{after}");
    let station = r#"
        {
          "stationId": "s2",
          "interactionNodeIds": ["n3"],
          "stationPosition": { "x": 7.0, "y": 1.0 }
        }
      ]"#;
    assert!(after.contains(station), "{after}");
    // The node needs an entry for the type of the new edge.
    let entry = "\"vehicleTypeNodeProperties\": [\n            {\n              \
                 \"vehicleTypeId\": \"a\"\n            }\n          ]";
    assert!(after.contains(entry), "{after}");
    assert_eq!(read(&after).paths.len(), 4);
}

#[test]
fn edited_curve_replaces_its_trajectory() {
    let mut layout = read(SITE);
    layout.transform(Affine::translation(Point::new(0.0, 5.0)));
    let after = saved(&layout);
    assert!(
        after.contains("{ \"x\": 2, \"y\": 6.0, \"weight\": 0.5 }"),
        "{after}"
    );
    assert!(after.contains("\"stationPosition\": { \"x\": 1.0, \"y\": 7.0, \"theta\": 3.0 }"));
    assert!(after.contains("\"loaded\": false, \"wet\": 1"));
    let again = read(&after);
    assert_eq!(saved(&again), after);
    for (a, b) in layout.paths.iter().zip(again.paths.iter()) {
        assert_eq!(a.ends(), b.ends());
    }
}

#[test]
fn second_version_is_kept() {
    let Some(folder) = real_layouts("lif") else {
        return;
    };
    let name = "lif200_example14_two_levels_of_a_facility_in_one_lif_file.json";
    let before = fs::read_to_string(Path::new(&folder).join(name)).unwrap();
    let mut layout = read(&before);
    let attributes = &mut layout.paths.attributes;
    attributes.set(0, "vehicleOrientation", Value::Float(1.5));
    attributes.set(1, "maxSpeed", Value::Float(2.0));
    let after = saved(&layout);
    let value: serde_json::Value = serde_json::from_str(&after).unwrap();
    let edges = |origin: usize| &value["origins"][origin]["layouts"][0]["edges"];
    let entry = &edges(0)[0]["mobileRobotTypeEdgeProperties"][0];
    assert_eq!(entry["mobileRobotOrientations"][0].as_f64(), Some(1.5));
    let entry = &edges(1)[0]["mobileRobotTypeEdgeProperties"][0];
    assert_eq!(entry["maximumSpeed"].as_f64(), Some(2.0));
    let (old, new) = (before.lines().count(), after.lines().count());
    assert_eq!(new, old + 1);
}
