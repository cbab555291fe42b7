//! Tests of the openTCS writer: structure of the file, defaults, names, shapes and losses.

use std::time::SystemTime;

use crate::common::{read, real};
use crate::same::{lost, push_lines};
use guideway_formats::lif::{self, WriteOptions};
use guideway_formats::opentcs::{Version, write_layout};
use guideway_formats::{Losses, Target};
use guideway_layout::{Block, Direction, Layout, Level, Member, NewPath, Quantity, Value};
use guideway_spline::{Point, Runs};

fn write(layout: &Layout) -> (String, Losses) {
    let mut text = Vec::new();
    let losses = write_layout(layout, &mut text, Version::V7).unwrap();
    (String::from_utf8(text).unwrap(), losses)
}

/// A layout of two nodes, 10 m apart, joined by a straight path.
fn line() -> Layout {
    let mut layout = Layout::default();
    layout.provenance.source = "folder/hall.lif.json".into();
    for (id, x) in [("A", 0.0), ("B", 10.0)] {
        layout.nodes.push(id, Point::new(x, 0.0), None);
    }
    push_lines(&mut layout, "A-B", &[(0.0, 0.0), (10.0, 0.0)]);
    layout.paths.set_nodes(0, Some(0), Some(1));
    layout
}

#[test]
fn writes_the_structure_of_a_plant_model() {
    let mut layout = line();
    layout.paths.set_direction(0, Direction::Both);
    let paths = &mut layout.paths.attributes;
    paths.set_quantity(0, "maxSpeed", 1.7, Quantity::Speed);
    paths.set_quantity(0, "maxHeight", 2.5, Quantity::Length);
    let nodes = &mut layout.nodes.attributes;
    nodes.set_quantity(1, "theta", std::f64::consts::FRAC_PI_2, Quantity::Angle);
    layout.stations.push("dock", None, vec![1], None);
    layout.blocks.push(Block {
        id: "crossing".into(),
        members: vec![Member::Path(0), Member::Station(0)],
        ..Block::default()
    });
    let (text, losses) = write(&layout);
    let expected = r##"<?xml version="1.0" encoding="UTF-8" standalone="yes"?>
<model version="7.0.0" name="hall">
    <point name="A" positionX="0" positionY="0" positionZ="0" vehicleOrientationAngle="NaN"
        type="HALT_POSITION">
        <maxVehicleBoundingBox length="1000" width="1000" height="1000" referenceOffsetX="0"
            referenceOffsetY="0"/>
        <outgoingPath name="A-B"/>
        <pointLayout labelOffsetX="-10" labelOffsetY="-20" layerId="0"/>
    </point>
    <point name="B" positionX="10000" positionY="0" positionZ="0" vehicleOrientationAngle="90.0"
        type="HALT_POSITION">
        <maxVehicleBoundingBox length="1000" width="1000" height="1000" referenceOffsetX="0"
            referenceOffsetY="0"/>
        <pointLayout labelOffsetX="-10" labelOffsetY="-20" layerId="0"/>
    </point>
    <path name="A-B" sourcePoint="A" destinationPoint="B" length="10000" maxVelocity="1700"
        maxReverseVelocity="1700" locked="false">
        <property name="guideway:maxHeight (m)" value="2.5"/>
        <pathLayout connectionType="DIRECT" layerId="0"/>
    </path>
    <locationType name="Station"/>
    <location name="dock" positionX="10000" positionY="0" positionZ="0" locked="false"
        type="Station">
        <link point="B"/>
        <locationLayout labelOffsetX="-10" labelOffsetY="-20" locationRepresentation="DEFAULT"
            layerId="0"/>
    </location>
    <block name="crossing" type="SINGLE_VEHICLE_ONLY">
        <member name="A-B"/>
        <member name="dock"/>
    </block>
    <visualLayout name="VLayout" scaleX="50.0" scaleY="50.0">
        <layer id="0" ordinal="0" visible="true" name="Default layer" groupId="0"/>
        <layerGroup id="0" name="Default layer group" visible="true"/>
    </visualLayout>
</model>
"##;
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(words(&text), words(expected));
    assert!(text.contains("\n    <point name=\"A\""), "{text}");
    let expected = [
        ("layout properties", 1),
        ("column length", 1),
        ("positions", 1),
        ("column kind", 1),
        ("column type", 1),
    ];
    assert_eq!(lost(&losses), expected);
    let again = read(&text);
    let height = again.paths.attributes.get("maxHeight").unwrap();
    assert_eq!(height.values.get(0), Some(Value::Float(2.5)));
    assert_eq!(height.quantity, Some(Quantity::Length));
}

#[test]
fn version_6_has_the_positions_of_the_drawing_too() {
    let mut text = Vec::new();
    write_layout(&line(), &mut text, Version::V6).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains(r#"<model version="6.0.0""#), "{text}");
    let layout = r#"<pointLayout positionX="10000" positionY="0" labelOffsetX="-10""#;
    assert!(text.contains(layout), "{text}");
}

#[test]
fn paths_without_a_speed_can_be_driven_and_closed_ones_stay_closed() {
    let (text, losses) = write(&line());
    let speeds = r#"maxVelocity="1000" maxReverseVelocity="0""#;
    assert!(text.contains(speeds), "{text}");
    assert!(lost(&losses).contains(&("column maxSpeed", 1)));
    let mut closed = line();
    let attributes = &mut closed.paths.attributes;
    attributes.set_quantity(0, "maxSpeed", 0.0, Quantity::Speed);
    let (text, losses) = write(&closed);
    let speeds = r#"maxVelocity="0" maxReverseVelocity="0""#;
    assert!(text.contains(speeds), "{text}");
    assert!(!lost(&losses).contains(&("column maxSpeed", 1)));
}

#[test]
fn paths_driven_backwards_only_keep_their_direction_in_the_file() {
    let path = r#"<path name="P" sourcePoint="A" destinationPoint="B" length="10000"
        maxVelocity="0" maxReverseVelocity="200" locked="false">
        <pathLayout connectionType="BEZIER" layerId="0"><controlPoint x="60" y="-40"/>
        <controlPoint x="90" y="-80"/></pathLayout></path>"#;
    let layout = read(&format!(
        r#"<model version="7.0.0" name="m"><point name="A" positionX="0" positionY="0"/>
           <point name="B" positionX="10000" positionY="0"/>{path}</model>"#
    ));
    let (text, losses) = write(&layout);
    assert!(losses.is_empty(), "{losses:?}");
    let ends = r#"sourcePoint="A" destinationPoint="B" length="10000" maxVelocity="0""#;
    assert!(text.contains(ends), "{text}");
    let first = text.find(r#"<controlPoint x="60" y="-40"/>"#).unwrap();
    assert!(first < text.find(r#"<controlPoint x="90""#).unwrap());
    assert!(text.contains("<outgoingPath name=\"P\"/>"));
}

#[test]
fn names_are_unique_in_the_whole_plant_and_valid() {
    let mut layout = line();
    push_lines(&mut layout, "A", &[(10.0, 0.0), (20.0, 5.0)]);
    push_lines(&mut layout, "", &[(20.0, 5.0), (30.0, 5.0)]);
    layout.stations.push("a\u{1}<&\"", None, vec![0], None);
    let (text, losses) = write(&layout);
    let again = read(&text);
    let ids: Vec<_> = again.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["A-B", "A~2", "~2"]);
    assert_eq!(again.stations.id(0), "a_<&\"");
    let points: Vec<_> = (0..5).map(|row| again.nodes.id(row)).collect();
    assert_eq!(points, ["A", "B", "Point 1", "Point 2", "Point 3"]);
    let lost = lost(&losses);
    let expected = [("paths", 2), ("nodes", 3), ("identifiers", 1)];
    assert!(expected.iter().all(|loss| lost.contains(loss)), "{lost:?}");
}

#[test]
fn levels_and_layers_become_layers() {
    let mut layout = line();
    layout.levels.push(Level {
        id: "L2".into(),
        name: Some("Upper".into()),
        ..Level::default()
    });
    layout.paths.set_level(0, Some(0));
    push_lines(&mut layout, "wall", &[(0.0, 5.0), (10.0, 5.0)]);
    let attributes = &mut layout.paths.attributes;
    attributes.set(1, "layer", Value::Text("WALLS"));
    let again = read(&write(&layout).0);
    let layer = |row| again.paths.attributes.value(row, "layer");
    assert_eq!(layer(0), Some(Value::Text("Upper")));
    assert_eq!(layer(1), Some(Value::Text("WALLS")));
    assert_eq!(again.nodes.attributes.value(0, "layer"), None);
}

#[test]
fn curves_are_drawn_in_the_coarsest_units_that_suffice() {
    let scale = |handles: [(f64, f64); 4]| {
        let mut runs = Runs::default();
        runs.push_bezier(&handles.map(|(x, y)| Point::new(x, y)));
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            runs: &runs,
            id: "P",
            ..NewPath::default()
        });
        let (text, losses) = write(&layout);
        let start = text.find("scaleX=").unwrap();
        let is_exact = !lost(&losses).iter().any(|(what, _)| *what == "curves");
        (
            text[start..].split('"').nth(1).unwrap().to_owned(),
            is_exact,
        )
    };
    let on_raster = scale([(0.0, 0.0), (3.0, 0.0), (4.0, 1.05), (4.0, 4.0)]);
    assert_eq!(on_raster, ("50.0".to_owned(), true));
    let off = scale([(0.0, 0.0), (3.025, 0.025), (4.025, 1.025), (4.0, 4.0)]);
    assert_eq!(off, ("20.0".to_owned(), false));
    let far_off = scale([(0.0, 0.0), (3.01, 0.01), (4.01, 1.01), (4.0, 4.0)]);
    assert_eq!(far_off, ("10.0".to_owned(), true));
}

#[test]
fn vehicle_types_are_listed_as_lost() {
    let mut layout = line();
    layout.paths.vehicle_types_mut().set(0, &["tug", "fork"]);
    for (entry, speed) in [(0, 1.0), (1, 2.0)] {
        let attributes = &mut layout.paths.vehicle_types_mut().attributes;
        attributes.set_quantity(entry, "maxSpeed", speed, Quantity::Speed);
    }
    let (text, losses) = write(&layout);
    assert!(text.contains(r#"maxVelocity="1000""#), "{text}");
    let lost = lost(&losses);
    for loss in [("vehicle types", 1), ("column maxSpeed", 2)] {
        assert!(lost.contains(&loss), "{lost:?}");
    }
}

#[test]
fn speeds_of_a_plant_model_reach_lif() {
    let Some(layout) = real("opentcs", "Demo-01_v7.0.0.xml") else {
        return;
    };
    let mut text = Vec::new();
    let options = WriteOptions {
        version: lif::Version::V1,
        exported: SystemTime::UNIX_EPOCH,
    };
    lif::write_layout(&layout, &mut text, &options).unwrap();
    let again = read(&String::from_utf8(text).unwrap());
    let mut compared = 0;
    for row in 0..layout.paths.len() {
        let is_same = |other: &usize| again.paths.id(*other) == layout.paths.id(row);
        let other = (0..again.paths.len()).find(is_same).unwrap();
        let speed = again.paths.value(other, "maxSpeed");
        assert_eq!(speed, layout.paths.value(row, "maxSpeed"));
        compared += usize::from(speed == Some(Value::Float(1.0)));
    }
    assert!(compared > 60, "{compared} paths of 1 m/s");
}

#[test]
fn plant_models_are_saved_in_their_version() {
    let mut layout = Layout::default();
    layout.provenance.format = "openTCS".into();
    for (version, target) in [
        ("0.0.4", None),
        ("6.0.0", Some(Target::OpenTcs6)),
        ("7.0.0", Some(Target::OpenTcs7)),
    ] {
        layout.provenance.format_version = version.into();
        assert_eq!(Target::of_source(&layout), target, "{version}");
    }
    assert_eq!(
        Target::of_file_name("hall.opentcs.xml"),
        Some(Target::OpenTcs7)
    );
}

/// Speed 0 closes a direction in openTCS, so a two-way path of speed 0 is closed, not opened.
#[test]
fn two_way_paths_of_speed_0_stay_closed_and_are_listed() {
    let mut layout = line();
    layout.paths.set_direction(0, Direction::Both);
    let paths = &mut layout.paths.attributes;
    paths.set_quantity(0, "maxSpeed", 0.0, Quantity::Speed);
    paths.set_quantity(0, "length", 10.0, Quantity::Length);
    let (text, losses) = write(&layout);
    assert!(
        text.contains(r#"maxVelocity="0" maxReverseVelocity="0""#),
        "{text}"
    );
    let of_paths = |losses: &Losses| {
        let all = losses.iter().map(|loss| loss.what.clone());
        all.filter(|what| what != "layout properties")
            .collect::<Vec<_>>()
    };
    assert_eq!(of_paths(&losses), ["directions"]);

    // The way back is open: openTCS has a path from B to A.
    let paths = &mut layout.paths.attributes;
    paths.set_quantity(0, "maxReverseSpeed", 0.5, Quantity::Speed);
    let (text, losses) = write(&layout);
    let again = read(&text);
    let path = again.paths.get(0);
    let ends = [path.start_node(), path.end_node()].map(|node| again.nodes.id(node.unwrap()));
    assert_eq!((ends, path.direction()), (["B", "A"], Direction::Forward));
    assert_eq!(again.paths.value(0, "maxSpeed"), Some(Value::Float(0.5)));
    let expected = [
        "directions",
        "curves",
        "column maxSpeed",
        "column maxReverseSpeed",
    ];
    assert_eq!(of_paths(&losses), expected);
}
