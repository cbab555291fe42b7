//! LIF 1.0 as written from every source format, against the public schema. Needs Python with
//! jsonschema; `GUIDEWAY_PYTHON` names the interpreter.

use std::io::Write;
use std::process::{Command, Stdio};
use std::time::SystemTime;

use guideway_formats::lif::{Version, WriteOptions, write_layout};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::Layout;

use crate::common::real_layouts;

/// Validates one JSON text per line; prints the errors.
const SCRIPT: &str = "
import json, sys, jsonschema
validator = jsonschema.Draft7Validator(json.load(open(sys.argv[1])))
for line in sys.stdin:
    name, text = line.split('\\t', 1)
    for error in list(validator.iter_errors(json.loads(text)))[:3]:
        print(name, list(error.absolute_path), error.message[:200])
";

/// Source formats whose files the tests may read.
const FOLDERS: [&str; 11] = [
    "dxf",
    "geojson_roads",
    "lanelet2",
    "lif",
    "nav2_geojson",
    "opendrive",
    "opentcs",
    "rmf_building",
    "rmf_nav",
    "svg",
    "vda5050",
];

/// Files above this size, as read or written, add minutes and no other members.
const MAX_BYTES: u64 = 150_000;

fn written(layout: &Layout) -> String {
    let mut out = Vec::new();
    let options = WriteOptions {
        version: Version::V1,
        exported: SystemTime::UNIX_EPOCH,
    };
    write_layout(layout, &mut out, &options).unwrap();
    String::from_utf8(out).unwrap()
}

/// Returns the errors of the schema for named texts; `None` without Python or the schema.
fn errors(texts: &[(String, String)]) -> Option<String> {
    let schema = real_layouts(".")?.join("../conformance/schemas/LIF-1.0.schema.json");
    if !schema.is_file() {
        println!("SKIPPED: there is no schema at {}", schema.display());
        return None;
    }
    let interpreter = std::env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".into());
    let has_module = Command::new(&interpreter)
        .args(["-c", "import jsonschema"])
        .output();
    if !has_module.is_ok_and(|output| output.status.success()) {
        println!("SKIPPED: {interpreter} cannot import jsonschema; set GUIDEWAY_PYTHON");
        return None;
    }
    let mut python = Command::new(&interpreter)
        .args(["-c", SCRIPT])
        .arg(schema)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = python.stdin.take().unwrap();
    for (name, text) in texts {
        writeln!(input, "{name}\t{}", text.replace('\n', " ")).unwrap();
    }
    drop(input);
    let output = python.wait_with_output().unwrap();
    assert!(output.status.success());
    Some(String::from_utf8(output.stdout).unwrap())
}

#[test]
fn every_source_format_is_written_as_the_schema_requires() {
    let mut texts = Vec::new();
    for folder in FOLDERS.into_iter().filter_map(real_layouts) {
        for entry in folder.read_dir().unwrap() {
            let entry = entry.unwrap();
            if entry.metadata().unwrap().len() > MAX_BYTES {
                continue;
            }
            let Ok(mut layout) = read_file(&entry.path(), &ReadOptions::default()) else {
                continue;
            };
            // As a new file: files of the standard itself break the schema in places.
            layout.provenance.text = None;
            let text = written(&layout);
            if text.len() as u64 <= MAX_BYTES {
                texts.push((entry.file_name().to_string_lossy().into_owned(), text));
            }
        }
    }
    if let Some(errors) = errors(&texts) {
        assert!(texts.len() > 30, "{} files", texts.len());
        // The example of another program has a degree without its control points.
        let known = ["continua_example.lif.json"];
        let is_known = |line: &&str| known.iter().any(|name| line.starts_with(name));
        let new: Vec<&str> = errors.lines().filter(|line| !is_known(line)).collect();
        assert!(new.is_empty(), "{}", new.join("\n"));
    }
}

#[test]
fn schema_check_detects_a_missing_member() {
    let mut layout = Layout::default();
    layout
        .nodes
        .push("n", guideway_spline::Point::new(0.0, 0.0), None);
    let valid = written(&layout);
    let broken = valid.replace("\"nodeId\"", "\"id\"");
    let texts = [("valid".to_owned(), valid), ("broken".to_owned(), broken)];
    if let Some(errors) = errors(&texts) {
        assert!(
            errors.lines().all(|line| line.starts_with("broken")),
            "{errors}"
        );
        assert!(!errors.is_empty());
    }
}
