//! Tests of the Open-RMF reader: real files, pixels, scale, levels and types of parameters.

use crate::common::{assert_counts, codes, ends, read, read_real, real, shared};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Direction, Layout, Member, Quantity, Value};
use guideway_spline::Point;

/// Element counts per file from the list of sources, made by another program.
const REAL: &[(&str, &str)] = &[
    (
        "airport_terminal.building.yaml",
        "levels 1, vertices 1297, lanes 223, walls 464, doors 5, measurements 1, floors 75, \
         models 282, bidirectional 223, lanes of graph 0 17, lanes of graph 1 51, \
         lanes of graph 2 139, lanes of graph 4 16",
    ),
    (
        "campus.building.yaml",
        "levels 1, vertices 157, lanes 154, models 1, bidirectional 27, lanes of graph 0 154",
    ),
    (
        "hotel.building.yaml",
        "levels 3, vertices 353, lanes 122, walls 254, doors 19, measurements 3, floors 13, \
         models 175, fiducials 9, bidirectional 122, lanes of graph 0 52, lanes of graph 1 19, \
         lanes of graph 2 51, lifts 2",
    ),
    (
        "office.building.yaml",
        "levels 1, vertices 73, lanes 30, walls 33, doors 3, measurements 3, floors 4, models 79, \
         bidirectional 30, lanes of graph 0 30",
    ),
    (
        "triple_H.building.yaml",
        "levels 1, vertices 51, lanes 22, walls 28, measurements 1, floors 1, bidirectional 22, \
         lanes of graph 0 22",
    ),
];

const COUNTED: &[&str] = &[
    "levels",
    "vertices",
    "lanes",
    "walls",
    "doors",
    "measurements",
    "floors",
    "models",
    "fiducials",
    "bidirectional",
    "lanes of graph 0",
    "lanes of graph 1",
    "lanes of graph 2",
    "lanes of graph 4",
    "lifts",
];

fn assert_near(found: Point<f64>, x: f64, y: f64) {
    let expected = Point::new(x, y);
    assert!(
        found.distance(expected) < 1e-9,
        "{found:?} is not {expected:?}"
    );
}

#[test]
fn real_files_have_the_expected_counts() {
    for (file, expected) in REAL {
        let Some(layout) = real("rmf_building", file) else {
            return;
        };
        assert_eq!(layout.provenance.format, "Open-RMF");
        assert_counts(&layout, COUNTED, expected, file);
        let count = |name| crate::common::count(&layout, name);
        let edges = ["lanes", "human_lanes", "walls", "doors"]
            .map(count)
            .iter()
            .sum::<u64>();
        assert_eq!(layout.paths.len() as u64, edges, "{file}");
        assert!(layout.refused.is_empty(), "{file}");
        assert_eq!(layout.nodes.len() as u64, count("vertices"), "{file}");
    }
}

#[test]
fn airport_has_its_measured_size() {
    let Some(layout) = real("rmf_building", "airport_terminal.building.yaml") else {
        return;
    };
    // 0.0821 m per pixel; the vertices of lanes and walls span 282 m by 83 m.
    let ends = layout.paths.iter().flat_map(|path| {
        let (start, end) = path.ends().unwrap();
        [start, end]
    });
    let bounds = guideway_spline::Bounds::of_points(ends).unwrap();
    let size = bounds.max - bounds.min;
    assert!(
        (size.x - 282.0).abs() < 1.0 && (size.y - 65.0).abs() < 20.0,
        "{size:?}"
    );
}

#[test]
fn aligns_the_levels_of_the_hotel() {
    let Some(layout) = real("rmf_building", "hotel.building.yaml") else {
        return;
    };
    assert_eq!(layout.levels[2].elevation_m, Some(16.0));
    // A lift is vertical: every level has a vertex in it.
    for station in 0..layout.stations.len() as u32 {
        let lift = layout.stations.position_m(station).unwrap();
        for level in 0..3 {
            let nodes =
                (0..layout.nodes.len() as u32).filter(|&n| layout.nodes.level(n) == Some(level));
            let distances = nodes.map(|n| layout.nodes.position_m(n).distance(lift));
            let nearest = distances.fold(f64::INFINITY, f64::min);
            assert!(
                nearest < 1.5,
                "{nearest} m from lift {station} on level {level}"
            );
        }
    }
}

/// A building of one level, with 10 pixels per meter.
fn building(head: &str, vertices: &str, lanes: &str) -> Layout {
    read(&format!(
        "{head}\nlevels:\n  L1:\n    vertices: [[0, 0, 0, a], [100, 0, 0, b], {vertices}]\n    \
         measurements: [[0, 1, {{distance: [3, 10]}}]]\n    lanes: [{lanes}]\n"
    ))
}

#[test]
fn scales_pixels_to_meters_and_flips_y() {
    let layout = building("", "[50, 20, 0, c]", "[0, 2, {}]");
    let (start, end) = ends(&layout, "L1.lanes[0]");
    assert_near(start, 0.0, 0.0);
    assert_near(end, 5.0, -2.0);
    assert!(codes(&layout).is_empty());
}

#[test]
fn keeps_cartesian_meters() {
    let layout = building(
        "coordinate_system: cartesian_meters",
        "[50, 20, 0, c]",
        "[0, 2, {}]",
    );
    assert_near(ends(&layout, "L1.lanes[0]").1, 50.0, 20.0);
}

#[test]
fn projects_degrees_about_their_center() {
    let layout = read(
        "coordinate_system: wgs84\nlevels:\n  L1:\n    \
         vertices: [[103.78, 1.3, 0, a], [103.79, 1.3, 0, b]]\n    lanes: [[0, 1, {}]]\n",
    );
    let (start, end) = ends(&layout, "L1.lanes[0]");
    // A hundredth of a degree at 1.3 degrees north.
    assert!(
        (start.distance(end) - 1112.9).abs() < 0.2,
        "{}",
        start.distance(end)
    );
    assert!((start + end).norm() < 1e-6, "not centered");
}

#[test]
fn scales_mercator_meters_by_the_latitude() {
    // y = R ln tan(45 + 60 / 2 degrees) is 60 degrees north, where the projection doubles lengths.
    let y = 6_378_137.0 * (75_f64.to_radians()).tan().ln();
    let layout = read(&format!(
        "coordinate_system: web_mercator\nlevels:\n  L1:\n    \
         vertices: [[0, {y}, 0, a], [100, {y}, 0, b]]\n    lanes: [[0, 1, {{}}]]\n"
    ));
    let (start, end) = ends(&layout, "L1.lanes[0]");
    assert!((start.distance(end) - 50.0).abs() < 1e-6);
}

#[test]
fn assumes_and_reports_the_scale_without_a_measurement() {
    let layout = read("levels:\n  L1:\n    vertices: [[0, 0], [100, 0, 0, b]]\n");
    assert!(
        !codes(&layout).contains(&Code::AssumedUnit),
        "a graph is in meters"
    );
    let layout = read("levels:\n  L1:\n    vertices: [[0, 0, 0, a], [100, 0, 0, b]]\n");
    assert_eq!(codes(&layout), [Code::AssumedUnit]);
    assert_near(layout.nodes.position_m(1), 5.0, 0.0);
}

#[test]
fn aligns_a_level_to_the_reference_by_fiducials() {
    let text = |second: &str| {
        format!(
            "levels:\n  L1:\n    vertices: [[0, 0, 0, a], [100, 0, 0, b]]\n    \
             measurements: [[0, 1, {{distance: [3, 10]}}]]\n    \
             fiducials: [[0, 0, one], [100, 0, two]]\n  L2:\n    elevation: 4\n    \
             vertices: [[7, 7, 0, c], [7, 207, 0, d]]\n    lanes: [[0, 1, {{}}]]\n{second}"
        )
    };
    // The upper plan has half the meters per pixel, is rotated by 90 degrees and shifted.
    let layout = read(&text("    fiducials: [[7, 7, one], [7, 207, two]]\n"));
    let (start, end) = ends(&layout, "L2.lanes[0]");
    assert_near(start, 0.0, 0.0);
    assert_near(end, 10.0, 0.0);
    assert_eq!(layout.paths.get(0).level(), Some(1));
    assert_eq!(layout.levels[1].elevation_m, Some(4.0));
    let layout = read(&text(""));
    assert_eq!(
        codes(&layout),
        [Code::AssumedUnit],
        "a finding without fiducials"
    );
}

#[test]
fn stores_parameters_in_typed_columns() {
    let layout = building(
        "",
        "[9, 9, 0, \"\", {is_charger: [4, true], dock_name: [1, 007]}]",
        "[0, 1, {bidirectional: [4, true], graph_idx: [2, 3], speed_limit: [3, 0.5], \
         orientation: [1, \"\"]}], \
         [1, 0, {bidirectional: [4, false]}]",
    );
    let directions: Vec<_> = layout.paths.iter().map(|path| path.direction()).collect();
    assert_eq!(directions, [Direction::Both, Direction::Forward]);
    let value = |name| {
        layout
            .paths
            .attributes
            .get(name)
            .and_then(|a| a.values.get(0))
    };
    assert_eq!(value("maxSpeed"), Some(Value::Float(0.5)));
    assert_eq!(value("element"), Some(Value::Text("lane")));
    for name in ["graph_idx", "bidirectional", "speed_limit", "orientation"] {
        assert_eq!(value(name), None, "{name} is elsewhere, or empty");
    }
    assert!(layout.paths.vehicle_types().of(0).eq(["graph 3"]));
    assert_eq!(layout.nodes.id(2), "L1.vertices[2]", "an unnamed vertex");
    let docks = layout.nodes.attributes.get("dock_name").unwrap();
    assert_eq!(docks.values.get(2), Some(Value::Text("007")));
}

#[test]
fn reads_bare_parameters_and_meters_of_navigation_graphs() {
    let layout = read(
        "building_name: site\nlevels:\n  L1:\n    lanes:\n    - - 0\n      - 1\n      \
         - {graph_idx: 0, speed_limit: 1.5}\n    \
         vertices:\n    - [1, 2, {name: dock, is_charger: true}]\n    - [4, 6, {name: ''}]\n\
         lifts:\n  lift: {position: [1, 2, 0]}\n",
    );
    assert_eq!(layout.provenance.format_version, "navigation graph");
    let (start, end) = ends(&layout, "L1.lanes[0]");
    assert_near(start, 1.0, 2.0);
    assert_near(end, 4.0, 6.0);
    assert_eq!(layout.nodes.id(0), "dock");
    let charger = layout.nodes.attributes.get("is_charger").unwrap();
    assert_eq!(charger.values.get(0), Some(Value::Bool(true)));
    assert_near(layout.stations.position_m(0).unwrap(), 1.0, 2.0);
    let speed = layout.paths.attributes.get("maxSpeed").unwrap();
    assert_eq!(speed.quantity, Some(Quantity::Speed));
    assert_eq!(speed.values.get(0), Some(Value::Float(1.5)));
    assert!(codes(&layout).is_empty());
}

#[test]
fn keeps_all_parameters_of_lanes_and_vertices() {
    let layout = building(
        "",
        "[9, 9, 0.5, c, {mutex: [1, m], lift_cabin: [1, Lift1], n: [3, 2]}]",
        "[0, 1, {orientation: [1, forward], mutex: [1, m], speed_limit: [3, 0]}], \
         [1, 2, {speed_limit: [3, -1], nested: {a: [1, x]}}]",
    );
    assert_eq!(codes(&layout), [Code::WrongType, Code::Implausible]);
    let value = |row, name| layout.paths.attributes.value(row, name);
    assert_eq!(
        value(0, "orientation_constraint"),
        Some(Value::Text("forward"))
    );
    assert_eq!(value(0, "maxSpeed"), None, "zero is no limit");
    assert_eq!(value(1, "speed_limit"), Some(Value::Float(-1.0)));
    assert_eq!(value(1, "nested"), Some(Value::Json(r#"{"a":[1,"x"]}"#)));
    let value = |name| layout.nodes.attributes.value(2, name);
    assert_eq!(value("z"), Some(Value::Float(0.5)));
    assert_eq!(value("n"), Some(Value::Float(2.0)));
    assert_eq!(
        value("lift_cabin"),
        Some(Value::Text("Lift1")),
        "no such lift"
    );
    assert_eq!(layout.blocks.len(), 1);
    assert_eq!(layout.blocks[0].id, "m");
    assert_eq!(layout.blocks[0].members, [Member::Node(2), Member::Path(0)]);
}

#[test]
fn keeps_properties_of_the_building_and_its_levels() {
    let Some(layout) = real("rmf_building", "hotel.building.yaml") else {
        return;
    };
    let site = |name| layout.attributes.value(0, name);
    assert_eq!(site("name"), Some(Value::Text("hotel")));
    assert_eq!(
        site("coordinate_system"),
        Some(Value::Text("reference_image"))
    );
    assert!(matches!(site("crowd_sim"), Some(Value::Json(json)) if json.contains("ORCA_tau")));
    let level = &layout.levels[2].attributes;
    assert_eq!(level.value(0, "drawing"), Some(Value::Text("hotel_L3.png")));
    assert_eq!(layout.stations.len(), 2);
    let lift = |name| layout.stations.attributes.value(0, name);
    assert_eq!(lift("kind"), Some(Value::Text("lift")));
    assert_eq!(lift("theta"), Some(Value::Float(0.0)));
    assert_eq!(lift("width"), Some(Value::Float(2.7)));
    assert_eq!(lift("reference_floor_name"), Some(Value::Text("L1")));
    let doors = r#"{"L1":["lift1_door"],"L2":["lift1_door"],"L3":["lift1_door"]}"#;
    assert_eq!(lift("level_doors"), Some(Value::Json(doors)));
    assert_eq!(layout.stations.nodes(0).len(), 3, "one vertex per level");
    // Doors have names.
    let doors = layout.paths.iter().filter(|path| path.id() == "L3_door15");
    assert_eq!(doors.count(), 1);
}

#[test]
fn counts_every_list_that_is_not_drawn() {
    let Some(folder) = shared("conformance/real") else {
        return;
    };
    let layout = read_real(&folder.join("rmfsite_office.building.yaml"));
    let found: Vec<_> = layout
        .diagnostics
        .iter()
        .map(|d| d.message.as_str())
        .collect();
    for counted in [
        "floors: 1",
        "models: 61",
        "lights: 3",
        "physical_cameras: 2",
    ] {
        assert!(found.contains(&counted), "{counted}: {found:?}");
    }
}

#[test]
fn a_place_on_earth_is_kept() {
    let Some(layout) = real("rmf_building", "campus.building.yaml") else {
        return;
    };
    let origin = layout.geo_origin.unwrap();
    assert!((origin.longitude_deg - 103.78).abs() < 0.01, "{origin:?}");
    assert!((origin.latitude_deg - 1.3).abs() < 0.01, "{origin:?}");
    let y = 6_378_137.0 * (75_f64.to_radians()).tan().ln();
    let x = 6_378_137.0 * 10_f64.to_radians();
    let layout = read(&format!(
        "coordinate_system: web_mercator\nlevels:\n  L1:\n    vertices: [[{x}, {y}, 0, a]]\n"
    ));
    let origin = layout.geo_origin.unwrap();
    assert!((origin.longitude_deg - 10.0).abs() < 1e-9, "{origin:?}");
    assert!((origin.latitude_deg - 60.0).abs() < 1e-9, "{origin:?}");
}

#[test]
fn reads_the_doors_of_a_navigation_graph() {
    let Some(folder) = shared("conformance/real") else {
        return;
    };
    let layout = read_real(&folder.join("eiu_nav_graph.yaml"));
    let door = layout
        .paths
        .iter()
        .find(|path| path.id() == "null")
        .unwrap();
    assert_eq!((door.level(), door.direction()), (Some(0), Direction::Both));
    assert_near(
        door.ends().unwrap().0,
        29.398886389912644,
        -13.01007185023283,
    );
    assert_eq!(layout.paths.len(), 15);
    let lost = read("levels: {L1: {vertices: [[0, 0, {}]]}}\ndoors: {d: {endpoints: [[1, 2]]}}\n");
    assert_eq!(lost.refused.len(), 1);
    let building = folder.join("eiu_tb3_world.building.yaml");
    assert_eq!(read_real(&building).paths.len(), 13);
    assert!(read_file(&folder.join("eiu_nav_graph2.yaml"), &ReadOptions::default()).is_err());
}

#[test]
fn refuses_lanes_without_a_vertex_and_reports_the_line() {
    let layout = building("", "[50, 20, 0, c]", "[0, 2, {}], [0, 9, {}]");
    assert_eq!(layout.paths.len(), 1);
    let refused = layout.refused.iter().next().unwrap();
    assert_eq!(
        (refused.id, refused.code),
        ("L1.lanes[1]", Code::UnknownNode)
    );
    let finding = layout.diagnostics.iter().next().unwrap();
    assert_eq!(finding.place.line, Some(6));
}
