//! Merge of layouts, transforms of layouts, identifiers across layouts, columns of paths.

#![allow(clippy::unwrap_used, reason = "a test may fail by a panic")]

use guideway_layout::{
    Code, Direction, GeoOrigin, Layout, Level, NewPath, PathRef, Paths, Place, Value, check_across,
    merge,
};
use guideway_spline::{Affine, Point, Runs};

/// A layout of one path from one node to another, on a level.
fn layout(source: &str, path: &str, level: (&str, Option<&str>)) -> Layout {
    let mut layout = Layout::default();
    layout.provenance.source = source.into();
    layout.provenance.format = "LIF".into();
    layout.provenance.counts = vec![("edges".into(), 1)];
    layout.levels.push(Level {
        id: level.0.into(),
        name: level.1.map(str::to_owned),
        elevation_m: None,
        ..Level::default()
    });
    let start = layout.nodes.push("N1", Point::new(0.0, 0.0), Some(0));
    let end = layout.nodes.push("N2", Point::new(4.0, 0.0), Some(0));
    layout
        .stations
        .push("S", Some(Point::new(1.0, 1.0)), vec![end], Some(0));
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(4.0, 0.0));
    layout.paths.push(&NewPath {
        id: path,
        runs: &runs,
        start_node: Some(start),
        end_node: Some(end),
        direction: Direction::Both,
        level: Some(0),
        vehicle_types: &["tug"],
    });
    layout.refused.push("R", Code::UnknownNode, "no node");
    let place = || Place::element("somewhere");
    layout.diagnostics.push(Code::Kink, place, String::new, "");
    layout
}

fn text(layout: &Layout, column: &str, path: usize) -> Option<String> {
    let column = layout.paths.attributes.get(column)?;
    column.values.get(path).map(|v| v.to_string())
}

#[test]
fn merges_all_elements_and_keeps_references_within_their_layout() {
    let mut first = layout("a.json", "e", ("hall", Some("Hall")));
    first.paths.attributes.set(0, "speed", Value::Int(2));
    let mut second = layout("b.dxf", "e", ("H", Some("Hall")));
    second.paths.attributes.set(0, "speed", Value::Float(0.5));
    second.paths.set_color_rgba(vec![0xFF00_00FF]);
    second.levels[0].elevation_m = Some(4.0);
    let third = layout("c.json", "f", ("roof", None));
    let all = merge(vec![first, second, third]);

    assert_eq!(
        (all.paths.len(), all.nodes.len(), all.stations.len()),
        (3, 6, 3)
    );
    assert_eq!(all.path_count(), 6);
    assert_eq!(all.diagnostics.count(Code::Kink), 3);
    let levels: Vec<_> = all
        .levels
        .iter()
        .map(|l| (l.id.as_str(), l.elevation_m))
        .collect();
    assert_eq!(levels, [("hall", Some(4.0)), ("roof", None)]);
    for (row, path) in all.paths.iter().enumerate() {
        let first_node = 2 * row as u32;
        assert_eq!(
            (path.start_node(), path.end_node()),
            (Some(first_node), Some(first_node + 1))
        );
        assert_eq!(path.level(), Some(u32::from(row == 2)));
        assert_eq!(path.direction(), Direction::Both);
        assert_eq!(
            all.paths.vehicle_types().of(row).collect::<Vec<_>>(),
            ["tug"]
        );
        assert_eq!(all.stations.nodes(row as u32), [first_node + 1]);
        let source = ["a.json", "b.dxf", "c.json"][row];
        assert_eq!(text(&all, "source", row).as_deref(), Some(source));
    }
    assert_eq!(text(&all, "speed", 0).as_deref(), Some("2"));
    assert_eq!(text(&all, "speed", 1).as_deref(), Some("0.5"));
    assert_eq!(text(&all, "speed", 2), None);
    assert_eq!(all.paths.color_rgba(), Some(&[0, 0xFF00_00FF, 0][..]));
    assert_eq!((all.paths.width_m(), all.paths.rank()), (None, None));
    assert_eq!(all.provenance.source, "a.json, b.dxf, c.json");
    assert_eq!(all.provenance.counts, [("edges".to_owned(), 3)]);
}

#[test]
fn returns_a_single_layout_unchanged_and_an_empty_one_for_none() {
    let one = merge(vec![layout("a.json", "e", ("hall", None))]);
    assert!(one.paths.attributes.get("source").is_none());
    assert_eq!(merge(Vec::new()).path_count(), 0);
}

#[test]
fn keeps_levels_of_one_file_separate_and_its_source_column() {
    let mut first = layout("a.json", "e", ("hall", None));
    first.levels.push(first.levels[0].clone());
    first.paths.attributes.set(0, "source", Value::Text("me"));
    let all = merge(vec![first, layout("b.json", "f", ("hall", None))]);
    assert_eq!(all.levels.len(), 2);
    assert_eq!(text(&all, "source", 0).as_deref(), Some("me"));
    assert_eq!(text(&all, "source_file", 1).as_deref(), Some("b.json"));
}

#[test]
fn transform_maps_paths_nodes_stations_and_widths() {
    let mut moved = layout("a.json", "e", ("hall", None));
    moved.paths.set_width_m(vec![0.5]);
    let quarter = Affine::rotation(std::f64::consts::FRAC_PI_2, Point::default());
    let by = Affine::scale(2.0, 2.0, Point::default()).then(quarter);
    moved.transform(by.then(Affine::translation(Point::new(10.0, 0.0))));
    let near = |p: Point<f64>, x, y| assert!(p.distance(Point::new(x, y)) < 1e-12, "{p:?}");
    near(moved.paths.get(0).ends().unwrap().1, 10.0, 8.0);
    near(moved.nodes.position_m(1), 10.0, 8.0);
    near(moved.stations.position_m(0).unwrap(), 8.0, 2.0);
    assert_eq!(moved.paths.width_m(), Some(&[1.0][..]));
}

#[test]
fn reports_shared_identifiers_in_the_later_files() {
    let mut a = layout("a.json", "e", ("hall", None));
    a.paths.push(&NewPath {
        id: "e",
        ..NewPath::default()
    });
    let b = layout("b.json", "f", ("hall", None));
    let c = layout("c.json", "e", ("hall", None));
    let found = check_across(&[&a, &b, &c]);
    let messages: Vec<Vec<String>> = found
        .iter()
        .map(|of_file| {
            of_file
                .iter()
                .map(|d| format!("{}: {}", d.place, d.message))
                .collect()
        })
        .collect();
    let nodes = [
        "node \"N1\": `a.json` has this identifier too",
        "node \"N2\": `a.json` has this identifier too",
        "station \"S\": `a.json` has this identifier too",
    ];
    assert_eq!(messages[0], [""; 0]);
    assert_eq!(messages[1], nodes);
    assert_eq!(
        messages[2][0],
        "path \"e\": `a.json` has this identifier too"
    );
    assert_eq!(messages[2][1..], nodes);
    assert_eq!(found[2].count(Code::DuplicateId), 4);
}

#[test]
fn layouts_on_earth_get_one_origin() {
    let on_earth = |source: &str, longitude_deg: f64, latitude_deg: f64| {
        let mut layout = layout(source, "E", ("L", None));
        layout.geo_origin = Some(GeoOrigin {
            longitude_deg,
            latitude_deg,
        });
        layout
    };
    // The antimeridian lies between the second and the third.
    let merged = merge(vec![
        on_earth("a", 179.999, 50.0),
        on_earth("b", 179.999, 50.001),
        on_earth("c", -180.0, 50.0),
        layout("d", "E", ("L", None)),
    ]);
    let origin = merged.geo_origin.unwrap();
    assert_eq!((origin.longitude_deg, origin.latitude_deg), (179.999, 50.0));
    let starts: Vec<_> = merged.paths.iter().map(|p| p.ends().unwrap().0).collect();
    // A thousandth of a degree there, on the ellipsoid (PROJ): 71.696 m east, 111.229 m north.
    let expected = [(0.0, 0.0), (0.0, 111.229), (71.696, 0.0), (0.0, 0.0)];
    for (start, (x, y)) in starts.iter().zip(expected) {
        assert!(start.distance(Point::new(x, y)) < 2e-3, "{start:?} {x} {y}");
    }
    for row in 0..8 {
        let path = merged.paths.get(row as usize / 2).ends().unwrap();
        let end = if row % 2 == 0 { path.0 } else { path.1 };
        assert!(merged.nodes.position_m(row).distance(end) < 1e-9);
    }
    let assumed = merged
        .diagnostics
        .iter()
        .filter(|d| d.code == Code::AssumedUnit);
    let places: Vec<_> = assumed.map(|d| d.place.element.as_str()).collect();
    assert_eq!(places, ["d"]);
}

#[test]
fn drawings_without_nodes_stay_drawings() {
    let of_format = |format: &str, has_nodes: bool| {
        let mut layout = layout("a", "E", ("L", None));
        layout.provenance.format = format.into();
        if !has_nodes {
            layout.retain_nodes_and_stations(&[], &[]);
        }
        layout
    };
    let plan = || of_format("DXF", false);
    assert!(plan().is_drawing() && of_format("GeoJSON", false).is_drawing());
    assert!(!of_format("DXF", true).is_drawing() && !of_format("LIF", false).is_drawing());
    assert!(merge(vec![plan(), of_format("SVG", false)]).is_drawing());
    assert!(!merge(vec![plan(), of_format("LIF", false)]).is_drawing());
}

#[test]
fn properties_of_later_paths_leave_earlier_ones_unset() {
    let mut paths = Paths::default();
    paths.push(&NewPath::default());
    paths.push(&NewPath {
        end_node: Some(3),
        direction: Direction::Both,
        level: Some(1),
        ..NewPath::default()
    });
    paths.push(&NewPath::default());
    let indices = |path: PathRef| (path.start_node(), path.end_node(), path.level());
    let (none, some) = ((None, None, None), (None, Some(3), Some(1)));
    assert!(paths.iter().map(indices).eq([none, some, none]));
    let directions = [Direction::Forward, Direction::Both, Direction::Forward];
    assert!(paths.iter().map(PathRef::direction).eq(directions));
}
