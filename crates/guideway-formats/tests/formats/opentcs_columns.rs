//! Tests of columns of the openTCS reader: speeds, positions, envelopes, unknown parts.

use crate::common::{codes, read, real};
use crate::opentcs::{REAL, model, path};
use guideway_layout::{Code, Direction, Value};

#[test]
fn speeds_tell_the_direction() {
    let speeds = |forward: &str, reverse: &str| {
        read(&model(&format!(
            r#"<path name="P" sourcePoint="A" destinationPoint="B" {forward} {reverse}/>"#
        )))
    };
    let forward = r#"maxVelocity="500""#;
    let closed = r#"maxVelocity="0""#;
    for (forward, reverse, start, direction, speed, back) in [
        (
            forward,
            r#"maxReverseVelocity="0""#,
            0,
            Direction::Forward,
            Some(0.5),
            None,
        ),
        (
            forward,
            r#"maxReverseVelocity="500""#,
            0,
            Direction::Both,
            Some(0.5),
            None,
        ),
        (
            forward,
            r#"maxReverseVelocity="200""#,
            0,
            Direction::Both,
            Some(0.5),
            Some(0.2),
        ),
        (
            closed,
            r#"maxReverseVelocity="200""#,
            1,
            Direction::Forward,
            Some(0.2),
            None,
        ),
        (
            closed,
            r#"maxReverseVelocity="0""#,
            0,
            Direction::Forward,
            Some(0.0),
            None,
        ),
        ("", "", 0, Direction::Forward, None, None),
    ] {
        let layout = speeds(forward, reverse);
        let path = layout.paths.get(0);
        let what = format!("{forward} {reverse}");
        assert_eq!(path.start_node(), Some(start), "{what}");
        assert_eq!(path.direction(), direction, "{what}");
        let start_m = layout.nodes.position_m(start);
        assert!(path.ends().unwrap().0.distance(start_m) < 1e-9, "{what}");
        let value = |name: &str| layout.paths.value(0, name);
        assert_eq!(value("maxSpeed"), speed.map(Value::Float), "{what}");
        assert_eq!(value("maxReverseSpeed"), back.map(Value::Float), "{what}");
        let is_reversed = value("reversed") == Some(Value::Bool(true));
        assert_eq!(is_reversed, start == 1, "{what}");
    }
    let negative = speeds(r#"maxVelocity="-5""#, "");
    assert_eq!(codes(&negative), [Code::UnknownValue]);
    let other = negative.paths.value(0, "other");
    assert_eq!(other, Some(Value::Json(r#"{"maxVelocity":"-5"}"#)));
}

#[test]
fn keeps_both_positions_of_a_point() {
    let Some(layout) = real("opentcs", REAL[0].0) else {
        return;
    };
    let value = |name: &str| layout.nodes.attributes.value(0, name);
    assert_eq!(value("positionX"), Some(Value::Float(53.288)));
    assert_eq!(value("positionY"), Some(Value::Float(-3.893)));
    assert_eq!(value("positionZ"), None);
}

#[test]
fn keeps_what_it_does_not_know() {
    let layout = read(&model(
        r#"<path name="P" sourcePoint="A" destinationPoint="B" tilt="3"><ramp grade="5"/></path>
           <group name="G"><member name="A"/></group>"#,
    ));
    let other = layout.paths.value(0, "other");
    let expected = r#"{"ramp":[{"grade":"5"}],"tilt":"3"}"#;
    assert_eq!(other, Some(Value::Json(expected)));
    let other = layout.attributes.value(0, "other").unwrap().to_string();
    assert_eq!(other, r#"{"group":[{"member":[{"name":"A"}],"name":"G"}]}"#);
}

#[test]
fn stores_envelope_keys_and_areas_in_columns() {
    let corner = |x: &str, y: &str| format!(r#"<vertex x="{x}" y="{y}"/>"#);
    let square = corner("0", "0") + &corner("1000", "0") + &corner("1000", "-2500");
    let line = corner("0", "0") + &corner("1", "0");
    let open = format!(
        r#"<vehicleEnvelope key="a">{square}</vehicleEnvelope>
        <vehicleEnvelope key="b">{line}</vehicleEnvelope>"#
    );
    let layout = path(&open);
    let text = |name: &str| layout.paths.attributes.get(name).unwrap().values.get(0);
    assert_eq!(text("vehicleEnvelope"), Some(Value::Json(r#"["a"]"#)));
    let other = text("other").unwrap().to_string();
    assert!(other.contains(r#""key":"b""#), "{other}");
    let area = "[[[[0.0,0.0],[1.0,0.0],[1.0,-2.5],[0.0,0.0]]]]";
    assert_eq!(text("vehicleEnvelope.area"), Some(Value::Json(area)));
    assert_eq!(layout.diagnostics.count(Code::MissingField), 1);
    let wrong = [
        corner("x", "0"),
        corner("1e300", "0"),
        r#"<vertex x="4"/>"#.into(),
    ];
    for (corner, code) in wrong
        .iter()
        .zip([Code::WrongType, Code::OutOfRange, Code::MissingField])
    {
        let layout = path(&format!(
            "<vehicleEnvelope>{square}{corner}</vehicleEnvelope>"
        ));
        assert_eq!(layout.diagnostics.count(code), 1, "{corner}");
        assert!(
            layout
                .paths
                .attributes
                .get("vehicleEnvelope.area")
                .is_none()
        );
    }
}

#[test]
fn reads_the_areas_of_a_real_file() {
    let Some(layout) = real("opentcs", "Demo-01_v7.0.0.xml") else {
        return;
    };
    let tables = [(&layout.paths.attributes, 4), (&layout.nodes.attributes, 8)];
    for (attributes, expected) in tables {
        let areas = &attributes.get("vehicleEnvelope.area").unwrap().values;
        let present = (0..areas.len()).filter(|&row| areas.get(row).is_some());
        assert_eq!(present.count(), expected);
    }
}
