//! GeoJSON writer: a whole layout comes back as it was; only listed losses differ.

use crate::common::{assert_losses_are_differences, read, read_real, shared};
use guideway_formats::Losses;
use guideway_formats::geojson::{WriteOptions, write_layout};
use guideway_layout::{
    Block, Code, CompareOptions, Direction, GeoOrigin, Layout, Level, Member, NewPath, OwnStyle,
    Quantity, Value, VehicleType, WrittenCurve, Zone, differences,
};
use guideway_spline::{Point, Runs, arc_to_runs, polyline_to_runs};
use proptest::prelude::*;

fn write(layout: &Layout) -> (String, Losses) {
    let mut bytes = Vec::new();
    let losses = write_layout(layout, &mut bytes, &WriteOptions::default()).unwrap();
    (String::from_utf8(bytes).unwrap(), losses)
}

fn assert_round_trip(layout: &Layout, name: &str) -> String {
    let (text, losses) = write(layout);
    let again = read(&text);
    assert_losses_are_differences(layout, &again, &losses, name);
    text
}

/// Files of every format, with their losses in GeoJSON.
const FILES: &[(&str, &[&str])] = &[
    ("layouts/geojson_roads/andorra_roads_local_m.geojson", &[]),
    (
        "layouts/geojson_roads/north-bayreuth_roads_local_m.geojson",
        &[],
    ),
    ("layouts/nav2_geojson/aws_graph.geojson", &[]),
    ("layouts/nav2_geojson/no_frame.json", &[]),
    ("layouts/nav2_geojson/sample_graph.geojson", &[]),
    ("layouts/nav2_geojson/turtlebot3_graph.geojson", &[]),
    ("layouts/nav2_geojson/warehouse_graph.geojson", &[]),
    ("layouts/rmf_building/airport_terminal.building.yaml", &[]),
    ("layouts/rmf_building/campus.building.yaml", &[]),
    ("layouts/rmf_building/hotel.building.yaml", &[]),
    ("layouts/rmf_building/office.building.yaml", &[]),
    ("layouts/rmf_building/triple_H.building.yaml", &[]),
    ("conformance/real/eiu_nav_graph.yaml", &[]),
    ("conformance/real/eiu_tb3_world.building.yaml", &[]),
    ("conformance/real/lil_far.building.yaml", &[]),
    ("conformance/real/rmfsite_office.building.yaml", &[]),
    ("conformance/real/nav2_tb3.geojson", &[]),
    ("cases/geojson/g02c_4326_urn.geojson", &[]),
    ("cases/geojson/g03_antimeridian.geojson", &[]),
    ("cases/geojson/g04_odd.geojson", &["refused paths"]),
    ("cases/geojson/g04g_empty_lines.geojson", &["refused paths"]),
    ("cases/geojson/g05_nav2_dups.geojson", &[]),
    ("cases/geojson/g05b_nav2_curve.geojson", &[]),
    ("cases/geojson/g05c_nav2_stringids.geojson", &[]),
    ("cases/geojson/g06_utm.geojson", &[]),
    ("cases/geojson/g10_east.geojson", &[]),
    ("cases/geojson/g11_bigids.geojson", &[]),
    ("cases/geojson/g11b_nav2_bigids.geojson", &[]),
    ("cases/rmf/r07_odd.building.yaml", &["refused paths"]),
    ("cases/rmf/r09b_wgs84_negy.building.yaml", &[]),
];

#[test]
fn real_files_keep_the_whole_layout() {
    let Some(folder) = shared("") else {
        return;
    };
    for (file, expected) in FILES {
        let layout = read_real(&folder.join(file));
        let (text, losses) = write(&layout);
        let again = read(&text);
        assert_losses_are_differences(&layout, &again, &losses, file);
        let losses: Vec<_> = losses.iter().map(|loss| loss.what.as_str()).collect();
        assert_eq!(losses, *expected, "{file}");
        assert_eq!(again.diagnostics.count(Code::AssumedUnit), 0, "{file}");
        assert_eq!(write(&again).0, text, "{file}");
    }
}

#[test]
fn degrees_come_back_as_degrees() {
    let Some(folder) = shared("cases/geojson") else {
        return;
    };
    let layout = read_real(&folder.join("g02c_4326_urn.geojson"));
    let (text, _) = write(&layout);
    assert!(!text.contains("\"crs\""), "RFC 7946 has degrees only");
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let line = &json["features"][0]["geometry"]["coordinates"];
    let number = |i: usize, j: usize| line[i][j].as_f64().unwrap();
    assert!((number(0, 0) - 11.0).abs() < 1e-9 && (number(1, 0) - 11.001).abs() < 1e-9);
    assert!((number(0, 1) - 50.0).abs() < 1e-9, "{line}");
}

/// A layout with every part of the model.
fn whole() -> Layout {
    let mut layout = Layout::default();
    for (id, name) in [("L1", Some("Ground")), ("L1", None)] {
        let mut level = Level {
            id: id.into(),
            name: name.map(str::to_owned),
            elevation_m: Some(1.5),
            ..Level::default()
        };
        level.attributes.set(0, "drawing", Value::Text("hall.png"));
        layout.levels.push(level);
    }
    let a = Point::new(0.0, 0.0);
    for (id, x, level) in [("a", 0.0, Some(0)), ("b", 8.0, Some(1)), ("a", 9.0, None)] {
        let types: &[&str] = if id == "b" { &["tug"] } else { &[] };
        let position = Point::new(x, 0.0);
        layout.nodes.push_for_types(id, position, level, types);
    }
    let angle = Quantity::Angle;
    let node_types = layout.nodes.vehicle_types_mut();
    node_types.attributes.set_quantity(0, "theta", 0.5, angle);
    layout.nodes.attributes.set(1, "id", Value::Int(7));
    let mut runs = Runs::default();
    arc_to_runs(a, 8.0, 0.0, 1.5, 1e-5, &mut runs);
    let arc = layout.paths.push(&NewPath {
        id: "arc",
        runs: &runs,
        start_node: Some(1),
        end_node: Some(2),
        direction: Direction::Both,
        level: Some(1),
        vehicle_types: &["fork", "tug"],
    });
    let entries = layout.paths.vehicle_types_mut();
    for (entry, speed) in [(0, 1.0), (1, 0.25)] {
        let attributes = &mut entries.attributes;
        attributes.set_quantity(entry, "maxSpeed", speed, Quantity::Speed);
    }
    layout.paths.set_written_curve(
        arc,
        WrittenCurve {
            degree: 2,
            knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            points_m: vec![a, Point::new(4.0, 1.0 / 3.0), Point::new(8.0, 0.0)],
            weights: Some(vec![1.0, 0.5, 1.0]),
        },
    );
    runs.clear();
    polyline_to_runs(&[a, Point::new(8.0, 0.0), Point::new(8.0, 2.0)], &mut runs);
    let line = layout.paths.push(&NewPath {
        id: "line",
        runs: &runs,
        start_node: Some(0),
        ..NewPath::default()
    });
    let style = OwnStyle {
        width_m: Some(0.3),
        color_rgba: Some(0x11_22_33_44),
    };
    layout.paths.set_own_style(line, style);
    layout.paths.set_rank(vec![0, -3]);
    let attributes = &mut layout.paths.attributes;
    attributes.set(line, "actions", Value::Json("[ {\"a\": 1.50} ]"));
    attributes.set(line, "number", Value::Json("3"));
    attributes.set(line, "nan", Value::Float(f64::NAN));
    attributes.set(arc, "serial", Value::Int(i64::MAX));
    attributes.set(arc, "direction", Value::Text("up"));
    layout
        .paths
        .attributes
        .set_quantity(line, "length", 4.0, Quantity::Length);
    layout.stations.push("S", Some(a), vec![2, 0], Some(1));
    layout.stations.push("T", None, Vec::new(), None);
    layout
        .stations
        .attributes
        .set(1, "kind", Value::Text("charger"));
    let mut vehicle_type = VehicleType {
        id: "tug".into(),
        ..VehicleType::default()
    };
    let speed = Quantity::Speed;
    vehicle_type
        .attributes
        .set_quantity(0, "maxSpeed", 2.0, speed);
    layout.vehicle_types.push(vehicle_type);
    let mut block = Block {
        id: "crossing".into(),
        members: vec![Member::Node(2), Member::Path(0), Member::Station(1)],
        ..Block::default()
    };
    block.attributes.set(0, "type", Value::Text("SINGLE"));
    layout.blocks.push(block);
    layout.zones.push(Zone {
        id: "keep out".into(),
        outline_m: [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0)]
            .map(|(x, y)| Point::new(x, y))
            .into(),
        level: Some(0),
        ..Zone::default()
    });
    layout.attributes.set(0, "project", Value::Text("Hall 2"));
    layout
}

#[test]
fn every_part_of_a_layout_comes_back() {
    let mut layout = whole();
    for origin in [None, Some((11.5, 49.9)), Some((-179.999_99, -17.0))] {
        layout.geo_origin = origin.map(|(longitude_deg, latitude_deg)| GeoOrigin {
            longitude_deg,
            latitude_deg,
        });
        let text = assert_round_trip(&layout, "the whole layout");
        let again = read(&text);
        assert_eq!(again.geo_origin, layout.geo_origin);
        let speed = again
            .paths
            .vehicle_types()
            .attributes
            .get("maxSpeed")
            .unwrap();
        assert_eq!(speed.quantity, Some(Quantity::Speed));
        assert!(again.diagnostics.is_empty(), "{:?}", again.diagnostics);
        let length = again.paths.attributes.get("length").unwrap();
        assert_eq!(length.quantity, Some(Quantity::Length));
    }
}

#[test]
fn a_layout_beyond_the_earth_is_written_in_meters() {
    let mut layout = whole();
    layout.geo_origin = Some(GeoOrigin {
        longitude_deg: 11.5,
        latitude_deg: 49.9,
    });
    layout.nodes.set_position_m(0, Point::new(0.0, 1e8));
    let text = assert_round_trip(&layout, "a layout beyond the earth");
    assert!(text.contains("EPSG::3857"));
}

#[test]
fn lists_what_does_not_come_back() {
    let mut layout = whole();
    let attributes = &mut layout.paths.attributes;
    attributes.set(0, "guideway:level", Value::Text("mine"));
    attributes.set(0, "broken", Value::Json("{"));
    layout.refused.push("R", Code::UnknownNode, "no nodes");
    layout.paths.push(&NewPath {
        id: "empty",
        ..NewPath::default()
    });
    layout.blocks[0].members.push(Member::Path(2));
    let (text, losses) = write(&layout);
    assert_losses_are_differences(&layout, &read(&text), &losses, "lost parts");
    let whats: Vec<_> = losses.iter().map(|loss| loss.what.as_str()).collect();
    let expected = [
        "refused paths",
        "paths",
        "column guideway:level",
        "column broken",
        "blocks",
    ];
    assert_eq!(whats, expected);
}

#[test]
fn an_edited_line_counts_more_than_the_curve() {
    let layout = whole();
    let (text, _) = write(&layout);
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let line = &mut json["features"][3]["geometry"]["coordinates"];
    line[1] = serde_json::json!([0.0, 20.0]);
    let again = read(&json.to_string());
    assert_eq!(again.diagnostics.count(Code::Attribute), 1);
    assert!(again.paths.written_curve(0).is_none());
    let top = again.paths.get(0).hull_bounds().unwrap().max.y;
    assert!(top > 19.0, "{top}");
}

#[test]
fn a_file_without_the_member_keeps_the_network() {
    // QGIS keeps the properties and drops members that it does not know.
    let (text, _) = write(&whole());
    let mut json: serde_json::Value = serde_json::from_str(&text).unwrap();
    json.as_object_mut().unwrap().remove("guideway");
    let again = read(&json.to_string());
    let path = again.paths.get(0);
    assert_eq!(path.direction(), Direction::Both);
    assert_eq!((path.start_node(), path.end_node()), (Some(1), Some(2)));
    assert!(again.paths.vehicle_types().of(0).eq(["fork", "tug"]));
    assert_eq!((again.stations.len(), again.zones.len()), (2, 1));
}

fn arbitrary_layout() -> impl Strategy<Value = Layout> {
    let point = (-2e3..2e3, -2e3..2e3).prop_map(|(x, y)| Point::new(x, y));
    let points = prop::collection::vec(point, 4..9);
    let path = (
        "[ -~]{0,8}",
        points,
        any::<(i64, bool, bool)>(),
        any::<f64>(),
    );
    let paths = prop::collection::vec(path, 1..8);
    let origin = prop::option::of((-180.0..180.0, -80.0..80.0));
    (paths, origin).prop_map(|(paths, origin)| {
        let geo_origin = origin.map(|(longitude_deg, latitude_deg)| GeoOrigin {
            longitude_deg,
            latitude_deg,
        });
        let mut layout = Layout {
            geo_origin,
            ..Layout::default()
        };
        let mut runs = Runs::default();
        for (i, (id, points, (whole, truth, is_line), number)) in paths.iter().enumerate() {
            runs.clear();
            if *is_line {
                polyline_to_runs(points, &mut runs);
            } else {
                runs.push(points);
            }
            let start = layout.nodes.push(id, points[0], None);
            let end = layout.nodes.push(&i.to_string(), points[1], None);
            let row = layout.paths.push(&NewPath {
                id,
                runs: &runs,
                start_node: Some(start),
                end_node: Some(end),
                direction: match truth {
                    true => Direction::Both,
                    false => Direction::Forward,
                },
                vehicle_types: if *is_line { &["x", "y"] } else { &[] },
                ..NewPath::default()
            });
            let attributes = &mut layout.paths.attributes;
            attributes.set(row, "whole", Value::Int(*whole));
            attributes.set(row, "truth", Value::Bool(*truth));
            attributes.set(row, "a.number", Value::Float(*number));
            attributes.set(row, "\"text\"\n", Value::Text(id));
        }
        layout
    })
}

proptest! {
    #[test]
    fn any_layout_comes_back(layout in arbitrary_layout()) {
        let (text, losses) = write(&layout);
        prop_assert!(losses.is_empty(), "{:?}", losses);
        let again = read(&text);
        let found = differences(&layout, &again, &CompareOptions::default());
        prop_assert!(found.is_empty(), "{:?}", found);
    }
}

#[test]
#[should_panic(expected = "directions not listed")]
fn comparison_detects_a_difference_that_is_not_listed() {
    let mut layout = whole();
    let (text, losses) = write(&layout);
    layout.paths.set_direction(1, Direction::Both);
    assert_losses_are_differences(&layout, &read(&text), &losses, "a changed layout");
}
