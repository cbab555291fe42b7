//! Tests of `analyze`: each fault of a network is found once.

use std::f64::consts::PI;

use guideway_layout::{Code, Direction, Layout, NewPath, Severity, Value};
use guideway_network::{AnalyzeOptions, analyze};
use guideway_spline::{Point, Runs};

use crate::sketch::{case, network, quarter, split};

/// Places and messages of the findings of a code.
fn found(layout: &Layout, code: Code) -> Vec<(String, String)> {
    let options = AnalyzeOptions {
        lateral_acceleration_m_s2: Some(1.0),
        ..AnalyzeOptions::default()
    };
    let found = analyze(layout, &options);
    let of_code = found.iter().filter(|f| f.code == code);
    of_code
        .map(|f| (f.place.element.clone(), f.message.clone()))
        .collect()
}

fn places(layout: &Layout, code: Code) -> Vec<String> {
    found(layout, code)
        .into_iter()
        .map(|(place, _)| place)
        .collect()
}

/// A network of straight edges between nodes, whose first letter is their identifier.
fn network_of(
    nodes: &[(&str, f64, f64)],
    edges: &[(&str, &str, Direction)],
    types: &[&str],
) -> Layout {
    let mut layout = Layout::default();
    for &(id, x, y) in nodes {
        layout.nodes.push(id, Point::new(x, y), None);
    }
    for &(from, to, direction) in edges {
        add_edge(&mut layout, from, to, direction, types);
    }
    layout
}

fn add_edge(layout: &mut Layout, from: &str, to: &str, direction: Direction, types: &[&str]) {
    let row = |id: &str| {
        (0..layout.nodes.len() as u32)
            .find(|&n| layout.nodes.id(n) == id)
            .unwrap()
    };
    let (start, end) = (row(from), row(to));
    let mut runs = Runs::default();
    runs.push_line(layout.nodes.position_m(start), layout.nodes.position_m(end));
    layout.paths.push(&NewPath {
        id: &format!("{from}{to}"),
        runs: &runs,
        start_node: Some(start),
        end_node: Some(end),
        direction,
        vehicle_types: types,
        ..NewPath::default()
    });
}

use Direction::{Both, Forward};

#[test]
fn dead_case_names_the_part_the_trap_and_both_stations() {
    let Some(layout) = case("dead.lif.json") else {
        return;
    };
    assert_eq!(places(&layout, Code::NotConnected), ["node \"x\""]);
    assert_eq!(places(&layout, Code::DeadEnd), ["node \"d\"", "node \"y\""]);
    let stations = found(&layout, Code::UnreachableStation);
    assert_eq!(stations[0].0, "station \"PICK\"");
    assert!(stations[0].1.contains("neither reach nor leave"));
    assert_eq!(stations[1].0, "station \"DROP\"");
    assert!(stations[1].1.contains("not leave"));
}

#[test]
fn corner_case_names_the_corner_and_the_stations() {
    let Some(layout) = case("corner.lif.json") else {
        return;
    };
    let corner = found(&layout, Code::HeadingJump);
    assert_eq!(corner.len(), 1);
    assert_eq!(corner[0].0, "node \"B\"");
    assert!(corner[0].1.contains("jumps by 90.0°"), "{}", corner[0].1);
    let without = places(&layout, Code::StationWithoutNode);
    assert_eq!(without, ["station \"S2\"", "station \"S3\""]);
    assert_eq!(places(&layout, Code::NotConnected), ["node \"D\""]);
    assert_eq!(places(&layout, Code::UnreachableStation), ["station \"S\""]);
}

#[test]
fn drawings_are_no_networks_and_meet_head_on() {
    let Some(layout) = case("two.dxf") else {
        return;
    };
    let found = analyze(&layout, &AnalyzeOptions::default());
    assert_eq!(
        (found.count(Code::NoNodes), found.count(Code::HeadOn)),
        (1, 1)
    );
    let head_on = found.iter().find(|f| f.code == Code::HeadOn).unwrap();
    assert!(
        head_on.message.contains("(10.000, 0.000) m"),
        "{}",
        head_on.message
    );
    assert_eq!(found.count_at_least(Severity::Warning), 0);
}

#[test]
fn built_case_has_nothing_above_info() {
    let Some(layout) = case("net.dxf") else {
        return;
    };
    let made = network(&layout, &split()).layout;
    let found = analyze(&made, &AnalyzeOptions::default());
    assert_eq!(found.count_at_least(Severity::Warning), 0);
    // The ends of the main line, the branch and the cross; the station has none.
    assert_eq!(found.count(Code::DeadEnd), 4);
}

#[test]
fn ring_with_return_is_clean_and_one_way_parts_are_found() {
    let nodes = [
        ("a", 0.0, 0.0),
        ("b", 9.0, 0.0),
        ("c", 9.0, 9.0),
        ("d", 0.0, 9.0),
    ];
    let ring = [
        ("a", "b", Forward),
        ("b", "c", Forward),
        ("c", "d", Forward),
        ("d", "a", Forward),
    ];
    let layout = network_of(&nodes, &ring, &[]);
    assert!(analyze(&layout, &AnalyzeOptions::default()).is_empty());
    let more = [nodes.as_slice(), &[("e", 20.0, 0.0), ("f", 30.0, 0.0)]].concat();
    let lead = [ring.as_slice(), &[("b", "e", Forward), ("e", "f", Both)]].concat();
    let part = found(&network_of(&more, &lead, &[]), Code::OneWayPart);
    assert_eq!(part.len(), 1);
    assert!(part[0].0 == "node \"e\"" && part[0].1.contains("enter this part of 2 nodes, but not"));
}

#[test]
fn each_level_has_a_network_of_its_own() {
    let nodes = [
        ("a", 0.0, 0.0),
        ("b", 9.0, 0.0),
        ("c", 0.0, 0.0),
        ("d", 9.0, 0.0),
    ];
    let mut layout = network_of(&nodes, &[("a", "b", Both), ("c", "d", Both)], &[]);
    for node in 0..4 {
        layout
            .stations
            .push(&format!("S{node}"), None, vec![node], None);
    }
    assert_eq!(places(&layout, Code::NotConnected), ["node \"c\""]);
    assert_eq!(places(&layout, Code::UnreachableStation).len(), 2);
    for node in 0..4 {
        layout.nodes.set_level(node, Some(node / 2));
    }
    assert!(analyze(&layout, &AnalyzeOptions::default()).is_empty());
}

#[test]
fn head_on_is_one_finding_and_no_dead_end() {
    let nodes = [("a", 0.0, 0.0), ("b", 9.0, 0.0), ("c", 18.0, 0.0)];
    let layout = network_of(&nodes, &[("a", "b", Forward), ("c", "b", Forward)], &[]);
    assert_eq!(places(&layout, Code::HeadOn), ["node \"b\""]);
    assert_eq!(places(&layout, Code::DeadEnd), [""; 0]);
}

#[test]
fn findings_name_the_vehicle_types_they_concern() {
    let nodes = [("a", 0.0, 0.0), ("b", 9.0, 0.0), ("c", 18.0, 0.0)];
    let mut layout = network_of(&nodes, &[("a", "b", Both)], &["tug", "fork"]);
    add_edge(&mut layout, "b", "c", Forward, &["fork"]);
    layout.stations.push("S", None, vec![2], None);
    layout.stations.push("T", None, vec![0], None);
    let station = found(&layout, Code::UnreachableStation);
    assert_eq!(station.len(), 1);
    assert!(
        station[0]
            .1
            .ends_with("not leave it, for vehicle type \"fork\""),
        "{}",
        station[0].1
    );
    let trap = found(&layout, Code::DeadEnd);
    assert!(trap.iter().any(|(place, _)| place == "node \"c\""));
    // Locked paths are closed.
    layout.paths.attributes.set(1, "locked", Value::Bool(true));
    assert!(found(&layout, Code::UnreachableStation).is_empty());
}

/// A corner of 90 degrees, with rotation rules at its node.
fn corner(at_end: &str, at_start: &str) -> Layout {
    let nodes = [("a", 0.0, 0.0), ("b", 9.0, 0.0), ("c", 9.0, 9.0)];
    let mut layout = network_of(&nodes, &[("a", "b", Forward), ("b", "c", Forward)], &[]);
    let attributes = &mut layout.paths.attributes;
    attributes.set(0, "rotationAtEndNodeAllowed", Value::Text(at_end));
    attributes.set(1, "rotationAtStartNodeAllowed", Value::Text(at_start));
    layout
}

#[test]
fn turns_follow_the_rules_and_the_orientation() {
    assert_eq!(
        places(&corner("NONE", "NONE"), Code::HeadingJump),
        ["node \"b\""]
    );
    for (end, start) in [("BOTH", "NONE"), ("NONE", "CW"), ("CCW", "BOTH")] {
        assert!(
            places(&corner(end, start), Code::HeadingJump).is_empty(),
            "{end} {start}"
        );
    }
    // A vehicle that keeps its heading in the frame of the map drives sideways.
    let mut sideways = corner("NONE", "NONE");
    for row in 0..2 {
        let attributes = &mut sideways.paths.attributes;
        attributes.set(row, "orientationType", Value::Text("GLOBAL"));
        attributes.set(row, "vehicleOrientation", Value::Float(0.5));
    }
    assert!(places(&sideways, Code::HeadingJump).is_empty());
    // Straight on is enough at a crossing.
    let mut crossing = corner("NONE", "NONE");
    crossing.nodes.push("d", Point::new(18.0, 0.0), None);
    crossing.nodes.push("e", Point::new(9.0, -9.0), None);
    add_edge(&mut crossing, "b", "d", Forward, &[]);
    add_edge(&mut crossing, "e", "b", Forward, &[]);
    assert!(places(&crossing, Code::HeadingJump).is_empty());
}

#[test]
fn way_back_needs_rotation_or_orientation() {
    let nodes = [("a", 0.0, 0.0), ("b", 9.0, 0.0)];
    let mut layout = network_of(&nodes, &[("a", "b", Forward), ("b", "a", Forward)], &[]);
    for row in 0..2 {
        for name in ["rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed"] {
            layout.paths.attributes.set(row, name, Value::Text("NONE"));
        }
    }
    assert_eq!(places(&layout, Code::ReverseDriving).len(), 2);
    layout
        .paths
        .attributes
        .set(0, "vehicleOrientation", Value::Float(0.0));
    layout
        .paths
        .attributes
        .set(1, "vehicleOrientation", Value::Float(PI));
    assert!(places(&layout, Code::ReverseDriving).is_empty());
    assert!(places(&layout, Code::HeadingJump).is_empty());
    layout
        .paths
        .attributes
        .set(1, "vehicleOrientation", Value::Float(0.0));
    assert_eq!(places(&layout, Code::HeadingJump).len(), 2);
}

#[test]
fn speed_must_fit_the_tightest_bend() {
    for (speed, count) in [(2.2, 0), (2.3, 1)] {
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            id: "bend",
            runs: &quarter(5.0),
            ..NewPath::default()
        });
        layout
            .paths
            .attributes
            .set(0, "maxSpeed", Value::Float(speed));
        let bends = found(&layout, Code::LateralAcceleration);
        assert_eq!(bends.len(), count, "{speed}: {bends:?}");
    }
}

#[test]
fn findings_of_many_types_are_bounded_and_say_so() {
    let nodes = [("a", 0.0, 0.0), ("b", 9.0, 0.0)];
    let mut layout = network_of(&nodes, &[], &[]);
    let names: Vec<String> = (0..100).map(|i| format!("type {i}")).collect();
    for name in &names {
        add_edge(&mut layout, "a", "b", Forward, &[name]);
    }
    let limited = found(&layout, Code::NotAnalyzed);
    assert!(limited[0].1.contains("100 vehicle types"), "{limited:?}");
}
