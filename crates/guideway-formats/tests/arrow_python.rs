//! The Python code of `docs/arrow-format.md` runs unchanged, and Python and Rust read each other's
//! files.
//!
//! Requires Python with pyarrow, and polars for its block; `GUIDEWAY_PYTHON` names the interpreter.
//! Tests of missing packages are skipped with a message.

use std::path::Path;
use std::process::Command;

use guideway_formats::arrow::{ArrowWriter, Column, ColumnType, Precision};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Layout, Value};
use guideway_spline::Point;

const DOCUMENT: &str = include_str!("../../../docs/arrow-format.md");

/// Returns the fenced blocks of Python in order.
fn blocks() -> Vec<&'static str> {
    let fenced = DOCUMENT.split("```python\n").skip(1);
    fenced
        .map(|rest| rest.split("```").next().unwrap_or_default())
        .collect()
}

fn python(folder: &Path, code: &str) -> (bool, String) {
    let interpreter = std::env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".into());
    let output = Command::new(&interpreter)
        .args(["-c", code])
        .current_dir(folder)
        .output();
    match output {
        Ok(output) => {
            let text = [output.stdout, output.stderr].concat();
            let text = String::from_utf8_lossy(&text).into_owned();
            (output.status.success(), text)
        }
        Err(error) => (false, format!("{interpreter}: {error}")),
    }
}

/// Returns whether Python has a package; prints a message if not.
fn has(package: &str) -> bool {
    let (found, text) = python(Path::new("."), &format!("import {package}"));
    if !found {
        println!(
            "SKIPPED: Python cannot import {package}; set GUIDEWAY_PYTHON to one that can. {text}"
        );
    }
    found
}

fn run(folder: &Path, code: &str) -> String {
    let (done, text) = python(folder, code);
    assert!(done, "{code}\n{text}");
    text
}

fn read(folder: &Path, name: &str) -> Layout {
    let layout = read_file(&folder.join(name), &ReadOptions::default());
    layout.unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn documented_python_runs() {
    if !has("pyarrow") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    for block in blocks() {
        if block.contains("polars") && !has("polars") || block.contains("numpy") && !has("numpy") {
            continue;
        }
        let text = run(folder, block);
        if block.contains("read_table") {
            let expected = "aisle-1 1 segments from control point [-2.0, 0.0]";
            assert_eq!(text.trim(), expected);
        }
    }
    let written = read(folder, "paths.arrow");
    assert!(written.diagnostics.is_empty());
    assert_eq!(written.paths.id(0), "aisle-1");
    let (start, end) = written.paths.get(0).ends().expect("a curve");
    assert!(start.distance(Point::new(0.0, 0.0)) < 1e-6, "{start:?}");
    assert!(end.distance(Point::new(2.0, 1.0 / 6.0)) < 1e-6, "{end:?}");
    if folder.join("many.arrow").exists() {
        let many = read(folder, "many.arrow");
        assert_eq!(
            (many.paths.len(), many.paths.geometry().segment_count()),
            (1_000, 8_000)
        );
    }
    if folder.join("polars.arrow").exists() {
        let layout = read(folder, "polars.arrow");
        assert_eq!((layout.paths.id(0), layout.refused.len()), ("aisle-2", 0));
    }
}

#[test]
fn pyarrow_reads_written_files() {
    if !has("pyarrow") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ours.arrow");
    let columns = vec![
        Column::new("kind", ColumnType::Text),
        Column::new("hall", ColumnType::Int32),
    ];
    let mut writer = ArrowWriter::create(&path, Precision::F32, columns).expect("a writer");
    for row in 0..20_000_i64 {
        let run = [0.0, 1.0, 2.0, 3.0].map(|x| Point::new(x, row as f64));
        let values = [
            (row > 0).then_some(Value::Text("aisle")),
            Some(Value::Int(row)),
        ];
        writer
            .push_run(&format!("P{row}"), &run, &values)
            .expect("a row");
    }
    writer.finish().expect("a file");
    let code = r#"
import pyarrow as pa, pyarrow.feather
t = pyarrow.feather.read_table("ours.arrow", memory_map=True)
t.validate(full=True)
assert t.schema.metadata == {b"guideway.version": b"1"}, t.schema.metadata
assert t.column("control_points").num_chunks == 2, t
assert t["control_points"][19_999].as_py() == [[x, 19_999.0] for x in range(4)]
assert t["id"][5].as_py() == "P5" and t["kind"][0].as_py() is None and t["hall"].type == pa.int32()
for chunk in t["control_points"].chunks:
    assert all(b is None or b.address % 64 == 0 for b in chunk.buffers()), "aligned"
"#;
    run(folder.path(), code);
}
