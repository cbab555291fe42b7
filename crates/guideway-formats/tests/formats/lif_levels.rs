//! LIF save of levels and vehicle types that were added, renamed or removed.

use guideway_layout::{Layout, Level, Value};

use crate::lif_save::{changed_lines, read, saved};

/// Two layouts with a node each, and an edge within the first one.
const TWO: &str = r#"{
  "metaInformation": { "projectIdentification": "two", "lifVersion": "1.0.0" },
  "layouts": [
    {
      "layoutId": "hall", "layoutVersion": "3", "vendor": "kept",
      "nodes": [
        { "nodeId": "a", "mapId": "hall", "nodePosition": { "x": 0, "y": 0 },
          "vehicleTypeNodeProperties": [ { "vehicleTypeId": "tug" } ] },
        { "nodeId": "b", "nodePosition": { "x": 5, "y": 0 },
          "vehicleTypeNodeProperties": [ { "vehicleTypeId": "tug", "theta": 1 } ] }
      ],
      "edges": [
        { "edgeId": "ab", "startNodeId": "a", "endNodeId": "b",
          "vehicleTypeEdgeProperties": [
            { "vehicleTypeId": "tug", "rotationAllowed": true, "maxSpeed": 1.25, "own": 7 }
          ] }
      ],
      "stations": []
    },
    {
      "layoutId": "roof", "layoutLevelId": "2", "layoutVersion": "1",
      "nodes": [
        { "nodeId": "r", "nodePosition": { "x": 0, "y": 9 },
          "vehicleTypeNodeProperties": [ { "vehicleTypeId": "tug" } ] }
      ],
      "edges": [],
      "stations": [ { "stationId": "dock", "interactionNodeIds": [ "r" ] } ]
    }
  ]
}
"#;

/// The same two layouts in origins of 2.0, each with one.
const ORIGINS: &str = r#"{
  "metaInformation": { "lifId": "two", "lifVersion": "2.0.0" },
  "origins": [
    {
      "originId": "o1",
      "layouts": [ { "layoutId": "hall", "layoutVersion": "3", "nodes": [
        { "nodeId": "a", "nodePosition": { "x": 0, "y": 0 }, "mobileRobotTypeNodeProperties": [
          { "mobileRobotTypes": [ { "manufacturer": "Acme", "seriesName": "Tug" } ] } ] }
      ], "edges": [], "stations": [] } ]
    },
    {
      "originId": "o2",
      "layouts": [ { "layoutId": "roof", "layoutVersion": "1", "nodes": [
        { "nodeId": "r", "nodePosition": { "x": 0, "y": 9 }, "mobileRobotTypeNodeProperties": [] }
      ], "edges": [], "stations": [] } ]
    }
  ]
}
"#;

fn level(id: &str) -> Level {
    Level {
        id: id.into(),
        ..Level::default()
    }
}

/// The levels of a layout, each with the identifiers of its nodes.
fn content(layout: &Layout) -> Vec<(&str, Vec<&str>)> {
    let nodes_on = |level: usize| {
        let nodes = 0..layout.nodes.len() as u32;
        let nodes = nodes.filter(|&node| layout.nodes.level(node) == Some(level as u32));
        nodes.map(|node| layout.nodes.id(node)).collect()
    };
    let levels = layout.levels.iter().enumerate();
    levels
        .map(|(row, level)| (level.id.as_str(), nodes_on(row)))
        .collect()
}

/// Edits a file, saves it and reads it again. Saving again must change nothing.
fn after(text: &str, edit: impl FnOnce(&mut Layout)) -> (String, Layout) {
    let mut layout = read(text);
    edit(&mut layout);
    let saved_text = saved(&layout);
    let again = read(&saved_text);
    assert_eq!(saved(&again), saved_text, "saving again changes nothing");
    (saved_text, again)
}

#[test]
fn a_renamed_level_changes_its_name_alone() {
    let (text, again) = after(TWO, |layout| {
        layout.levels[0].id = "ground".into();
        layout.levels[1].name = Some("Roof".into());
        layout
            .nodes
            .attributes
            .set(0, "mapId", Value::Text("ground"));
    });
    let lines = changed_lines(TWO, &text);
    let changed: Vec<&String> = lines.iter().filter(|line| line.starts_with('+')).collect();
    assert!(text.contains(r#""layoutId": "ground", "layoutVersion": "3", "vendor": "kept""#));
    assert!(text.contains(r#""layoutName": "Roof""#) && text.contains(r#""mapId": "ground""#));
    assert!(!text.contains("\"hall\""), "{changed:?}");
    assert_eq!(
        content(&again),
        [("ground", vec!["a", "b"]), ("roof", vec!["r"])]
    );
}

#[test]
fn a_new_level_becomes_a_layout_with_its_elements() {
    let (text, again) = after(TWO, |layout| {
        layout.levels.push(level("attic"));
        layout
            .nodes
            .push("new", guideway_spline::Point::new(1.0, 1.0), Some(2));
        layout.nodes.set_level(2, Some(2));
        layout.stations.set_level(0, Some(2));
    });
    let nodes = [
        ("hall", vec!["a", "b"]),
        ("roof", vec![]),
        ("attic", vec!["r", "new"]),
    ];
    assert_eq!(content(&again), nodes, "{text}");
    assert_eq!(again.stations.level(0), Some(2));
    let untouched = &TWO[..TWO.find("\"roof\"").unwrap()];
    assert!(
        text.starts_with(untouched),
        "the first layout stays: {text}"
    );
}

#[test]
fn a_removed_level_leaves_the_text_and_its_elements_move() {
    let (text, again) = after(TWO, |layout| {
        layout.nodes.set_level(2, Some(0));
        layout.stations.set_level(0, Some(0));
        layout.remove_level(1);
        layout.insert_level(1, level("attic"));
    });
    assert!(!text.contains("roof") && text.contains("\"vendor\": \"kept\""));
    assert_eq!(
        content(&again),
        [("hall", vec!["a", "b", "r"]), ("attic", vec![])]
    );
    let (text, again) = after(TWO, |layout| {
        for node in 0..2 {
            layout.nodes.set_level(node, Some(1));
        }
        layout.paths.set_level(0, Some(1));
        layout.remove_level(0);
    });
    assert_eq!(content(&again), [("roof", vec!["r", "a", "b"])], "{text}");
    assert!(
        text.contains("\"own\": 7"),
        "unknown members move along: {text}"
    );
}

#[test]
fn levels_of_the_second_version_keep_their_origins() {
    let (text, again) = after(ORIGINS, |layout| {
        layout.levels.push(level("attic"));
        let mut own = level("yard");
        own.attributes.set(0, "originId", Value::Text("o3"));
        layout.levels.push(own);
        layout.nodes.set_level(1, Some(3));
        layout.remove_level(1);
    });
    let origin = |row: usize| again.levels[row].attributes.value(0, "originId");
    let text_of = |text| Some(Value::Text(text));
    assert_eq!(
        content(&again),
        [("hall", vec!["a"]), ("attic", vec![]), ("yard", vec!["r"])]
    );
    assert_eq!(
        [origin(0), origin(1), origin(2)],
        ["o1", "o1", "o3"].map(text_of)
    );
    assert!(
        !text.contains("o2"),
        "an origin without levels goes: {text}"
    );
}

fn rename_type(layout: &mut Layout, old: &str, new: &str) {
    layout.paths.vehicle_types_mut().rename(old, new);
    layout.nodes.vehicle_types_mut().rename(old, new);
}

#[test]
fn a_renamed_vehicle_type_leaves_no_trace_of_its_old_name() {
    for (text, old, new) in [(TWO, "tug", "tugger"), (ORIGINS, "Acme Tug", "Acme Crane")] {
        let (text, again) = after(text, |layout| {
            rename_type(layout, old, new);
        });
        assert_eq!(
            again.vehicle_type_names().into_iter().collect::<Vec<_>>(),
            [new],
            "{text}"
        );
        assert!(
            !text.contains("\"tug\"") && !text.contains("\"Tug\""),
            "{text}"
        );
    }
    let (text, again) = after(TWO, |layout| {
        rename_type(layout, "tug", "tugger");
    });
    let speed = again.paths.value_for(0, "tugger", "maxSpeed");
    assert_eq!(speed, Some(Value::Float(1.25)));
    assert!(text.contains("\"own\""), "unknown members stay: {text}");
}
