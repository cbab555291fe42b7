//! The Python code of `docs/arrow-format.md` runs unchanged, and Python and Rust read each other's
//! files.
//!
//! Requires Python with pyarrow, and polars for its block; `GUIDEWAY_PYTHON` names the interpreter.
//! Tests of missing packages are skipped with a message.

use std::path::Path;
use std::process::Command;

use guideway_formats::arrow::{
    ArrowWriter, Column, ColumnType, Precision, WriteOptions, write_layout,
};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, Direction, Layout, NewPath, Quantity, Value};
use guideway_spline::{Point, Runs};

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

/// A layout of two nodes, a path between them and a station.
fn network() -> Layout {
    let mut layout = Layout::default();
    let points = [Point::new(0.0, 0.0), Point::new(4.0, 0.0)];
    let nodes = &mut layout.nodes;
    let (start, end) = (
        nodes.push("A", points[0], None),
        nodes.push("B", points[1], None),
    );
    layout.nodes.attributes.set(1, "name", Value::Text("dock"));
    let mut runs = Runs::default();
    runs.push_line(points[0], points[1]);
    layout.paths.push(&NewPath {
        id: "aisle-1",
        runs: &runs,
        start_node: Some(start),
        end_node: Some(end),
        direction: Direction::Both,
        vehicle_types: &["tug", "fork"],
        ..NewPath::default()
    });
    let attributes = &mut layout.paths.attributes;
    attributes.set_quantity(0, "maxSpeed", 1.5, Quantity::Speed);
    attributes.set(0, "actions", Value::Json("[{\"a\": 1}]"));
    let at = Point::new(4.0, 1.0);
    layout.stations.push("S", Some(at), vec![end], None);
    layout
}

fn write_network(folder: &Path) {
    let path = folder.join("network.arrow");
    write_layout(
        &network(),
        &mut std::fs::File::create(&path).expect("a new file"),
        &WriteOptions::default(),
    )
    .expect("a file");
}

#[test]
fn documented_python_runs() {
    if !has("pyarrow") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    write_network(folder);
    let mut checked = 0;
    for block in blocks() {
        let packages = ["polars", "numpy", "duckdb"];
        if packages.iter().any(|p| block.contains(p) && !has(p)) {
            continue;
        }
        let text = run(folder, block);
        let expected = match block {
            _ if block.contains("read_table(\"paths.arrow\")") => {
                "aisle-1 1 segments from control point [-2.0, 0.0]\n"
            }
            _ if block.contains("pyarrow.compute") => {
                "['aisle-1'] from ['A']\n[{'id': 'S', 'x_m': 4.0, 'y_m': 1.0, 'nodes': [1]}]\n"
            }
            _ => continue,
        };
        assert_eq!(text, expected);
        checked += 1;
    }
    assert_eq!(checked, 2);
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

#[test]
fn pyarrow_and_polars_keep_the_network() {
    if !has("pyarrow") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    write_network(folder.path());
    let code = r#"
import pyarrow as pa, pyarrow.feather
t = pyarrow.feather.read_table("network.arrow")
t.validate(full=True)
assert t.schema.metadata == {b"guideway.version": b"2"}, t.schema.metadata
assert t.schema.field("maxSpeed").metadata == {b"unit": b"m/s"}, t.schema
assert t.schema.field("actions").type == pa.json_(), t.schema
assert [len(chunk) for chunk in t["id"].chunks] == [1, 2, 1], t
pyarrow.feather.write_feather(t, "pyarrow.arrow")
"#;
    run(folder.path(), code);
    let mut written = vec!["pyarrow.arrow"];
    if has("polars") {
        run(
            folder.path(),
            "import polars as pl; pl.read_ipc('network.arrow').write_ipc('polars.arrow')",
        );
        written.push("polars.arrow");
    }
    let network = network();
    for name in written {
        let layout = read(folder.path(), name);
        let path = layout.paths.get(0);
        assert_eq!(
            (path.start_node(), path.end_node()),
            (Some(0), Some(1)),
            "{name}"
        );
        assert_eq!(path.direction(), Direction::Both);
        assert!(layout.paths.vehicle_types().of(0).eq(["tug", "fork"]));
        assert_eq!(layout.nodes.position_m(1), network.nodes.position_m(1));
        assert_eq!(layout.nodes.attributes, network.nodes.attributes);
        assert_eq!(layout.stations.nodes(0), [1]);
        assert_eq!(
            layout.paths.value(0, "actions"),
            network.paths.value(0, "actions")
        );
        // polars drops the version and the unit.
        let is_polars = name == "polars.arrow";
        let quantity = layout.paths.column("maxSpeed").and_then(|c| c.quantity);
        assert_eq!(quantity.is_none(), is_polars);
        assert_eq!(
            layout.diagnostics.count(Code::Version),
            u64::from(is_polars)
        );
    }
}
