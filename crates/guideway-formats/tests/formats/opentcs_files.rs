//! Plant models of openTCS come back as they were, and files written from every real file match the
//! public schemas, which needs Python with lxml; `GUIDEWAY_PYTHON` names the interpreter.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::shared;
use guideway_formats::opentcs::{Version, write_layout};
use guideway_formats::{Losses, ReadOptions, read_bytes, read_file};
use guideway_layout::{CompareOptions, Layout, PathRef, Severity, differences};

/// Returns all files below a folder of shared material.
fn files(folder: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = shared(folder).into_iter().collect();
    while let Some(folder) = folders.pop() {
        for entry in folder.read_dir().unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                // Attacks on readers take their time.
                true if path.ends_with("hostile") => {}
                true => folders.push(path),
                false => files.push(path),
            }
        }
    }
    files.sort();
    files
}

/// Segments of a path beyond which a file takes too long for a test.
const MAX_SEGMENTS: usize = 300;

/// The same of a layout.
const MAX_LAYOUT_SEGMENTS: usize = 5_000;

/// Reads a file, if it is a layout of moderate size.
fn read(path: &Path) -> Option<Layout> {
    let layout = read_file(path, &ReadOptions::default()).ok()?;
    let segments = |path: PathRef<'_>| path.runs().map(|run| run.segments().len()).sum::<usize>();
    let is_short = layout
        .paths
        .iter()
        .all(|path| segments(path) <= MAX_SEGMENTS);
    let is_small = layout.paths.geometry().segment_count() <= MAX_LAYOUT_SEGMENTS;
    (is_short && is_small).then_some(layout)
}

/// Writes a layout and reads the file.
fn through(layout: &Layout, version: Version) -> (Layout, Losses, Vec<u8>) {
    let mut text = Vec::new();
    let losses = write_layout(layout, &mut text, version).unwrap();
    let read = read_bytes("written", &text, &ReadOptions::default());
    (read.unwrap_or_else(|e| panic!("{e}")), losses, text)
}

/// All real files of moderate size.
fn real_files() -> impl Iterator<Item = (PathBuf, Layout)> {
    let folders = ["layouts", "conformance/real", "cases"];
    let files = folders.into_iter().flat_map(files);
    files.filter_map(|path| read(&path).map(|layout| (path, layout)))
}

#[test]
fn plant_models_come_back_as_they_were() {
    let mut models = 0;
    for (path, layout) in real_files() {
        let is_sound = layout.diagnostics.count_at_least(Severity::Warning) == 0;
        if layout.provenance.format != "openTCS" || !is_sound {
            continue;
        }
        let what = path.display();
        let (again, losses, text) = through(&layout, Version::V6);
        let found = differences(&layout, &again, &CompareOptions::default());
        let is_renamed = path.ends_with("otcs4_model_(1).xml");
        // Paths on hidden layers are refused, and writers list them.
        let is_whole = !is_renamed && layout.refused.is_empty();
        assert_eq!(found.is_empty(), is_whole, "{what}: {found:?}");
        assert_eq!(losses.is_empty(), is_whole, "{what}: {losses:?}");
        for version in [Version::V6, Version::V7] {
            let (again, losses, _) = through(&again, version);
            assert!(losses.is_empty(), "{what}: {losses:?}");
            let (_, _, text_again) = through(&again, Version::V6);
            assert!(text == text_again, "{what}: another text after {version:?}");
        }
        models += 1;
    }
    assert!(models == 0 || models >= 16, "{models} models");
}

const VALIDATE: &str = "\
import pathlib, sys
from lxml import etree
schemas, folder = map(pathlib.Path, sys.argv[1:])
for version in '6', '7':
    schema = etree.XMLSchema(etree.parse(schemas / f'opentcs-model-{version}.0.0.xsd'))
    for file in sorted(folder.glob(f'*.{version}')):
        if not schema.validate(etree.parse(file)):
            print(file.name, *schema.error_log, sep='\\n  ')
";

/// Validates all files of a folder, whose extension is their version. Returns the errors; `None`
/// (and a message) without the schemas, or without Python and lxml.
fn schema_errors(folder: &Path) -> Option<String> {
    let schemas = shared("conformance/schemas")?;
    let interpreter = std::env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".into());
    let python = |code| {
        let mut command = Command::new(&interpreter);
        command.args(["-c", code]).arg(&schemas).arg(folder);
        command.output()
    };
    if !python("import lxml").is_ok_and(|output| output.status.success()) {
        println!("SKIPPED: {interpreter} cannot import lxml; set GUIDEWAY_PYTHON");
        return None;
    }
    let output = python(VALIDATE).unwrap();
    let text = [output.stdout, output.stderr].concat();
    Some(String::from_utf8_lossy(&text).into_owned())
}

#[test]
fn written_files_match_the_public_schemas() {
    let folder = tempfile::tempdir().unwrap();
    for (index, (path, layout)) in real_files().enumerate() {
        let name = path.file_name().unwrap().to_string_lossy();
        for (version, number) in [(Version::V6, 6), (Version::V7, 7)] {
            let mut file = Vec::new();
            write_layout(&layout, &mut file, version).unwrap();
            let name = format!("{name} {index}.{number}");
            std::fs::write(folder.path().join(name), file).unwrap();
        }
    }
    let Some(errors) = schema_errors(folder.path()) else {
        return;
    };
    assert!(errors.is_empty(), "{errors}");
    let wrong = r#"<model version="7.0.0"/>"#;
    std::fs::write(folder.path().join("wrong.7"), wrong).unwrap();
    let errors = schema_errors(folder.path()).unwrap();
    assert!(errors.contains("'name' is required"), "{errors}");
}
