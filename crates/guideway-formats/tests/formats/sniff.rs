//! Format detection from content, and rejection of anything but regular files before they are
//! opened.

use std::fs;

use guideway_formats::{Format, Progress, ReadOptions, read_bytes, read_file, sniff};
use guideway_layout::Limits;

const LIF: &str = r#"{"layouts": [{"layoutId": "L", "nodes": [], "edges": []}]}"#;

#[test]
fn detects_the_format_from_first_bytes() {
    assert_eq!(sniff(b"{\"layouts\": []}"), Some(Format::Lif));
    assert_eq!(sniff(b"\xEF\xBB\xBF \n {"), Some(Format::Lif));
    assert_eq!(
        sniff(b"{}"),
        Some(Format::Lif),
        "its reader reports the missing keys"
    );
    assert_eq!(sniff(b"<?xml version=\"1.0\"?>"), Some(Format::OpenTcs));
    assert_eq!(sniff(b"ARROW1\0\0"), Some(Format::Arrow));
    assert_eq!(sniff(b"  0\r\nSECTION\r\n"), Some(Format::Dxf));
    assert_eq!(sniff(b"999\nmade by\n0\nSECTION\n2"), Some(Format::Dxf));
    assert_eq!(sniff(b"AutoCAD Binary DXF\r\n\x1a\0\0"), Some(Format::Dxf));
    assert_eq!(sniff(b"# by hand\nlevels:\n  L1: {}\n"), Some(Format::Rmf));
    assert_eq!(sniff(b"name: x\r\nlevels: {}\r\n"), Some(Format::Rmf));
    for other in [
        &b""[..],
        b" levels:\n",
        b"sublevels:\n",
        b"levels:x\n",
        b" ",
        b"PK\x03\x04",
        b"[1]",
        b"ARROW",
        b"0\nSECTIONS",
        b"0\nEOF\n",
        b"999\n0\n",
    ] {
        assert_eq!(sniff(other), None, "{other:?}");
    }
}

#[test]
fn distinguishes_xml_formats_by_root_element() {
    for (text, format) in [
        ("<svg>", Format::Svg),
        (
            "<?xml version='1.0'?>\n<!-- <osm> -->\n<s:svg xmlns:s='x'/>",
            Format::Svg,
        ),
        ("<!DOCTYPE svg PUBLIC 'a' 'b'><svg", Format::Svg),
        ("<!DOCTYPE svg [<!ENTITY a '<osm>'>]><svg/>", Format::Svg),
        ("\u{FEFF}<OpenDRIVE>", Format::OpenDrive),
        ("<osm version='0.6'>", Format::Lanelet2),
        ("<osmChange>", Format::OpenTcs),
        ("<model><svg/></model>", Format::OpenTcs),
        ("<!--", Format::OpenTcs),
        ("<", Format::OpenTcs),
    ] {
        assert_eq!(sniff(text.as_bytes()), Some(format), "{text}");
    }
}

#[test]
fn distinguishes_json_formats_by_root_keys() {
    for (text, format) in [
        (r#"{"headerId": 1, "nodes": []}"#, Format::Vda5050),
        (r#"{"edges" : []}"#, Format::Vda5050),
        (
            r#"{"type": "FeatureCollection", "features": []}"#,
            Format::GeoJson,
        ),
        (r#"{"geometry": null}"#, Format::GeoJson),
        (r#"{"x": {"nodes": 1}, "layouts": []}"#, Format::Lif),
        (
            r#"{"x": ["nodes"], "y": "orderId", "origins": []}"#,
            Format::Lif,
        ),
        (r#"{"x": "\"nodes\": ", "layouts": []}"#, Format::Lif),
        (r#"{"nodes\\": 1, "layouts": []}"#, Format::Lif),
        (r#"{"nodes"#, Format::Lif),
        (r#"{"nodes":"#, Format::Vda5050),
        ("{\"\\", Format::Lif),
    ] {
        assert_eq!(sniff(text.as_bytes()), Some(format), "{text}");
    }
}

#[test]
fn ignores_the_file_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plant.xml");
    fs::write(&path, LIF).unwrap();
    let layout = read_file(&path, &ReadOptions::default()).unwrap();
    assert_eq!(layout.provenance.format, "LIF");
    assert_eq!(layout.provenance.source, path.display().to_string());
}

#[test]
fn rejects_folders_and_missing_files() {
    let folder = tempfile::tempdir().unwrap();
    let error = read_file(folder.path(), &ReadOptions::default()).unwrap_err();
    assert_eq!(error.code(), "not-a-file");
    let error = read_file(&folder.path().join("none"), &ReadOptions::default()).unwrap_err();
    assert_eq!(error.code(), "not-found");
    assert!(error.to_string().contains("none"));
}

#[cfg(unix)]
#[test]
fn rejects_pipes_and_devices_without_blocking() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    for path in [pipe.as_path(), "/dev/zero".as_ref()] {
        if path == pipe && !made.as_ref().is_ok_and(|status| status.success()) {
            continue;
        }
        let error = read_file(path, &ReadOptions::default()).unwrap_err();
        assert_eq!(error.code(), "not-a-file", "{error}");
    }
}

#[test]
fn rejects_files_above_the_size_limit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("big");
    fs::write(&path, LIF).unwrap();
    let options = ReadOptions {
        limits: Limits {
            file_bytes: 10,
            ..Limits::default()
        },
        ..ReadOptions::default()
    };
    for error in [
        read_file(&path, &options).unwrap_err(),
        read_bytes("big", LIF.as_bytes(), &options).unwrap_err(),
    ] {
        assert_eq!(error.code(), "limit");
        let text = error.to_string();
        let size = LIF.len().to_string();
        assert!(
            text.contains("limit of 10") && text.contains(&size),
            "{text}"
        );
    }
}

struct Stop;

impl Progress for Stop {
    fn cancelled(&self) -> bool {
        true
    }
}

#[test]
fn cancels_a_read() {
    let options = ReadOptions {
        progress: Some(&Stop),
        ..ReadOptions::default()
    };
    let error = read_bytes("layout", LIF.as_bytes(), &options).unwrap_err();
    assert_eq!(error.code(), "cancelled");
}
