//! GeoJSON and route graphs of Nav2: real files, geometry types, units and invalid positions.

use crate::common::{
    assert_counts, codes, count, ends, read, read_real, real, real_layouts, shared,
};
use guideway_layout::{CheckOptions, Code, GeoOrigin, Layout, Severity, check};
use guideway_spline::Point;

/// Reference counts of another program, from the list of sources of the real layouts.
const GRAPHS: &[(&str, &str)] = &[
    (
        "aws_graph.geojson",
        // Its LineString is nested like a MultiLineString. The other program counts one vertex for
        // it, 168 in total; it has two.
        "features 124, Point 40, MultiLineString 83, LineString 1, lineVertices 169",
    ),
    (
        "no_frame.json",
        "features 124, Point 40, MultiLineString 84, lineVertices 169",
    ),
    (
        "sample_graph.geojson",
        "features 33, Point 9, MultiLineString 24, lineVertices 48",
    ),
    (
        "turtlebot3_graph.geojson",
        "features 85, Point 20, MultiLineString 65, lineVertices 130",
    ),
    (
        "warehouse_graph.geojson",
        "features 268, Point 96, LineString 172, lineVertices 344",
    ),
];

const ROADS: &[(&str, &str)] = &[
    (
        "andorra_roads_local_m.geojson",
        "features 1617, LineString 1617, lineVertices 40681",
    ),
    (
        "north-bayreuth_roads_local_m.geojson",
        "features 2079, LineString 2079, lineVertices 17276",
    ),
];

/// Number of paths with a value, per column of the roads.
const ROAD_COLUMNS: &[(&str, &[(&str, usize)])] = &[
    (
        "andorra_roads_local_m.geojson",
        &[
            ("osm_way", 1617),
            ("highway", 1614),
            ("name", 431),
            ("oneway", 389),
            ("maxspeed", 204),
            ("layer", 144),
            ("railway", 3),
        ],
    ),
    (
        "north-bayreuth_roads_local_m.geojson",
        &[
            ("osm_way", 2079),
            ("highway", 2056),
            ("name", 395),
            ("maxspeed", 263),
            ("oneway", 126),
            ("layer", 53),
            ("railway", 23),
        ],
    ),
];

const COUNTED: &[&str] = &[
    "features",
    "Point",
    "LineString",
    "MultiLineString",
    "lineVertices",
];

/// A collection of features, in meters.
pub(crate) fn collection(features: &str) -> Layout {
    read(&format!(
        r#"{{"type": "FeatureCollection",
            "crs": {{"type": "name", "properties": {{"name": "EPSG:25832"}}}},
            "features": [{features}]}}"#
    ))
}

pub(crate) fn feature(properties: &str, kind: &str, coordinates: &str) -> String {
    format!(
        r#"{{"type": "Feature", "properties": {{{properties}}},
            "geometry": {{"type": "{kind}", "coordinates": {coordinates}}}}}"#
    )
}

#[test]
fn real_graphs_have_the_reference_counts() {
    let Some(folder) = real_layouts("nav2_geojson") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), GRAPHS.len());
    for (file, expected) in GRAPHS {
        let layout = real("nav2_geojson", file).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        assert_eq!(
            layout.provenance.format_version, "Nav2 route graph",
            "{file}"
        );
        let edges = count(&layout, "features") - count(&layout, "Point");
        assert_eq!(layout.paths.len() as u64, edges, "{file}");
        assert_eq!(layout.nodes.len() as u64, count(&layout, "Point"), "{file}");
        assert_eq!(
            layout.diagnostics.count_at_least(Severity::Error),
            0,
            "{file}"
        );
        let nested = u64::from(*file == "aws_graph.geojson");
        assert_eq!(layout.diagnostics.count(Code::WrongType), nested, "{file}");
        let joined = |node: Option<u32>| node.is_some();
        let mut paths = layout.paths.iter();
        assert!(
            paths.all(|p| joined(p.start_node()) && joined(p.end_node())),
            "{file}"
        );
    }
}

#[test]
fn real_roads_have_the_reference_counts() {
    let Some(folder) = real_layouts("geojson_roads") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), ROADS.len());
    for ((file, expected), (_, columns)) in ROADS.iter().zip(ROAD_COLUMNS) {
        let layout = real("geojson_roads", file).unwrap();
        assert_counts(&layout, COUNTED, expected, file);
        assert_eq!(codes(&layout), [Code::AssumedUnit], "{file} names no crs");
        for (name, expected) in *columns {
            let values = &layout.paths.attributes.get(name).unwrap().values;
            let there = (0..layout.paths.len()).filter(|&row| values.get(row).is_some());
            assert_eq!(there.count(), *expected, "{name} of {file}");
        }
        // The files were converted to meters about their center.
        let bounds = layout.paths.hull_bounds().unwrap();
        assert!(bounds.max.x - bounds.min.x > 5_000.0, "{bounds:?}");
    }
}

#[test]
fn detects_duplicate_edges() {
    if let Some(layout) = real("nav2_geojson", "turtlebot3_graph.geojson") {
        let found = check(&layout, &CheckOptions::default());
        let twins: Vec<String> = found
            .iter()
            .filter(|d| d.code == Code::DuplicatePath)
            .map(|d| format!("{} {}", d.place, d.message))
            .collect();
        let pair = |text: &String| text.contains("36") && text.contains("50");
        assert!(twins.iter().any(pair), "{twins:?}");
    }
}

#[test]
fn draws_graph_edges_without_geometry() {
    let layout = collection(&format!(
        r#"{}, {},
           {{"type": "Feature", "geometry": null,
             "properties": {{"id": 3, "startid": 1, "endid": 2}}}}"#,
        feature(r#""id": 1"#, "Point", "[0, 0]"),
        feature(r#""id": 2"#, "Point", "[4, 3]")
    ));
    assert_eq!(codes(&layout), []);
    assert_eq!(ends(&layout, "3").1, Point::new(4.0, 3.0));
}

#[test]
fn resolves_graph_edges_in_any_order() {
    let edge = |id: u32, end: u32| {
        let properties = format!(r#""id": {id}, "startid": 1, "endid": {end}"#);
        feature(&properties, "LineString", "[[0, 0], [5, 5]]")
    };
    let layout = collection(&format!(
        "{}, {}, {}",
        edge(3, 1),
        edge(4, 9),
        feature(r#""id": 1"#, "Point", "[0, 0]")
    ));
    assert_eq!(codes(&layout), [Code::UnknownNode]);
    assert_eq!(layout.paths.len(), 2, "drawn as written");
    assert_eq!(layout.paths.get(0).end_node(), Some(0));
    assert_eq!(layout.paths.get(1).end_node(), None);
}

#[test]
fn draws_every_geometry_type() {
    let layout = collection(&format!(
        r#"{}, {}, {}, {}, {}, {},
           {{"id": "C", "type": "Feature", "properties": null, "geometry":
             {{"type": "GeometryCollection", "geometries": [{{"type": "Point",
                             "coordinates": [7, 7]}},
                            {{"type": "LineString", "coordinates": [[0, 0], [7, 7]]}}]}}}}"#,
        feature(r#""id": "P""#, "Point", "[1, 2, 30]"),
        feature(r#""id": "PP""#, "MultiPoint", "[[1, 2], [3, 4]]"),
        feature(r#""id": "L""#, "LineString", "[[0, 0], [1, 0], [1, 1]]"),
        feature(
            r#""id": "LL""#,
            "MultiLineString",
            "[[[0, 0], [1, 0]], [[5, 0], [6, 0]]]"
        ),
        feature(
            r#""id": "A""#,
            "Polygon",
            "[[[0, 0], [9, 0], [0, 9], [0, 0]]]"
        ),
        feature(
            r#""id": "AA""#,
            "MultiPolygon",
            "[[[[0, 0], [9, 0], [0, 9], [0, 0]]], [[[5, 5], [6, 5], [5, 6], [5, 5]]]]"
        ),
    ));
    assert_eq!(codes(&layout), [Code::Attribute], "the height");
    let nodes: Vec<&str> = (0..layout.nodes.len() as u32)
        .map(|n| layout.nodes.id(n))
        .collect();
    assert_eq!(nodes, ["P", "PP [1]", "PP [2]", "C [1]"]);
    let paths: Vec<(&str, usize)> = layout
        .paths
        .iter()
        .map(|p| (p.id(), p.runs().len()))
        .collect();
    let expected = [("L", 2), ("LL", 2), ("A", 3), ("AA", 6), ("C [2]", 1)];
    assert_eq!(paths, expected);
    assert_eq!(count(&layout, "lineVertices"), 3 + 4 + 2);
}

#[test]
fn reads_a_single_feature_or_geometry() {
    let line = r#"{"type": "LineString", "coordinates": [[1000, 0], [2000, 0]]}"#;
    for text in [
        line.to_owned(),
        format!(r#"{{"type": "Feature", "id": 5, "geometry": {line}}}"#),
        format!(r#"{{"type": "GeometryCollection", "geometries": [{line}]}}"#),
    ] {
        let layout = read(&text);
        assert_eq!(codes(&layout), [Code::AssumedUnit], "{text}");
        assert_eq!(layout.paths.len(), 1);
    }
}

#[test]
fn a_site_on_the_antimeridian_is_small() {
    let Some(folder) = shared("cases/geojson") else {
        return;
    };
    let layout = read_real(&folder.join("g03_antimeridian.geojson"));
    let size = layout.paths.hull_bounds().unwrap().size();
    assert!(size.x < 700.0 && size.y < 150.0, "{size:?}");
    let origin = layout.geo_origin.unwrap();
    assert!(
        (origin.longitude_deg.abs() - 180.0).abs() < 1e-9,
        "{origin:?}"
    );
}

#[test]
fn projects_degrees_to_meters() {
    // A degree of latitude at 45 degrees north is 111,131.8 m, and of longitude 78,846.8 m (WGS
    // 84).
    let line = feature("", "LineString", "[[10, 44.5], [10, 45.5]]");
    let across = feature("", "LineString", "[[9.5, 45], [10.5, 45]]");
    let crs = r#""crs": {"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}},"#;
    for crs in ["", crs] {
        let layout = read(&format!(r#"{{{crs} "features": [{line}, {across}]}}"#));
        let length = |path| {
            let (from, to) = layout.paths.get(path).ends().unwrap();
            from.distance(to)
        };
        assert!((length(0) - 111_131.8).abs() < 1.0, "{}", length(0));
        assert!((length(1) - 78_846.8).abs() < 1.0, "{}", length(1));
        let (from, to) = layout.paths.get(0).ends().unwrap();
        assert!(to.y > from.y && (from + to).norm() < 1e-6, "north is up");
        assert_eq!(codes(&layout).is_empty(), !crs.is_empty());
        let origin = GeoOrigin {
            longitude_deg: 10.0,
            latitude_deg: 45.0,
        };
        assert_eq!(layout.geo_origin, Some(origin));
    }
}

#[test]
fn reads_positions_beyond_180_degrees_as_meters() {
    let line = feature("", "LineString", "[[0, 0], [181, 0]]");
    for crs in ["", r#""crs": {"properties": {"name": "EPSG:4326"}},"#] {
        let layout = read(&format!(r#"{{{crs} "features": [{line}]}}"#));
        assert_eq!(codes(&layout), [Code::AssumedUnit]);
        let (from, to) = layout.paths.get(0).ends().unwrap();
        assert_eq!(from.distance(to), 181.0);
    }
}

#[test]
fn ignores_and_reports_invalid_positions() {
    for (coordinates, paths) in [
        (r#"[[0, 0], "x", [5, 5]]"#, 1),
        ("[[0, 0], [null, 1], [5, 5]]", 1),
        ("[[0, 0], [1], [5, 5]]", 1),
        ("[[0, 0], [[7, 7]], [5, 5]]", 1),
        ("[[0, 0], {}, true, null]", 0),
        ("[0, 0]", 0),
        ("[]", 0),
        ("[[], []]", 0),
        ("{}", 0),
        ("[[[0, 0], [5, 5]]]", 1),
    ] {
        let layout = collection(&feature("", "LineString", coordinates));
        assert_eq!(layout.paths.len(), paths, "{coordinates}");
        assert_eq!(layout.path_count(), 1, "{coordinates}");
        let silent = layout.diagnostics.is_empty();
        assert!(!silent || layout.refused.len() == 1, "{coordinates}");
        if paths == 1 {
            let end = layout.paths.get(0).ends().unwrap().1;
            assert_eq!(end, Point::new(5.0, 5.0), "{coordinates}");
        }
    }
}
