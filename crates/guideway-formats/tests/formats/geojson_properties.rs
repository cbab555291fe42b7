//! Properties of GeoJSON features as columns: types, whole numbers, limits, metadata of Nav2.

use crate::common::{codes, read, read_real, real, shared};
use crate::geojson::{collection, feature};
use guideway_layout::{Code, Quantity, Value};

#[test]
fn reads_edge_properties_as_columns() {
    let Some(layout) = real("nav2_geojson", "sample_graph.geojson") else {
        return;
    };
    let row = layout.paths.iter().position(|p| p.id() == "9").unwrap();
    let value = |name: &str| {
        let column = layout.paths.attributes.get(name);
        column.and_then(|c| c.values.get(row))
    };
    assert_eq!(value("cost"), Some(Value::Float(10.0)));
    assert_eq!(value("overridable"), Some(Value::Bool(false)));
    // Metadata are columns; `speed_limit` is a percentage.
    assert_eq!(value("speed_limit"), Some(Value::Float(0.85)));
    assert_eq!(value("aisle_number"), Some(Value::Int(14)));
    assert!(layout.paths.attributes.get("maxSpeed").is_none());
    let Some(Value::Json(operations)) = value("operations") else {
        panic!("no operations");
    };
    assert!(operations.contains("\"ON_ENTER\"") && operations.contains("[1080, 720]"));
    let nodes = &layout.nodes.attributes;
    let region = nodes.value(0, "region").map(|value| value.to_string());
    assert!(region.is_some_and(|region| region.contains("number_of_lights")));
    assert!(layout.paths.attributes.get("startid").is_none());
}

#[test]
fn keeps_whole_numbers_of_64_bits() {
    let Some(folder) = shared("cases/geojson") else {
        return;
    };
    let layout = read_real(&folder.join("g11_bigids.geojson"));
    let ids: Vec<_> = layout.paths.iter().map(|path| path.id()).collect();
    assert_eq!(
        ids,
        ["9007199254740993", "9007199254740992", "18014398509481985"]
    );
    let serial = |row| layout.paths.attributes.value(row, "serial");
    // The third one exceeds 64 bits with a sign, so the column is text.
    let digits = [
        "1234567890123456789",
        "1234567890123456788",
        "12345678901234567890",
    ];
    assert_eq!([0, 1, 2].map(serial), digits.map(|d| Some(Value::Text(d))));
    let layout = read_real(&folder.join("g11b_nav2_bigids.geojson"));
    let path = layout.paths.get(0);
    assert_eq!((path.start_node(), path.end_node()), (Some(0), Some(1)));
    assert_eq!(layout.nodes.id(0), "9007199254740993");
    let text = feature(
        r#""a": 9007199254740993, "b": {"deep": [1, {"x": 18446744073709551615}]}"#,
        "LineString",
        "[[0, 0], [1, 0]]",
    );
    let layout = collection(&text);
    let value = |name| layout.paths.attributes.value(0, name);
    assert_eq!(value("a"), Some(Value::Int(9_007_199_254_740_993)));
    let deep = r#"{"deep": [1, {"x": 18446744073709551615}]}"#;
    assert_eq!(value("b"), Some(Value::Json(deep)));
}

#[test]
fn properties_beyond_the_limit_are_one_column() {
    let properties: Vec<String> = (0..70).map(|i| format!(r#""p{i}": {i}"#)).collect();
    let long = "n".repeat(200);
    let properties = format!(
        r#"{}, "{long}": [1], "other": "mine""#,
        properties.join(",")
    );
    let layout = collection(&feature(&properties, "LineString", "[[0, 0], [1, 0]]"));
    assert_eq!(codes(&layout), [Code::Attribute]);
    let attributes = &layout.paths.attributes;
    assert_eq!(attributes.iter().count(), 65);
    assert_eq!(attributes.value(0, "p63"), Some(Value::Int(63)));
    let other = format!(
        r#"{{"p64":64,"p65":65,"p66":66,"p67":67,"p68":68,"p69":69,"{long}":[1],"other":"mine"}}"#
    );
    assert_eq!(attributes.value(0, "other"), Some(Value::Json(&other)));
}

#[test]
fn features_without_a_place_are_no_error() {
    let layout = collection(&format!(
        r#"{{"type": "Feature", "properties": {{"a": 1}}, "geometry": null}}, {}"#,
        feature("", "LineString", "[[0, 0], [1, 0]]")
    ));
    assert_eq!(codes(&layout), [Code::NotDrawn]);
    assert_eq!((layout.path_count(), layout.refused.len()), (1, 0));
    // So is a feature that is the whole file, or a line of it.
    let alone = r#"{"type": "Feature", "properties": {"a": 1}, "geometry": null}"#;
    let line = feature("", "LineString", "[[0, 0], [1, 0]]").replace('\n', " ");
    for (text, paths) in [(alone.to_owned(), 0), (format!("{alone}\n{line}\n"), 1)] {
        let layout = read(&text);
        assert!(codes(&layout).contains(&Code::NotDrawn));
        assert_eq!((layout.path_count(), layout.refused.len()), (paths, 0));
    }
}

#[test]
fn absolute_speed_limits_of_route_graphs_are_speeds() {
    let layout = collection(&format!(
        "{}, {}, {}",
        feature(r#""id": 1"#, "Point", "[0, 0]"),
        feature(r#""id": 2"#, "Point", "[5, 0]"),
        feature(
            r#""id": 3, "startid": 1, "endid": 2, "class": "aisle",
               "metadata": {"abs_speed_limit": 1, "speed_limit": 50, "class": 7}"#,
            "LineString",
            "[[0, 0], [5, 0]]"
        )
    ));
    let column = layout.paths.attributes.get("maxSpeed").unwrap();
    assert_eq!(column.quantity, Some(Quantity::Speed));
    let value = |name| layout.paths.attributes.value(0, name);
    assert_eq!(value("maxSpeed"), Some(Value::Float(1.0)));
    assert_eq!(value("speed_limit"), Some(Value::Int(50)));
    assert_eq!(value("class"), Some(Value::Text("aisle")));
    assert_eq!(value("metadata.class"), Some(Value::Int(7)));
}
