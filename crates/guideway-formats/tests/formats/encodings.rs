//! Tests of files in other encodings and of packed files: they read as the same file in UTF-8.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::Layout;

use crate::common::{read_real, real_cases};
use crate::law::compare;

fn read_as(bytes: &[u8]) -> Layout {
    read_bytes("test", bytes, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn pack(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A file of each format of text, with a letter that encodings write differently.
const TEXTS: [(&str, &str); 9] = [
    (
        "SVG",
        "<svg xmlns='http://www.w3.org/2000/svg' width='9mm'><line id='é' x2='9' \
         stroke='red'/></svg>",
    ),
    (
        "OpenDRIVE",
        "<OpenDRIVE><road id='é' length='9'><planView><geometry s='0' x='0' y='0' hdg='0' \
         length='9'><line/></geometry></planView><lanes><laneSection s='0'><center><lane \
         id='0'/></center></laneSection></lanes></road></OpenDRIVE>",
    ),
    (
        "openTCS",
        "<model version='6.0.0' name='m'><point name='A' positionX='0' positionY='0'/><point \
         name='B' positionX='9000' positionY='0'/><path name='é' sourcePoint='A' \
         destinationPoint='B'/></model>",
    ),
    (
        "Lanelet2",
        "<osm><node id='1' lat='0' lon='0'><tag k='local_x' v='0'/><tag k='local_y' \
         v='0'/></node><node id='2' lat='0' lon='0'><tag k='local_x' v='9'/><tag k='local_y' \
         v='0'/></node><way id='é'><nd ref='1'/><nd ref='2'/><tag k='type' \
         v='line_thin'/></way></osm>",
    ),
    (
        "LIF",
        r#"{"layouts": [{"layoutId": "L", "nodes": [{"nodeId": "A", "nodePosition":
            {"x": 0, "y": 0}}, {"nodeId": "B", "nodePosition": {"x": 9, "y": 0}}], "edges": [
            {"edgeId": "é",
            "startNodeId": "A", "endNodeId": "B", "vehicleTypeEdgeProperties": [{"vehicleTypeId":
            "t"}]}]}]}"#,
    ),
    (
        "GeoJSON",
        r#"{"type": "Feature", "id": "é", "properties": {}, "geometry": {"type": "LineString",
            "coordinates": [[0, 0], [0.001, 0]]}}"#,
    ),
    (
        "VDA 5050",
        r#"{"orderId": "o", "nodes": [{"nodeId": "A", "sequenceId": 0, "nodePosition":
            {"x": 0, "y": 0, "mapId": "m"}}, 
            {"nodeId": "B", "sequenceId": 2, "nodePosition": {"x": 9, "y": 0,
            "mapId": "m"}}], "edges": [{"edgeId": "é", "sequenceId": 1, "startNodeId": "A",
            "endNodeId": "B"}]}"#,
    ),
    (
        "Open-RMF",
        "levels:\n  é:\n    vertices: [[0, 0, 0, a], [9, 9, 0, b]]\n    lanes: [[0, 1, {}]]\n",
    ),
    (
        "DXF",
        "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1021\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\n\
         LINE\n5\n1A\n8\né\n10\n0\n20\n0\n11\n9\n21\n0\n0\nENDSEC\n0\nEOF\n",
    ),
];

#[test]
fn every_text_format_reads_in_utf_16_and_packed() {
    for (format, text) in TEXTS {
        let expected = read_as(text.as_bytes());
        let with_mark = format!("\u{FEFF}{text}");
        let le: Vec<u8> = with_mark
            .encode_utf16()
            .flat_map(u16::to_le_bytes)
            .collect();
        let be: Vec<u8> = with_mark
            .encode_utf16()
            .flat_map(u16::to_be_bytes)
            .collect();
        for bytes in [
            &le,
            &be,
            &le[2..].to_vec(),
            &pack(text.as_bytes()),
            &pack(&be),
        ] {
            let found = read_as(bytes);
            let breaches = compare(&expected, &found, &[], 0.0);
            assert!(breaches.is_empty(), "{format}: {breaches:?}");
            let (found, expected) = (found.diagnostics, &expected.diagnostics);
            assert!(found.iter().eq(expected.iter()), "{format}");
        }
    }
}

#[test]
fn every_xml_format_reads_as_it_declares() {
    for (format, text) in &TEXTS[..4] {
        let expected = read_as(text.as_bytes());
        for (label, letter) in [("ISO-8859-1", b"\xE9"), ("ibm866", b"\xE9")] {
            let head = format!("<?xml version='1.0' encoding='{label}'?>");
            let (before, after) = text.split_once('é').unwrap();
            let bytes = [head.as_bytes(), before.as_bytes(), letter, after.as_bytes()].concat();
            let found = read_as(&bytes);
            let id = |layout: &Layout| layout.paths.iter().next().unwrap().id().to_owned();
            let letter = if label == "ibm866" { "щ" } else { "é" };
            assert_eq!(id(&found), id(&expected).replace('é', letter), "{format}");
        }
    }
}

#[test]
fn cases_of_other_encodings_are_read() {
    for (folder, file, paths) in [
        ("svg", "s06b_utf16.svg", 1),
        ("svg", "s06c_svgz.svgz", 1),
        ("svg", "s06d_latin1.svg", 1),
        ("otcs", "t06_utf16.xml", 1),
        ("otcs", "t06b_gbk.xml", 1),
        ("lif", "f08d_utf16.json", 1),
        ("dxf", "d32_utf16le_bom.dxf", 2),
    ] {
        let Some(cases) = real_cases(folder) else {
            return;
        };
        let layout = read_real(&cases.join(file));
        assert_eq!(layout.path_count(), paths, "{file}");
        let ids: Vec<_> = layout
            .paths
            .iter()
            .map(|path| path.id().to_owned())
            .collect();
        assert!(
            !ids.iter().any(|id| id.contains('\u{FFFD}')),
            "{file}: {ids:?}"
        );
    }
}
