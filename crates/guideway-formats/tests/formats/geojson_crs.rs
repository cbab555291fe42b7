//! GeoJSON in the coordinate reference systems that applications write: the unit of each, and the
//! place on earth.

use guideway_formats::geojson::{WriteOptions, write_layout};
use guideway_layout::{Code, Layout, merge};
use guideway_spline::Point;

use crate::common::{codes, ends, read};

/// Reads a line from one position to another in a system.
fn line_in(crs: &str, [from, to]: [[f64; 2]; 2]) -> Layout {
    read(&format!(
        r#"{{"type": "FeatureCollection",
            "crs": {{"type": "name", "properties": {{{crs}}}}},
            "features": [{{"type": "Feature", "id": "e", "properties": {{}}, "geometry":
            {{"type": "LineString", "coordinates": [{from:?}, {to:?}]}}}}]}}"#
    ))
}

fn length(layout: &Layout) -> f64 {
    let (from, to) = ends(layout, "e");
    from.distance(to)
}

#[test]
fn geographic_systems_are_degrees() {
    for crs in [
        r#""name": "urn:ogc:def:crs:EPSG::4258""#,
        r#""name": "EPSG:4258""#,
        r#""name": "EPSG:4269""#,
        r#""name": "http://www.opengis.net/def/crs/EPSG/0/7844""#,
        r#""name": "urn:ogc:def:crs:OGC:1.3:CRS83""#,
        r#""code": 4326"#,
        r#""code": "4258""#,
    ] {
        let layout = line_in(crs, [[11.0, 50.0], [11.001, 50.0]]);
        assert!(
            (length(&layout) - 71.6958).abs() < 1e-3,
            "{crs} {}",
            length(&layout)
        );
        assert_eq!(codes(&layout), [], "{crs}");
        assert!(layout.geo_origin.is_some(), "{crs}");
    }
    // A grad is nine tenths of a degree.
    let grads = line_in(
        r#""name": "EPSG:4807""#,
        [[10.0, 50.0 / 0.9], [10.001, 50.0 / 0.9]],
    );
    assert!(
        (length(&grads) - 0.9 * 71.6958).abs() < 1e-3,
        "{}",
        length(&grads)
    );
}

/// Longitudes from 0 to 360, and those that go on beyond 180: with a system they are degrees.
#[test]
fn longitudes_may_go_beyond_180() {
    for [from, to] in [
        [359.9995, 360.0005],
        [0.0005, 359.9995],
        [179.9995, 180.0005],
    ] {
        let layout = line_in(r#""name": "EPSG:4326""#, [[from, 50.0], [to, 50.0]]);
        let found = length(&layout);
        assert!((found - 71.6958).abs() < 1e-3, "{from} to {to}: {found}");
        assert_eq!(codes(&layout), []);
    }
    // Degrees of a file that states none, and of no earth.
    for (crs, to) in [
        (r#""name": 5"#, 180.0005),
        (r#""name": "EPSG:4326""#, 541.0),
    ] {
        let layout = line_in(crs, [[179.9995, 50.0], [to, 50.0]]);
        assert!(codes(&layout).contains(&Code::AssumedUnit), "{crs}");
    }
}

/// JSON-FG, a text in place of an object, compounds of a horizontal and a vertical system.
#[test]
fn systems_are_stated_in_other_ways() {
    for stated in [
        r#""crs": "EPSG:3857""#,
        r#""coordRefSys": "http://www.opengis.net/def/crs/EPSG/0/3857""#,
        r#""crs": {"type": "name", "properties": {"name": "EPSG:3857+5773"}}"#,
    ] {
        let layout = read(&format!(
            r#"{{"type": "FeatureCollection", {stated}, "features": [{{"type": "Feature",
            "id": "e", "properties": {{}}, "geometry": {{"type": "LineString", "coordinates":
            [[1224514.4, 6621293.72274], [1225514.4, 6621293.72274]]}}}}]}}"#
        ));
        assert!((length(&layout) - 630.5965).abs() < 1e-3, "{stated}");
        assert_eq!(codes(&layout), [], "{stated}");
    }
}

#[test]
fn foot_systems_are_feet() {
    let length = |crs| length(&line_in(crs, [[1e6, 2e5], [1e6 + 1000.0, 2e5]]));
    assert!((length(r#""name": "EPSG:2263""#) - 304.800_609_6).abs() < 1e-6);
    assert!((length(r#""name": "urn:ogc:def:crs:EPSG::2223""#) - 304.8).abs() < 1e-6);
}

#[test]
fn mercator_is_undone_by_latitude() {
    // PROJ: 1000 m of the projection are 630.596 m at a latitude of 51 degrees.
    for code in [3857, 3785, 900_913, 102_100] {
        let crs = format!(r#""name": "EPSG:{code}""#);
        let layout = line_in(
            &crs,
            [
                [1_224_514.4, 6_621_293.722_74],
                [1_225_514.4, 6_621_293.722_74],
            ],
        );
        assert!(
            (length(&layout) - 630.5965).abs() < 1e-3,
            "{code} {}",
            length(&layout)
        );
        assert!((layout.geo_origin.unwrap().latitude_deg - 51.0).abs() < 1e-9);
        assert_eq!(codes(&layout), [], "{code}");
    }
    // A local plane under the code of Web Mercator, as graph editors write it.
    let local = line_in(r#""name": "EPSG:3857""#, [[10.0, 20.0], [110.0, 20.0]]);
    assert_eq!(length(&local), 100.0);
    assert_eq!(codes(&local), [Code::AssumedUnit]);
}

#[test]
fn grids_are_meters_and_what_is_not_known_is_assumed() {
    let points = [[500_123.0, 5_712_345.0], [500_223.0, 5_712_345.0]];
    for (crs, found) in [
        (r#""name": "EPSG:25832""#, &[][..]),
        (r#""name": "urn:ogc:def:crs:EPSG::31468""#, &[]),
        (r#""name": "EPSG:2056""#, &[]),
        (r#""name": "EPSG:987654""#, &[Code::AssumedUnit]),
        (r#""name": "my hall""#, &[Code::AssumedUnit]),
        // Equidistant: not true to scale. Geocentric: no plane.
        (r#""name": "EPSG:4087""#, &[Code::AssumedUnit]),
        (r#""name": "EPSG:4978""#, &[Code::AssumedUnit]),
        // Degrees cannot be so large.
        (r#""name": "EPSG:4258""#, &[Code::AssumedUnit]),
    ] {
        let layout = line_in(crs, points);
        assert_eq!(length(&layout), 100.0, "{crs}");
        assert_eq!(codes(&layout), found, "{crs}");
        assert!(layout.geo_origin.is_none(), "{crs}");
    }
}

#[test]
fn several_files_in_degrees_lie_as_on_earth() {
    let line = |crs: &str, id: &str, from: [f64; 2], to: [f64; 2]| {
        let crs = format!(r#""name": "{crs}""#);
        let mut layout = line_in(&crs, [from, to]);
        layout.provenance.source = id.to_owned();
        layout.paths.set_ids(&[(0, id)]);
        layout
    };
    let west = line("CRS84", "west", [11.0, 50.0], [11.001, 50.0]);
    let east = line("EPSG:4258", "east", [11.001, 50.0], [11.002, 50.0]);
    let node = |id: u32, lon: f64| format!("<node id='{id}' lat='50' lon='{lon}'/>");
    let map = read(&format!(
        "<osm version='0.6'>{}{}<way id='map'><nd ref='1'/><nd ref='2'/></way></osm>",
        node(1, 11.0005),
        node(2, 11.001),
    ));
    let merged = merge(vec![west, east, map]);
    // Half a line from its start, in a map of another format.
    let (middle, end) = (ends(&merged, "west"), ends(&merged, "map"));
    let half = middle.0.lerp(middle.1, 0.5);
    assert!(
        half.distance(end.0) < 1e-6 && middle.1.distance(end.1) < 1e-6,
        "{end:?}"
    );
    let (start, middle) = ends(&merged, "west");
    let (again, end) = ends(&merged, "east");
    assert!(middle.distance(again) < 1e-6, "{middle:?} {again:?}");
    assert!(
        (start.distance(end) - 143.3915).abs() < 1e-3,
        "{}",
        start.distance(end)
    );
}

#[test]
fn a_place_on_earth_comes_back() {
    // 4326, and Web Mercator of the same positions.
    let mercator = [[1_224_514.4, 6_446_275.84], [1_225_514.4, 6_446_275.84]];
    for (crs, points) in [
        (
            r#""name": "urn:ogc:def:crs:EPSG::4326""#,
            [[11.0, 50.0], [11.001, 50.0]],
        ),
        (r#""name": "EPSG:3857""#, mercator),
    ] {
        let layout = line_in(crs, points);
        let mut text = Vec::new();
        write_layout(&layout, &mut text, &WriteOptions::default()).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&text).unwrap();
        let start = &json["features"][0]["geometry"]["coordinates"][0];
        let start = Point::new(start[0].as_f64().unwrap(), start[1].as_f64().unwrap());
        assert!(
            start.distance(Point::new(11.0, 50.0)) < 1e-7,
            "{crs} {start:?}"
        );
    }
}
