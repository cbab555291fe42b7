//! Arrow writer: tables round-trip, except for the listed losses.

use arrow_array::RecordBatch;
use arrow_array::cast::AsArray;
use arrow_array::types::Float32Type;
use guideway_formats::arrow::{
    ArrowWriter, Column, ColumnType, Precision, WriteOptions, WriteProblem, write_layout,
};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Attribute, Layout, Level, NewPath, RunPoints, Value, Values};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

#[test]
fn dropped_writer_leaves_the_target_unchanged() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    std::fs::write(&path, "before").expect("a file");
    let mut writer = ArrowWriter::create(&path, Precision::F32, vec![]).expect("a writer");
    let run = [Point::new(0.0_f32, 0.0); 4];
    writer.push_run("a", &run, &[]).expect("a row");
    let error = writer
        .push_run("short", &run[..3], &[])
        .expect_err("three points");
    assert!(matches!(
        error.problem,
        WriteProblem::TooFewPoints { points: 3, .. }
    ));
    drop(writer);
    assert_eq!(std::fs::read(&path).expect("the file"), b"before");
    assert_eq!(
        std::fs::read_dir(folder.path())
            .expect("the folder")
            .count(),
        1
    );
    let error = ArrowWriter::create(
        &folder.path().join("no/such/x.arrow"),
        Precision::F32,
        vec![],
    );
    assert!(error.is_err());
}

#[test]
fn rejects_values_of_another_type() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    let columns = vec![Column::new("small", ColumnType::Int8)];
    let mut writer = ArrowWriter::create(&path, Precision::F64, columns).expect("a writer");
    let run = [Point::new(0.0, 0.0); 4];
    for bad in [Value::Int(128), Value::Float(1.0), Value::Text("1")] {
        assert!(writer.push_run("a", &run, &[Some(bad)]).is_err(), "{bad}");
    }
    assert!(writer.push_run("a", &run, &[]).is_err());
    writer
        .push_run("a", &run, &[Some(Value::Int(-128))])
        .expect("a row");
    writer.finish().expect("a file");
    let columns = vec![Column::new("id", ColumnType::Text)];
    assert!(ArrowWriter::create(&path, Precision::F64, columns).is_err());
}

#[test]
fn writes_batches_of_16384_rows_and_narrow_columns() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    let columns = vec![Column::new("speed", ColumnType::Float32)];
    let mut writer = ArrowWriter::create(&path, Precision::F32, columns).expect("a writer");
    for row in 0..20_000_u32 {
        let run = [0.0, 1.0, 2.0, 3.0].map(|x| Point::new(x, f64::from(row)));
        let speed = f64::from(row as f32);
        writer
            .push_run("x", &run, &[Some(Value::Float(speed))])
            .expect("a row");
    }
    writer.finish().expect("a file");
    let file = std::fs::File::open(&path).expect("the file");
    let reader = arrow_ipc::reader::FileReader::try_new(file, None).expect("a reader");
    let batches: Vec<_> = reader.map(|b| b.expect("a batch")).collect();
    assert_eq!(
        batches
            .iter()
            .map(RecordBatch::num_rows)
            .collect::<Vec<_>>(),
        [16_384, 3_616]
    );
    assert_eq!(
        batches[1].column(2).as_primitive::<Float32Type>().value(0),
        16_384.0
    );
}

#[test]
fn precision_is_single_where_the_error_is_small() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(0.1, 5.0));
    layout.paths.push(&NewPath {
        id: "a",
        runs: &runs,
        ..NewPath::default()
    });
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    write_layout(
        &layout,
        &mut std::fs::File::create(&path).expect("a new file"),
        &WriteOptions::default(),
    )
    .expect("a file");
    let back = read_file(&path, &ReadOptions::default()).expect("a layout");
    // `f32` holds 0.1 with an error of 1.5 nm, below the tolerance.
    let run = back.paths.get(0).runs().next().expect("a run");
    assert!(matches!(run, RunPoints::F32(_)));
    let far = WriteOptions {
        precision: Some(Precision::F64),
    };
    write_layout(
        &layout,
        &mut std::fs::File::create(&path).expect("a new file"),
        &far,
    )
    .expect("a file");
    let back = read_file(&path, &ReadOptions::default()).expect("a layout");
    let run = back.paths.get(0).runs().next().expect("a run");
    assert_eq!(run.iter().collect::<Vec<_>>(), runs.points());
}

/// Draft of a path: its runs, then an optional value per column.
type Row = (
    Vec<Vec<(f64, f64)>>,
    Option<u8>,
    Option<f32>,
    Option<i64>,
    Option<String>,
);

fn row() -> impl Strategy<Value = Row> {
    let coordinate = -1e6..1e6;
    let run = prop::collection::vec((coordinate.clone(), coordinate), 4..9);
    (
        prop::collection::vec(run, 1..4),
        prop::option::of(0_u8..3),
        prop::option::of(0.0_f32..9.0),
        prop::option::of(any::<i64>()),
        prop::option::of(".{0,6}"),
    )
}

fn layout_of(rows: &[Row]) -> Layout {
    let levels = ["A", "B", "C"].map(|id| Level {
        id: id.into(),
        ..Level::default()
    });
    let mut layout = Layout {
        levels: levels.into(),
        ..Layout::default()
    };
    let mut runs = Runs::default();
    for (index, row) in rows.iter().enumerate() {
        runs.clear();
        for run in &row.0 {
            let points: Vec<_> = run.iter().map(|&(x, y)| Point::new(x, y)).collect();
            runs.push(&points);
        }
        layout.paths.push(&NewPath {
            id: &format!("P{}", index / 2),
            runs: &runs,
            level: row.1.map(u32::from),
            ..NewPath::default()
        });
    }
    let widths = rows.iter().map(|r| r.2.unwrap_or(f32::NAN)).collect();
    layout.paths.set_width_m(widths);
    layout
        .paths
        .set_color_rgba(rows.iter().map(|r| r.3.unwrap_or(0) as u32).collect());
    layout
        .paths
        .set_rank((0..rows.len() as i32).rev().collect());
    let ints = Values::Int(rows.iter().map(|r| r.3).collect());
    layout
        .paths
        .attributes
        .insert(Attribute::new("serial", ints));
    let texts = rows.iter().map(|r| r.4.as_deref()).collect();
    layout
        .paths
        .attributes
        .insert(Attribute::new("note", Values::Text(texts)));
    layout
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn round_trips_any_layout(rows in prop::collection::vec(row(), 1..12)) {
        let layout = layout_of(&rows);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("paths.arrow");
        let options = WriteOptions { precision: Some(Precision::F64) };
        let mut file = std::fs::File::create(&path).expect("a new file");
        let losses = write_layout(&layout, &mut file, &options).expect("a file");
        prop_assert!(losses.is_empty());
        let back = read_file(&path, &ReadOptions::default()).expect("a layout");
        prop_assert!(back.diagnostics.is_empty());
        prop_assert_eq!(back.paths.len(), layout.paths.len());
        for (a, b) in layout.paths.iter().zip(back.paths.iter()) {
            prop_assert_eq!(a.id(), b.id());
            let points = |p: guideway_layout::PathRef<'_>| -> Vec<Vec<Point<f64>>> {
                p.runs().map(|r| r.iter().collect()).collect()
            };
            prop_assert_eq!(points(a), points(b));
            let level = |l: &Layout, p: guideway_layout::PathRef<'_>| {
                p.level().map(|i| l.levels[i as usize].id.clone())
            };
            prop_assert_eq!(level(&layout, a), level(&back, b));
        }
        let bits = |l: &Layout| -> Option<Vec<u32>> {
            Some(l.paths.width_m()?.iter().map(|w| w.to_bits()).collect())
        };
        prop_assert_eq!(bits(&layout), bits(&back));
        prop_assert_eq!(layout.paths.color_rgba(), back.paths.color_rgba());
        prop_assert_eq!(layout.paths.rank(), back.paths.rank());
        for row in 0..layout.paths.len() {
            for name in ["serial", "note"] {
                prop_assert_eq!(layout.paths.value(row, name), back.paths.value(row, name));
            }
        }
    }
}
