//! Tests of the Lanelet2 reader: a real map, and center lines between bounds.

use crate::common::{assert_counts, codes, ends, read, read_real, real, real_cases};
use guideway_layout::{Code, Direction, Layout, Value};
use guideway_spline::Point;

#[test]
fn real_map_has_the_expected_counts() {
    let Some(layout) = real("lanelet2", "mapping_example.osm") else {
        return;
    };
    let expected = "nodes 2258, ways 1141, lanelets 371";
    assert_counts(
        &layout,
        &["nodes", "ways", "lanelets"],
        expected,
        "mapping_example.osm",
    );
    assert_eq!(layout.path_count(), 1141 + 371);
    // The editor marked one way as deleted.
    assert_eq!(layout.refused.len(), 1);
    assert_eq!(layout.refused.iter().next().unwrap().code, Code::NotDrawn);
}

/// Reads a map in local meters: nodes, ways of node indices, and one lanelet.
fn map(nodes: &[(f64, f64)], ways: &[&[usize]], members: &str, tags: &str) -> Layout {
    let node = |(i, (x, y)): (usize, &(f64, f64))| {
        format!("<node id='{i}'><tag k='local_x' v='{x}'/><tag k='local_y' v='{y}'/></node>")
    };
    let nodes: String = nodes.iter().enumerate().map(node).collect();
    let way = |(i, nodes): (usize, &&[usize])| {
        let references: String = nodes.iter().map(|n| format!("<nd ref='{n}'/>")).collect();
        format!("<way id='w{i}'>{references}</way>")
    };
    let ways: String = ways.iter().enumerate().map(way).collect();
    read(&format!(
        "<osm version='0.6'>{nodes}{ways}<relation id='L'>{members}\
         <tag k='type' v='lanelet'/>{tags}</relation></osm>"
    ))
}

const BOUNDS: &str =
    "<member type='way' ref='w0' role='left'/><member type='way' ref='w1' role='right'/>";

#[test]
fn lanelet_has_its_left_bound_on_the_left() {
    let nodes = [(0.0, 4.0), (9.0, 4.0), (0.0, 0.0), (9.0, 0.0)];
    // For every combination of way directions.
    for ways in [
        [[0, 1], [2, 3]],
        [[1, 0], [2, 3]],
        [[0, 1], [3, 2]],
        [[1, 0], [3, 2]],
    ] {
        let layout = map(&nodes, &[&ways[0], &ways[1]], BOUNDS, "");
        let found = ends(&layout, "L");
        assert_eq!(
            found,
            (Point::new(0.0, 2.0), Point::new(9.0, 2.0)),
            "{ways:?}"
        );
    }
    let other =
        "<member type='way' ref='w1' role='left'/><member type='way' ref='w0' role='right'/>";
    let layout = map(&nodes, &[&[0, 1], &[2, 3]], other, "");
    assert_eq!(
        ends(&layout, "L"),
        (Point::new(9.0, 2.0), Point::new(0.0, 2.0))
    );
    assert!(codes(&layout).is_empty());
}

#[test]
fn center_line_in_the_file_takes_precedence() {
    let nodes = [
        (0.0, 4.0),
        (9.0, 4.0),
        (0.0, 0.0),
        (9.0, 0.0),
        (0.0, 3.0),
        (9.0, 3.0),
    ];
    let members = format!("{BOUNDS}<member type='way' ref='w2' role='centerline'/>");
    let layout = map(&nodes, &[&[0, 1], &[2, 3], &[4, 5]], &members, "");
    assert_eq!(
        ends(&layout, "L"),
        (Point::new(0.0, 3.0), Point::new(9.0, 3.0))
    );
}

#[test]
fn speed_limits_are_in_meters_per_second() {
    let nodes = [(0.0, 4.0), (9.0, 4.0), (0.0, 0.0), (9.0, 0.0)];
    let value = |limit: &str, column: &str| {
        let tags = format!("<tag k='speed_limit' v='{limit}'/>");
        let layout = map(&nodes, &[&[0, 1], &[2, 3]], BOUNDS, &tags);
        let lanelet = layout.paths.iter().find(|path| path.id() == "L").unwrap();
        let value = layout.paths.attributes.value(lanelet.row(), column);
        value.map(|value| value.to_string())
    };
    for (limit, speed) in [("36", "10"), ("36 km/h", "10"), ("100mph", "44.704")] {
        assert_eq!(value(limit, "maxSpeed").as_deref(), Some(speed), "{limit}");
        assert_eq!(value(limit, "speed_limit"), None);
    }
    assert_eq!(value("walking", "maxSpeed"), None);
    assert_eq!(value("walking", "speed_limit").as_deref(), Some("walking"));
}

#[test]
fn reads_tags_as_columns_and_directions() {
    let nodes = [(0.0, 4.0), (9.0, 4.0), (0.0, 0.0), (9.0, 0.0)];
    let tags = "<tag k='one_way' v='no'/><tag k='subtype' v='road'/>";
    let layout = map(&nodes, &[&[0, 1], &[2, 3]], BOUNDS, tags);
    let lanelet = layout.paths.iter().find(|path| path.id() == "L").unwrap();
    assert_eq!(lanelet.direction(), Direction::Both);
    let value = |name| {
        layout
            .paths
            .attributes
            .get(name)
            .unwrap()
            .values
            .get(lanelet.row())
    };
    assert_eq!(value("subtype"), Some(Value::Text("road")));
    assert_eq!(value("element"), Some(Value::Text("lanelet")));
    let layout = map(&nodes, &[&[0, 1], &[2, 3]], BOUNDS, "");
    assert_eq!(
        layout.paths.get(2).direction(),
        Direction::Forward,
        "one-way by default"
    );
}

#[test]
fn projects_degrees_about_the_center_and_reports_it() {
    let layout = read(
        "<osm version='0.6'><node id='1' lat='49' lon='8.4'/><node id='2' lat='49' lon='8.41'/>\
         <way id='w'><nd ref='1'/><nd ref='2'/></way></osm>",
    );
    let (start, end) = ends(&layout, "w");
    // A hundredth of a degree of longitude at 49 degrees north, on the ellipsoid.
    assert!(
        (start.distance(end) - 731.74).abs() < 0.05,
        "{}",
        start.distance(end)
    );
    assert_eq!(
        codes(&layout),
        [Code::AssumedUnit, Code::Implausible],
        "the projection, and no lanelet"
    );
}

#[test]
fn refuses_a_lanelet_without_a_bound() {
    let nodes = [(0.0, 4.0), (9.0, 4.0)];
    let layout = map(&nodes, &[&[0, 1]], BOUNDS, "");
    assert_eq!(layout.paths.len(), 1);
    assert_eq!(
        layout.refused.iter().next().unwrap().code,
        Code::UnknownNode
    );
}

/// A map of a lanelet between two ways along x; the local x of the nodes of each way.
fn local_map(xs: [f64; 3], degrees: bool) -> Layout {
    let nodes: String = [0, 10]
        .iter()
        .flat_map(|&row| xs.iter().zip(0..).map(move |(x, i)| (row, x, i)))
        .map(|(row, x, i)| {
            let place = match degrees {
                true => format!("lat='49' lon='{}'", 8.0 + f64::from(i) * 1e-4),
                false => String::new(),
            };
            format!(
                "<node id='{}' {place}><tag k='local_x' v='{x}'/>\
                 <tag k='local_y' v='{row}'/></node>",
                row + i
            )
        })
        .collect();
    let way = |id: i32, first: i32| {
        let nodes: String = (first..first + 3)
            .map(|i| format!("<nd ref='{i}'/>"))
            .collect();
        format!("<way id='{id}'>{nodes}</way>")
    };
    let member = |role: &str, id| format!("<member type='way' role='{role}' ref='{id}'/>");
    read(&format!(
        "<osm>{nodes}{}{}<relation id='200'>{}{}<tag k='type' v='lanelet'/></relation></osm>",
        way(100, 0),
        way(101, 10),
        member("left", 101),
        member("right", 100)
    ))
}

#[test]
fn nodes_whose_local_coordinates_begin_again_are_named() {
    for degrees in [true, false] {
        let found = local_map([99_995.0, 5.0, 15.0], degrees);
        let places: Vec<String> = found
            .diagnostics
            .iter()
            .filter(|d| d.code == Code::Implausible)
            .map(|d| d.place.element.clone())
            .collect();
        assert_eq!(places, ["node \"0\"", "node \"10\""]);
        let right = local_map([99_985.0, 99_995.0, 100_005.0], degrees);
        assert!(!codes(&right).contains(&Code::Implausible));
    }
}

#[test]
fn a_second_way_of_a_role_is_reported() {
    let Some(cases) = real_cases("ll2") else {
        return;
    };
    let layout = read_real(&cases.join("l07_split.osm"));
    let found = layout
        .diagnostics
        .iter()
        .find(|d| d.code == Code::UnknownValue)
        .unwrap();
    assert_eq!(found.place.element, "relation \"200\"");
    assert!(found.message.contains("`right`"), "{}", found.message);
}

#[test]
fn a_map_on_the_antimeridian_is_small() {
    let map = |longitudes: [f64; 2]| {
        let node = |(i, latitude): (usize, f64)| {
            let lon = longitudes[i % 2];
            format!("<node id='{i}' lat='{latitude}' lon='{lon}'/>")
        };
        let latitudes = [0.000_03, 0.000_03, 0.0, 0.0];
        let nodes: String = latitudes.into_iter().enumerate().map(node).collect();
        read(&format!(
            "<osm version='0.6'>{nodes}<way id='w0'><nd ref='0'/><nd ref='1'/></way><way id='w1'>\
             <nd ref='2'/><nd ref='3'/></way><relation id='L'>{BOUNDS}\
             <tag k='type' v='lanelet'/></relation></osm>"
        ))
    };
    let (split, whole) = (map([179.9999, -179.9999]), map([8.0, 8.0002]));
    let lengths = [&split, &whole].map(|layout| {
        let (start, end) = ends(layout, "L");
        end.x - start.x
    });
    assert!((lengths[0] - lengths[1]).abs() < 1e-6, "{lengths:?}");
    assert!(!codes(&split).contains(&Code::Implausible));
}
