//! Tests of `build`: it joins, cuts, names and maps lines, and refuses some.

use guideway_layout::{Direction, Note, NoteKind, Value};
use guideway_network::{BuildError, BuildOptions, DirectionRule, LayerRule, build};
use guideway_spline::{Point, Runs};

use crate::sketch::{
    add_line, add_runs, add_text, assert_ends_meet, case, drawing, edges_mm, network, quarter,
    split,
};

#[test]
fn drawing_of_the_case_becomes_one_network() {
    let Some(layout) = case("net.dxf") else {
        return;
    };
    let made = network(&layout, &split());
    let expected = [
        [0, 0, 2000, 0],
        [2000, -2000, 2000, 0],
        [2000, 0, 2000, 2000],
        [2000, 0, 5000, 0],
        [5000, 0, 5000, 4000],
        [5000, 0, 10000, 0],
        [10000, 0, 15000, 0],
    ];
    let mut edges = edges_mm(&made.layout);
    for edge in &mut edges {
        // The branch is drawn from its junction, the cross from below.
        if edge[..2] > edge[2..] {
            edge.rotate_left(2);
        }
    }
    edges.sort_unstable();
    assert_eq!(edges, expected);
    assert_ends_meet(&made.layout);
    let stations = &made.layout.stations;
    assert_eq!((stations.len(), stations.id(0)), (1, "PICK-07"));
    let node = stations.nodes(0)[0];
    assert_eq!(made.layout.nodes.position_m(node), Point::new(15.0, 0.0));
    let report = &made.report;
    let done = (
        report.gaps,
        report.junctions,
        report.crossings,
        report.two_way,
    );
    assert_eq!(done, (1, 1, 1, 7));
    assert!((report.largest_move_m - 0.003).abs() < 1e-9);
}

#[test]
fn lines_that_meet_head_on_in_the_case_become_two_way() {
    let Some(layout) = case("two.dxf") else {
        return;
    };
    let made = network(&layout, &split()).layout;
    assert_eq!((made.paths.len(), made.nodes.len()), (2, 3));
    assert!(made.paths.iter().all(|p| p.direction() == Direction::Both));
}

#[test]
fn crossings_stay_apart_by_choice() {
    let layout = drawing(&[[0.0, 0.0, 10.0, 0.0], [2.0, -2.0, 2.0, 2.0]]);
    let bridge = BuildOptions {
        split_crossings: false,
        ..split()
    };
    assert_eq!(network(&layout, &bridge).layout.paths.len(), 2);
    let cut = network(&layout, &split()).layout;
    assert_eq!((cut.paths.len(), cut.nodes.len()), (4, 5));
    assert_eq!(cut.paths.id(0), "1.1");
}

#[test]
fn three_lines_through_one_point_share_a_node() {
    let layout = drawing(&[
        [-5.0, 0.0, 5.0, 0.0],
        [0.0, -5.0, 0.0, 5.0],
        [-5.0, -5.01, 5.0, 5.0],
    ]);
    let made = network(&layout, &split());
    assert_eq!((made.layout.paths.len(), made.layout.nodes.len()), (6, 7));
    assert_eq!(made.report.crossings, 1);
    assert_ends_meet(&made.layout);
}

#[test]
fn ends_meet_curves_and_curves_cross() {
    let mut layout = drawing(&[[0.0, 0.0, 7.05, 7.05], [0.0, 6.0, 9.0, 6.0]]);
    add_runs(&mut layout, &quarter(10.0), "TRACK");
    let made = network(&layout, &split()).layout;
    // The diagonal ends on the arc, the level line crosses both.
    assert_eq!((made.paths.len(), made.nodes.len()), (8, 8));
    assert_ends_meet(&made);
    let nodes = (0..made.nodes.len() as u32).map(|node| made.nodes.position_m(node));
    let on_arc = nodes.filter(|p| (p.norm() - 10.0).abs() < 1e-4).count();
    assert_eq!(on_arc, 4);
}

#[test]
fn an_end_that_touches_its_own_line_makes_a_loop() {
    let mut layout = drawing(&[]);
    let corners = [
        (0.0, 0.0),
        (10.0, 0.0),
        (10.0, 5.0),
        (5.0, 5.0),
        (5.0, 0.01),
    ];
    let corners = corners.map(|(x, y)| Point::new(x, y));
    let mut runs = Runs::default();
    guideway_spline::polyline_to_runs(&corners, &mut runs);
    add_runs(&mut layout, &runs, "TRACK");
    let made = network(&layout, &split()).layout;
    assert_eq!(edges_mm(&made), [[0, 0, 5000, 0], [5000, 0, 5000, 0]]);
    assert_ends_meet(&made);
}

#[test]
fn chain_of_lines_shorter_than_the_weld_distance_stays() {
    let lines = (0..100).map(|i| [f64::from(i) * 0.03, 0.0, f64::from(i + 1) * 0.03, 0.0]);
    let made = network(&drawing(&lines.collect::<Vec<_>>()), &split());
    assert_eq!(
        (made.layout.paths.len(), made.layout.nodes.len()),
        (100, 101)
    );
    assert_eq!((made.report.gaps, made.report.vanished), (0, 0));
}

#[test]
fn gaps_close_up_to_the_weld_distance() {
    for (gap_m, nodes) in [(0.0, 3), (0.049, 3), (0.051, 4)] {
        let layout = drawing(&[[0.0, 0.0, 5.0, 0.0], [5.0 + gap_m, 0.0, 9.0, 0.0]]);
        assert_eq!(
            network(&layout, &split()).layout.nodes.len(),
            nodes,
            "{gap_m}"
        );
    }
}

#[test]
fn layers_map_to_levels_types_speeds_and_directions() {
    let mut layout = drawing(&[]);
    add_line(&mut layout, [0.0, 0.0, 5.0, 0.0], "Main-1");
    add_line(&mut layout, [0.0, 1.0, 5.0, 1.0], "BACK");
    add_line(&mut layout, [0.0, 2.0, 5.0, 2.0], "WALLS");
    add_line(&mut layout, [0.0, 3.0, 5.0, 3.0], "OTHER");
    let options = BuildOptions::from_toml(
        r#"
        other-layers = false
        [[layer]]
        name = "MAIN*"
        level = "ground"
        vehicle-types = ["tugger"]
        max-speed = 1.5
        [[layer]]
        name = "back"
        direction = "backward"
        [[layer]]
        name = "WALLS"
        leave = true
        "#,
    )
    .unwrap();
    let made = network(&layout, &options);
    let paths = &made.layout.paths;
    assert_eq!((paths.len(), made.report.paths_left), (2, 2));
    assert_eq!(paths.get(0).level(), made.layout.level_named("ground"));
    assert!(paths.vehicle_types().of(0).eq(["tugger"]));
    assert_eq!(
        paths.value_for(0, "tugger", "maxSpeed"),
        Some(Value::Float(1.5))
    );
    assert_eq!(paths.get(1).direction(), Direction::Forward);
    assert_eq!(paths.get(1).ends().unwrap().0, Point::new(5.0, 1.0));
    assert_eq!(paths.get(0).direction(), Direction::Both);
    assert_ends_meet(&made.layout);
}

#[test]
fn options_survive_toml_and_mistakes_have_a_line() {
    let options = BuildOptions {
        smooth_m: Some(0.02),
        layers: vec![LayerRule {
            name: "A".into(),
            direction: Some(DirectionRule::Forward),
            max_speed_m_s: Some(2.0),
            ..LayerRule::default()
        }],
        ..split()
    };
    let text = options.to_toml().unwrap();
    assert_eq!(BuildOptions::from_toml(&text).unwrap(), options, "{text}");
    for (bad, said) in [
        ("weld = 0.1\nwelt = 2", "welt"),
        ("weld = \"far\"", "line 1"),
        ("stations = [\"texts\"]", "text:LAYER"),
        ("weld = -1.0", "`weld` is -1"),
        ("smooth = nan", "`smooth` is NaN"),
    ] {
        let error = BuildOptions::from_toml(bad).unwrap_err().to_string();
        assert!(error.contains(said), "{bad}: {error}");
    }
}

#[test]
fn levels_are_never_welded() {
    let mut layout = drawing(&[]);
    add_line(&mut layout, [0.0, 0.0, 5.0, 0.0], "G");
    add_line(&mut layout, [5.02, 0.0, 9.0, 0.0], "U");
    add_line(&mut layout, [3.0, -1.0, 3.0, 1.0], "U");
    let level = |name: &str| LayerRule {
        name: name.into(),
        level: Some(name.to_lowercase()),
        ..LayerRule::default()
    };
    let mut options = BuildOptions {
        layers: vec![level("G"), level("U")],
        ..split()
    };
    let error = build(&layout, &options).unwrap_err();
    let said = error.to_string();
    assert!(
        matches!(error, BuildError::Levels { count: 1, .. }),
        "{said}"
    );
    assert!(
        said.contains("level \"g\"") && said.contains("(5.020, 0.000) m"),
        "{said}"
    );
    options.levels_apart = true;
    let made = network(&layout, &options).layout;
    assert_eq!((made.paths.len(), made.nodes.len()), (3, 6));
}

#[test]
fn notes_name_the_nearest_node_or_cut_the_line() {
    let mut layout = drawing(&[[0.0, 0.0, 10.0, 0.0]]);
    add_text(&mut layout, "END", 9.5, 0.5);
    add_text(&mut layout, "MIDDLE", 4.0, 0.6);
    add_text(&mut layout, "FAR", 4.0, 3.0);
    let made = network(&layout, &split());
    assert_eq!(
        edges_mm(&made.layout),
        [[0, 0, 4000, 0], [4000, 0, 10000, 0]]
    );
    let stations = &made.layout.stations;
    assert_eq!((stations.id(0), stations.id(1)), ("END", "MIDDLE"));
    assert_eq!(made.report.left_note_count, 1);
    assert_eq!(made.report.left_notes[0].name, "FAR");
}

#[test]
fn blocks_points_and_circles_take_the_texts_beside_them() {
    let mut layout = drawing(&[[0.0, 0.0, 10.0, 0.0], [10.0, 0.0, 20.0, 0.0]]);
    add_text(&mut layout, "P-1", 0.3, 0.3);
    for (kind, text, block, x) in [
        (NoteKind::Point, "", "", 0.0),
        (NoteKind::Block, "B-2", "DOCK", 10.0),
        (NoteKind::Block, "", "DOCK", 20.0),
    ] {
        layout.notes.push(Note {
            kind,
            text: text.into(),
            block: block.into(),
            layer: "S".into(),
            position_m: Point::new(x, 0.0),
        });
    }
    let options = BuildOptions {
        stations: vec!["point:S".parse().unwrap(), "block:dock".parse().unwrap()],
        names: vec!["text:STATION".parse().unwrap()],
        ..split()
    };
    let made = network(&layout, &options).layout;
    let names: Vec<&str> = (0..3).map(|row| made.stations.id(row)).collect();
    assert_eq!(names, ["P-1", "B-2", "DOCK-4"]);
    assert_eq!(made.nodes.id(made.stations.nodes(0)[0]), "P-1");
}

#[test]
fn two_stations_of_one_name_are_refused() {
    let mut layout = drawing(&[[0.0, 0.0, 10.0, 0.0]]);
    add_text(&mut layout, "A", 0.0, 0.0);
    add_text(&mut layout, "A", 10.0, 0.0);
    let error = build(&layout, &split()).unwrap_err().to_string();
    assert!(
        error.contains("\"A\": at (0.000, 0.000) m and at (10.000"),
        "{error}"
    );
    // Twice at one place is one station.
    layout.notes[1].position_m = Point::new(0.1, 0.0);
    assert_eq!(network(&layout, &split()).layout.stations.len(), 1);
}

#[test]
fn lines_drawn_twice_and_dots_are_left() {
    let layout = drawing(&[
        [0.0, 0.0, 10.0, 0.0],
        [10.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 5.0, 0.0],
        [3.0, 3.0, 3.0, 3.0],
        [7.0, 0.0, 7.02, 0.0],
    ]);
    let made = network(&layout, &split());
    assert_ends_meet(&made.layout);
    assert_eq!(
        (made.report.dots, made.layout.nodes.len()),
        (1, 5),
        "{:?}",
        made.report
    );
    assert_eq!(
        edges_mm(&made.layout).len(),
        4,
        "{:?}",
        edges_mm(&made.layout)
    );
}

#[test]
fn nodes_that_a_weld_leaves_are_listed_with_their_values() {
    let mut layout = drawing(&[[0.0, 0.0, 10.0, 0.0], [10.002, 0.0, 20.0, 0.0]]);
    for (row, x) in [0.0, 10.0, 10.002, 20.0, 50.0].into_iter().enumerate() {
        let at = Point::new(x, 0.0);
        let types: &[&str] = if row == 2 { &["tug"] } else { &[] };
        layout
            .nodes
            .push_for_types(&format!("n{row}"), at, None, types);
        let nodes = &mut layout.nodes.attributes;
        nodes.set(row, "use", Value::Text("stop"));
    }
    let of_types = &mut layout.nodes.vehicle_types_mut().attributes;
    of_types.set(0, "theta", Value::Float(1.0));
    layout.paths.set_nodes(0, Some(0), Some(1));
    layout.paths.set_nodes(1, Some(2), Some(3));
    let made = network(&layout, &split());
    // One of the two at the gap, and the one at no line.
    assert_eq!((made.layout.nodes.len(), made.report.nodes_left), (3, 2));
    let values = made.report.values_left.iter();
    let values: Vec<_> = values
        .map(|(name, count)| (name.as_str(), *count))
        .collect();
    assert_eq!(values, [("theta", 1), ("use", 2)]);
}

#[test]
fn limits_stop_with_their_value() {
    let grid = |n: u32| -> Vec<[f64; 4]> {
        let lines = (0..n).map(f64::from);
        let (n, lines) = (f64::from(n), lines.map(|i| i + 0.5));
        lines
            .flat_map(|i| [[i, 0.0, i, n], [0.0, i, n, i]])
            .collect()
    };
    let options = BuildOptions {
        max_pieces: 100,
        ..split()
    };
    let error = build(&drawing(&grid(20)), &options).unwrap_err();
    assert_eq!(error, BuildError::Pieces { limit: 100 });
    let star = |i: u32| {
        let (sin, cos) = (f64::from(i) * 0.01).sin_cos();
        [0.0, 0.0, 100.0 * cos, 100.0 * sin]
    };
    let star = drawing(&(0..150).map(star).collect::<Vec<_>>());
    let options = BuildOptions {
        max_pieces: 400,
        ..split()
    };
    let error = build(&star, &options).unwrap_err();
    assert_eq!(error, BuildError::Pairs { limit: 8000 });
    let heap: Vec<_> = (0..2000)
        .map(|i| [f64::from(i) * 1e-5, 0.0, 1.0, 5.0])
        .collect();
    let error = build(&drawing(&heap), &split()).unwrap_err();
    assert!(
        matches!(error, BuildError::Crowded { limit: 1000, .. }),
        "{error}"
    );
}
