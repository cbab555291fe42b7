//! Texts with several JSON values, messages that are no orders, and JSON with other quotes.

use std::time::SystemTime;

use guideway_formats::vda5050::{Version, WriteOptions, write_layout};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{Code, Layout, Value};

use crate::common::{codes, ends, read, read_real, shared};

/// An order from one node to another at the positions of their numbers.
fn order(id: &str, from: u32, to: u32) -> String {
    let node = |number: u32, sequence: u32| {
        format!(
            r#"{{"nodeId": "n{number}", "sequenceId": {sequence}, "released": true, "actions": [],
                "nodePosition": {{"x": {number}, "y": 0, "mapId": "m"}}}}"#
        )
    };
    let order = format!(
        r#"{{"headerId": 1, "version": "2.0.0", "orderId": "{id}", "orderUpdateId": 0,
            "nodes": [{}, {}], "edges": [{{"edgeId": "e", "sequenceId": 1, "released": true,
            "startNodeId": "n{from}", "endNodeId": "n{to}", "actions": []}}]}}"#,
        node(from, 0),
        node(to, 2)
    );
    order.replace('\n', " ")
}

fn assert_two_orders(layout: &Layout, name: &str) {
    assert_eq!(layout.provenance.format, "VDA 5050", "{name}");
    assert_eq!(layout.paths.len(), 2, "{name}");
    // The node that both orders pass is one.
    assert_eq!(layout.nodes.len(), 3, "{name}");
    let ends: Vec<_> = layout
        .paths
        .iter()
        .map(|path| path.ends().unwrap())
        .collect();
    let x = ends.iter().map(|(from, to)| (from.x, to.x));
    assert_eq!(x.collect::<Vec<_>>(), [(1.0, 2.0), (2.0, 3.0)], "{name}");
    let nodes = layout
        .paths
        .iter()
        .map(|path| (path.start_node(), path.end_node()));
    let expected = [(Some(0), Some(1)), (Some(1), Some(2))];
    assert_eq!(nodes.collect::<Vec<_>>(), expected, "{name}");
    for (row, id) in ["o1", "o2"].into_iter().enumerate() {
        let found = layout.paths.value(row, "orderId");
        assert_eq!(found, Some(Value::Text(id)), "{name}");
    }
    assert!(layout.attributes.value(0, "orderId").is_none(), "{name}");
}

#[test]
fn orders_of_a_log_are_one_layout() {
    let orders = [order("o1", 1, 2), order("o2", 2, 3)];
    let [first, second] = &orders;
    let quoted = serde_json::to_string(second).unwrap();
    for (name, text) in [
        ("lines", format!("{first}\n{second}\n")),
        ("array", format!("[{first},\n{second}]")),
        (
            "topics",
            format!("uagv/v2/m/s/order {first}\nuagv/v2/m/s/order {second}\n"),
        ),
        (
            "times and topics",
            format!("2024-05-01T12:00:00Z a/order {first}\n[7.5] a/order: {second}\n"),
        ),
        (
            "messages",
            format!(
                r#"{{"topic": "a", "payload": {first}}} {{"topic": "a", "payload": {quoted}}}"#
            ),
        ),
        ("records", format!("\u{1E}{first}\n\u{1E}{second}\n")),
    ] {
        let layout = read(&text);
        assert_two_orders(&layout, name);
        assert_eq!(codes(&layout), [], "{name}");
    }
    // A file holds one order.
    let layout = read(&format!("{first}\n{second}\n"));
    let options = WriteOptions {
        version: Version::V2,
        exported: SystemTime::UNIX_EPOCH,
    };
    let error = write_layout(&layout, &mut Vec::new(), &options).unwrap_err();
    assert!(error.to_string().contains("several orders"), "{error}");
    // Other messages are counted, the orders read.
    let state = r#"{"headerId": 4, "nodeStates": [], "edgeStates": []}"#;
    let layout = read(&format!("{first}\n{state}\n{second}\n"));
    assert_two_orders(&layout, "with a state");
    assert_eq!(codes(&layout), [Code::NotDrawn]);
    let found = layout.diagnostics.iter().next().unwrap();
    assert!(
        found.message.contains("a state message"),
        "{}",
        found.message
    );
    assert_eq!(found.place.element, "message 2");
}

#[test]
fn one_wrapped_order_is_as_a_plain_one() {
    let plain = read(&order("o", 1, 2));
    let wrapped = read(&format!(
        r#"{{"topic": "t", "payload": {}}}"#,
        order("o", 1, 2)
    ));
    assert_eq!(
        wrapped.attributes.value(0, "orderId"),
        Some(Value::Text("o"))
    );
    assert_eq!(ends(&wrapped, "e"), ends(&plain, "e"));
}

#[test]
fn other_messages_are_named() {
    for (text, name) in [
        (r#"{"headerId": 1, "nodeStates": []}"#, "a state message"),
        (
            r#"{"headerId": 1, "instantActions": []}"#,
            "instant actions",
        ),
        (
            r#"{"headerId": 1, "connectionState": "ONLINE"}"#,
            "a connection message",
        ),
        (
            r#"{"serialNumber": "s", "typeSpecification": {}}"#,
            "a factsheet",
        ),
    ] {
        let error = read_bytes("test", text.as_bytes(), &ReadOptions::default());
        let error = error.unwrap_err().to_string();
        assert!(error.contains("order") && error.contains(name), "{error}");
    }
}

#[test]
fn sequences_of_features_are_one_collection() {
    let line = |id: u32| {
        format!(
            r#"{{"type": "Feature", "id": "f{id}", "properties": {{}}, "geometry": {{"type":
                "LineString", "coordinates": [[{id}000, 0], [{id}000, 9]]}}}}"#
        )
        .replace('\n', " ")
    };
    let collection = format!(
        r#"{{"type": "FeatureCollection", "features": [{}]}}"#,
        line(3)
    );
    let [first, second] = [line(1), line(2)];
    for text in [
        format!("{first}\n{second}\n{collection}\n"),
        format!("\u{1E}{first}\n\u{1E}{second}\n\u{1E}{collection}\n"),
        format!("[{first}, {second}, {collection}]"),
    ] {
        let layout = read(&text);
        let ids: Vec<_> = layout.paths.iter().map(|path| path.id()).collect();
        assert_eq!(ids, ["f1", "f2", "f3"], "{text}");
        assert_eq!(codes(&layout), [Code::AssumedUnit]);
    }
    // A broken line is an error of the file, at its place in it.
    let broken = format!("{first}\n{}", &second[..40]);
    let error = |text: &str| read_bytes("test", text.as_bytes(), &ReadOptions::default());
    let cut = error(&broken).unwrap_err().to_string();
    assert!(cut.contains("cut at line 2, column 41"), "{cut}");
    let damaged = format!("{first}\n {{bad\n{second}");
    let damaged = error(&damaged).unwrap_err().to_string();
    assert!(damaged.contains("line 2, column 3"), "{damaged}");
}

#[test]
fn other_quotes_are_named() {
    for text in [
        "{'layouts': []}",
        r#"{"layouts": 'none'}"#,
        "{\u{201C}layouts\u{201D}: []}",
        r#"{"layouts": [{"layoutId": 'L'}]}"#,
    ] {
        let error = read_bytes("test", text.as_bytes(), &ReadOptions::default());
        let error = error.unwrap_err().to_string();
        assert!(error.contains("JSON wants double quotes"), "{error}");
    }
}

#[test]
fn comments_and_further_layouts_are_named() {
    let error = |text: &str| {
        let error = read_bytes("test", text.as_bytes(), &ReadOptions::default());
        error.unwrap_err().to_string()
    };
    for text in [
        "{ // a\n\"layouts\": []}",
        "{\"layouts\": /* a */ []}",
        "{ # a\n}",
        "{\"layouts\": [] // a\n}",
    ] {
        assert!(
            error(text).contains("comment; JSON has none"),
            "{}",
            error(text)
        );
    }
    let two = error("{\"layouts\": []}\n{\"layouts\": []}");
    assert!(two.contains("line 2, column 1: a second object"), "{two}");
    let surplus = error("{\"layouts\": []}\nx");
    assert!(surplus.contains("surplus text"), "{surplus}");
}

#[test]
fn other_formats_are_named_with_a_way_out() {
    for (bytes, name, remedy) in [
        (&b"PAR1\x15\x04"[..], "Parquet", "write_feather"),
        (b"FEA1\0\0", "Feather of version 1", "write_feather"),
        (b"AC1032\0\0", "DWG", "DXF"),
        (b"PK\x03\x04\x14", "ZIP", "Unpack"),
        (b"\x28\xB5\x2F\xFD\x04", "zstd", "Unpack"),
        (b"\x89PNG\r\n\x1A\n", "PNG", "--floor-plan"),
        (b"P5\n# map\n4 4\n255\n\0", "PGM", "--floor-plan"),
        (b"P4 4 4 \0\0\0\0", "PBM", "--floor-plan"),
        (b"P6 1 1 255 \0\0\0", "PPM", "--floor-plan"),
        (b"%PDF-1.7\n", "PDF", "SVG"),
        (b"SQLite format 3\0\x10", "GeoPackage", "ogr2ogr"),
        (
            b"version https://git-lfs.github.com/spec/v1\n",
            "Git LFS",
            "git lfs pull",
        ),
        (
            b"\xEF\xBB\xBF<!DOCTYPE html>\n<HTML><body/></HTML>",
            "web page",
            "Download",
        ),
        (
            b"<?xml version='1.0'?><k:kml xmlns:k='u'/>",
            "KML",
            "ogr2ogr",
        ),
        (b"<net version='1.16'/>", "SUMO", "netconvert"),
        (
            b"{\"type\": \"Topology\", \"arcs\": []}",
            "TopoJSON",
            "ogr2ogr",
        ),
        (b"<LandXML version='1.2'/>", "LandXML", "DXF"),
        (b"<c:IndoorFeatures xmlns:c='u'/>", "IndoorGML", "ogr2ogr"),
        (b"fgb\x03fgb\0", "FlatGeobuf", "ogr2ogr"),
        (b"\x08\x09\xFE\x02", "DGN", "DXF"),
        (b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1\0", "Visio", "DXF"),
        (b"%!PS-Adobe-3.0 EPSF-3.0", "PostScript", "SVG"),
        (b"ISO-10303-21;\nHEADER;", "IFC", "plan"),
        (b"\0\0\0\x0D\x0A\x09OSMHeader", "PBF", "osmium"),
        (b"#ROSBAG V2.0\n", "recording", "route"),
        (b"id,x1,y1\na,0,0\n", "separated values", "GeoJSON"),
        (
            b"\xEF\xBB\xBFid;wkt\r\n1;POINT(1 2)",
            "separated values",
            "Arrow",
        ),
        (b"LINESTRING Z (0 0 1, 1 1 1)", "(WKT)", "ogr2ogr"),
        (b"srid=4326;Polygon ((0 0", "(WKT)", "ogr2ogr"),
        (b"// by ACME\n{\"layouts\": []}", "comments", "remove them"),
        (b"[{\"layouts\": []}]", "array of layouts", "several files"),
        (
            b"{\"geometryType\": \"esriGeometryPolyline\", \"features\": []}",
            "Esri",
            "ogr2ogr",
        ),
    ] {
        let error = read_bytes("test", bytes, &ReadOptions::default()).unwrap_err();
        let (text, hint) = (error.to_string(), error.remedy());
        assert!(
            text.contains(name) && text.contains("is not supported"),
            "{text}"
        );
        assert!(hint.contains(remedy), "{text}: {hint}");
    }
    for text in [
        "POINT OF SALE",
        "a, b\nc",
        "x = 1,2\ny = 3,4",
        "to: a,b\nfrom: c,d",
    ] {
        let unknown = read_bytes("test", text.as_bytes(), &ReadOptions::default());
        assert_eq!(unknown.unwrap_err().code(), "unknown-format", "{text}");
    }
    // A key of a layout counts more.
    let text = b"{\"features\": [], \"type\": \"FeatureCollection\", \"arcs\": []}";
    assert!(read_bytes("test", text, &ReadOptions::default()).is_ok());
}

#[test]
fn public_cases_are_read_or_named() {
    let Some(folder) = shared("cases") else {
        return;
    };
    for (file, paths) in [
        ("vda/v10_array.json", 2),
        ("vda/v10b_jsonl.json", 2),
        ("vda/v10c_mqtt_wrap.json", 1),
        ("vda/v10d_mqtt_text.txt", 1),
        ("geojson/g04b_geojsonseq.geojsonl", 3),
        ("geojson/g04c_rs_seq.geojsons", 3),
    ] {
        let layout = read_real(&folder.join(file));
        assert_eq!(
            (layout.paths.len(), layout.refused.len()),
            (paths, 0),
            "{file}"
        );
    }
    for (file, name) in [
        ("vda/v10e_state.json", "a state message"),
        ("vda/v10f_instantActions.json", "instant actions"),
        ("lif/f08f_single_quotes.json", "double quotes"),
        ("arrow/a21_parquet.parquet", "Parquet"),
        ("arrow/a07_feather_v1.feather", "Feather of version 1"),
    ] {
        let error = guideway_formats::read_file(&folder.join(file), &ReadOptions::default());
        let error = error.unwrap_err().to_string();
        assert!(error.contains(name), "{file}: {error}");
    }
}
