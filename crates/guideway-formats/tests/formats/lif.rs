//! LIF: the real files, and every quirk that was seen in one.

use crate::common::{assert_counts, codes, ends, read, real, real_layouts};
use guideway_layout::{CheckOptions, Code, Layout, Severity, Value, check};
use guideway_spline::Point;

/// Counts as the list of sources of the real layouts has them, made by another program.
const REAL: &[(&str, &str)] = &[
    (
        "continua_example.lif.json",
        "layouts 2, nodes 3, edges 2, stations 2, trajectories 1, vehicleTypes 2",
    ),
    (
        "lif100_example01_forward_edge.json",
        "layouts 1, nodes 2, edges 1, vehicleTypes 1",
    ),
    (
        "lif100_example02_bidirectional_edge.json",
        "layouts 1, nodes 2, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example04_omnidirectional_edge.json",
        "layouts 1, nodes 2, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example05_multiple_layouts_in_one_lif.json",
        "layouts 2, nodes 4, edges 2, vehicleTypes 1",
    ),
    (
        "lif100_example06_station_with_one_node.json",
        "layouts 1, nodes 2, edges 2, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example07_station_with_two_nodes.json",
        "layouts 1, nodes 5, edges 6, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example10_station_with_three_nodes_restricted_to_different.json",
        "layouts 1, nodes 6, edges 6, stations 1, vehicleTypes 3",
    ),
    (
        "lif100_example11_multiple_edges_with_load_restrictions.json",
        "layouts 1, nodes 5, edges 8, vehicleTypes 1",
    ),
    (
        "lif100_example13_battery_charging_station.json",
        "layouts 1, nodes 2, edges 2, stations 1, vehicleTypes 1",
    ),
    (
        "lif100_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "layouts 2, nodes 4, edges 5, vehicleTypes 1",
    ),
    (
        "lif100_example16_rack_station_modelled_by_three_nodes.json",
        "layouts 1, nodes 4, edges 6, stations 3, vehicleTypes 1",
    ),
    (
        "lif100_example17_edge_with_trajectory_definition.json",
        "layouts 1, nodes 2, edges 2, trajectories 2, vehicleTypes 1",
    ),
    (
        "lif100_example19_forward_edge_with_two_vehicle_types_with_differi.json",
        "layouts 1, nodes 2, edges 1, vehicleTypes 2",
    ),
    (
        "lif200_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "layouts 2, nodes 4, edges 5, vehicleTypes 1",
    ),
    (
        "lif200_example17_edge_with_trajectory_definition.json",
        "layouts 1, nodes 2, edges 2, trajectories 2, vehicleTypes 1",
    ),
];

const COUNTED: &[&str] = &[
    "layouts",
    "nodes",
    "edges",
    "stations",
    "trajectories",
    "vehicleTypes",
];

/// One layout of two nodes, 10 m apart, and one edge with the properties given.
fn edge_with(properties: &str) -> String {
    format!(
        r#"{{"layouts": [{{"layoutId": "L", "nodes": [
            {{"nodeId": "A", "nodePosition": {{"x": 0, "y": 0}}}},
            {{"nodeId": "B", "nodePosition": {{"x": 10, "y": 0}}}}],
          "edges": [{{"edgeId": "E", "startNodeId": "A", "endNodeId": "B",
            "vehicleTypeEdgeProperties": [{properties}]}}]}}]}}"#
    )
}

fn trajectory(content: &str) -> Layout {
    read(&edge_with(&format!(
        r#"{{"vehicleTypeId": "V", "trajectory": {{{content}}}}}"#
    )))
}

const ARCH: &str =
    r#""controlPoints": [{"x":0,"y":0},{"x":0,"y":5},{"x":10,"y":5},{"x":10,"y":0}]"#;

#[test]
fn real_files_have_the_counts_that_others_find() {
    let Some(folder) = real_layouts("lif") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, expected) in REAL {
        let layout = real("lif", file).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        let stated = if file.starts_with("lif200") {
            "2.0"
        } else {
            "1.0"
        };
        assert_eq!(layout.provenance.format_version, stated, "{file}");
        assert_eq!(layout.provenance.format, "LIF");
        let errors = layout.diagnostics.count_at_least(Severity::Error);
        let broken = u64::from(*file == "continua_example.lif.json");
        assert_eq!(errors > 0, broken > 0, "{file}: {:?}", codes(&layout));
    }
}

#[test]
fn the_official_examples_of_1_0_say_0_11() {
    if let Some(layout) = real("lif", REAL[1].0) {
        assert_eq!(codes(&layout), [Code::Version]);
    }
}

#[test]
fn trajectories_are_drawn_where_they_are_written() {
    if let Some(layout) = real(
        "lif",
        "lif100_example17_edge_with_trajectory_definition.json",
    ) {
        // The curves of this example begin 5.00 m and 11.40 m from their nodes.
        let checked = check(&layout, &CheckOptions::default());
        let gaps: Vec<&str> = checked
            .iter()
            .filter(|d| d.code == Code::NodeGap)
            .map(|d| d.message.as_str())
            .collect();
        for (verb, gap) in [("begins", " 5.000 m from"), ("begins", " 11.400 m from")] {
            let found = gaps.iter().any(|g| g.starts_with(verb) && g.contains(gap));
            assert!(found, "{gaps:?}");
        }
    }
    if let Some(layout) = real(
        "lif",
        "lif200_example17_edge_with_trajectory_definition.json",
    ) {
        let checked = check(&layout, &CheckOptions::default());
        assert_eq!(checked.count(Code::NodeGap), 0);
        let (start, end) = ends(&layout, "N1-N2");
        assert!(start.distance(Point::new(5.0, 0.0)) < 1e-12);
        assert!(end.distance(Point::new(15.0, 0.0)) < 1e-12);
        // y is up: this edge bulges above its nodes, the other way back below.
        let bounds = layout.paths.get(0).hull_bounds().unwrap();
        assert!(bounds.max.y > 3.0 && layout.paths.get(1).hull_bounds().unwrap().min.y < -3.0);
        let types: Vec<&str> = layout.paths.vehicle_types().of(0).collect();
        assert_eq!(types, ["Manufacturer_A Series_1"]);
    }
}

#[test]
fn a_lift_is_not_drawn_across_one_plane() {
    for file in [
        "lif100_example14_two_levels_of_a_facility_in_one_lif_file.json",
        "lif200_example14_two_levels_of_a_facility_in_one_lif_file.json",
    ] {
        let Some(layout) = real("lif", file) else {
            return;
        };
        assert!(!layout.refused.is_empty(), "{file}");
        assert!(layout.refused.iter().all(|r| r.code == Code::CrossLevel));
        assert_eq!(layout.path_count(), 5);
        assert_eq!(layout.levels.len(), 2);
    }
}

#[test]
fn the_malformed_example_shows_its_control_polygon() {
    if let Some(layout) = real("lif", "continua_example.lif.json") {
        assert!(codes(&layout).contains(&Code::TooFewPoints));
        let (start, end) = ends(&layout, "edge-001");
        assert_eq!(start, Point::new(1000.0, 1500.0));
        assert_eq!(end, Point::new(2000.0, 2500.0));
    }
}

#[test]
fn a_degree_may_be_written_with_a_point() {
    let knots = r#""knotVector": [0,0,0,0,1,1,1,1]"#;
    let whole = trajectory(&format!(r#""degree": 3, {knots}, {ARCH}"#));
    let point = trajectory(&format!(r#""degree": 3.0, {knots}, {ARCH}"#));
    assert!(whole.diagnostics.is_empty() && point.diagnostics.is_empty());
    let points = |l: &Layout| {
        l.paths
            .get(0)
            .runs()
            .flat_map(|r| r.iter())
            .collect::<Vec<_>>()
    };
    assert_eq!(points(&whole), points(&point));
    assert_eq!(points(&whole).len(), 4);
}

#[test]
fn absent_knots_are_uniform_and_clamped() {
    for knots in ["", r#""knotVector": null,"#, r#""knotVector": [],"#] {
        let layout = trajectory(&format!(r#""degree": 3, {knots} {ARCH}"#));
        assert_eq!(codes(&layout), [Code::MissingKnots]);
        assert_eq!(layout.paths.geometry().segment_count(), 1);
    }
}

#[test]
fn wrong_knots_show_the_control_polygon_and_say_what_may_be_wrong() {
    let cases = [
        ("[0,0,0,0,1,1,1]", "the order"),
        ("[0,0,0,1,1,1]", "leaves out the first and last"),
        ("[0,0,0,0,1,1,1,0.5]", "knot 7 is 0.5"),
        ("[0,0,0,0,0,0,0,0]", "domain"),
        ("[0,0,0,0,1,1,1,1,1]", "9 knots"),
    ];
    for (knots, part) in cases {
        let layout = trajectory(&format!(r#""degree": 3, "knotVector": {knots}, {ARCH}"#));
        assert_eq!(layout.diagnostics.count(Code::BadKnots), 1, "{knots}");
        let finding = layout.diagnostics.iter().find(|d| d.code == Code::BadKnots);
        let message = &finding.unwrap().message;
        assert!(message.contains(part), "{knots}: {message}");
        assert_eq!(layout.paths.geometry().segment_count(), 3, "three lines");
    }
}

#[test]
fn unclamped_knots_are_drawn_as_they_are() {
    let layout = trajectory(&format!(
        r#""degree": 3, "knotVector": [0,1,2,3,4,5,6,7], {ARCH}"#
    ));
    assert_eq!(codes(&layout), [Code::UnclampedKnots]);
    let (start, _) = ends(&layout, "E");
    assert!(
        start.distance(Point::new(10.0 / 6.0, 25.0 / 6.0)) < 1e-12,
        "{start:?}"
    );
}

#[test]
fn a_weight_that_is_no_weight_counts_as_one() {
    for weight in ["0", "-1", "\"x\""] {
        let points = ARCH.replacen(r#""y":5"#, &format!(r#""y":5,"weight":{weight}"#), 1);
        let layout = trajectory(&format!(
            r#""degree": 3, "knotVector": [0,0,0,0,1,1,1,1], {points}"#
        ));
        let expected = if weight == "\"x\"" {
            Code::WrongType
        } else {
            Code::BadWeight
        };
        assert_eq!(codes(&layout), [expected], "{weight}");
        assert_eq!(layout.paths.geometry().segment_count(), 1);
    }
}

#[test]
fn weights_bend_the_curve() {
    // A quarter circle: the standard quadratic with the middle weight at cos 45 degrees.
    let layout = trajectory(
        r#""degree": 2, "knotVector": [0,0,0,1,1,1], "controlPoints":
           [{"x":0,"y":0},{"x":10,"y":0,"weight":0.7071067811865476},{"x":10,"y":10}]"#,
    );
    let center = Point::new(0.0, 10.0);
    for run in layout.paths.get(0).runs() {
        for segment in run.segments() {
            let middle = guideway_spline::uniform::point(&segment, 0.5);
            assert!((middle.distance(center) - 10.0).abs() < 1e-4);
        }
    }
}

#[test]
fn a_curve_with_no_points_falls_back_to_the_straight_line() {
    for points in [
        "",
        r#""controlPoints": []"#,
        r#""controlPoints": [{"x":1,"y":1}]"#,
    ] {
        let layout = trajectory(points);
        assert_eq!(layout.diagnostics.count(Code::TooFewPoints), 1, "{points}");
        assert_eq!(
            ends(&layout, "E"),
            (Point::new(0.0, 0.0), Point::new(10.0, 0.0))
        );
    }
}

#[test]
fn vehicle_types_share_a_line_and_have_their_own_curves() {
    let curve = format!(r#""trajectory": {{"degree": 3, {ARCH}}}"#);
    let layout = read(&edge_with(&format!(
        r#"{{"vehicleTypeId": "V1", "maxSpeed": 1.5}}, {{"vehicleTypeId": "V2", {curve}}},
           {{"vehicleTypeId": "V3", "maxSpeed": 2}}, {{"vehicleTypeId": "V4", {curve}}}"#
    )));
    let ids: Vec<&str> = layout.paths.iter().map(|p| p.id()).collect();
    assert_eq!(ids, ["E [V1, V3]", "E [V2, V4]"]);
    let types: Vec<&str> = layout.paths.vehicle_types().of(1).collect();
    assert_eq!(types, ["V2", "V4"]);
    let speed = layout.paths.attributes.get("maxSpeed").unwrap();
    assert_eq!(speed.values.get(0), Some(Value::Float(1.5)));
    assert_eq!(speed.values.get(1), None);
    assert!(
        codes(&layout).contains(&Code::Attribute),
        "the speeds of V1 and V3 differ"
    );
}

#[test]
fn attributes_become_columns_under_their_own_names() {
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
    assert_eq!(get("actions").as_deref(), Some("2"));
    assert_eq!(get("orientationType").as_deref(), Some("GLOBAL"));
    assert_eq!(get("loadRestriction.loaded").as_deref(), Some("false"));
    assert_eq!(get("loadRestriction.loadSetNames").as_deref(), Some("a, b"));
    assert_eq!(get("maxHeight"), None);
}

#[test]
fn unknown_nodes_need_a_trajectory() {
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
fn layouts_that_use_the_same_ids_keep_their_own_nodes() {
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
fn messages_show_no_control_characters_of_the_file() {
    let text = edge_with("{}").replace(r#""endNodeId": "B""#, r#""endNodeId": "\u001b[2J""#);
    let layout = read(&text);
    let message = &layout.diagnostics.iter().next().unwrap().message;
    assert!(message.contains(r"\u{1b}[2J"), "{message}");
}

#[test]
fn wrong_types_cost_no_more_than_they_must() {
    let text = edge_with(r#"{"vehicleTypeId": 7, "maxSpeed": "fast"}"#)
        .replace(r#""x": 10"#, r#""x": "10""#)
        .replace(r#""nodeId": "A""#, r#""nodeId": "A", "nodeName": [1]"#);
    let layout = read(&text);
    assert_eq!(codes(&layout), [Code::WrongType]);
    assert_eq!(layout.diagnostics.count(Code::WrongType), 3);
    assert_eq!(ends(&layout, "E").1, Point::new(10.0, 0.0));
    assert_eq!(layout.paths.vehicle_types().of(0).next(), Some("7"));
}

#[test]
fn numbers_are_read_to_the_last_bit() {
    let x = 0.333_333_333_333_333_26_f64;
    let layout = read(&edge_with("{}").replace(r#""x": 10"#, &format!(r#""x": {x:?}"#)));
    assert_eq!(layout.nodes.position_m(1).x.to_bits(), x.to_bits());
}

#[test]
fn a_weighted_curve_becomes_no_more_than_its_share_of_control_points() {
    // So far away that the tolerance is out of reach: each span would become a thousand cubics.
    let curve = |weights: i64| {
        let points: Vec<String> = (0..1_000)
            .map(|i| {
                let (x, weight) = (i % 2 * 900_000_000, i % weights + 1);
                format!(r#"{{"x":{x},"y":9e8,"weight":{weight}}}"#)
            })
            .collect();
        let knots: Vec<String> = (0..1_004_i64)
            .map(|i| i.clamp(3, 1_000).to_string())
            .collect();
        format!(
            r#""degree": 3, "knotVector": [{}], "controlPoints": [{}]"#,
            knots.join(","),
            points.join(",")
        )
    };
    let layout = trajectory(&curve(7));
    assert!(codes(&layout).contains(&Code::ApproximateShape));
    assert_eq!(
        layout.paths.geometry().segment_count(),
        999,
        "the control polygon"
    );
    let layout = trajectory(&curve(1));
    assert!(
        codes(&layout).is_empty(),
        "one without weights is exact and small"
    );
}
