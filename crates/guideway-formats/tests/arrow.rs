//! Arrow tables: what is written comes back, and every type that is promised is read.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int32Type};
use arrow_array::{
    ArrayRef, BooleanArray, Date32Array, DictionaryArray, FixedSizeListArray, Float64Array,
    Int8Array, Int64Array, LargeStringArray, ListArray, RecordBatch, StringArray, StringViewArray,
    UInt32Array, UInt64Array,
};
use arrow_ipc::CompressionType;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions, StreamWriter};
use arrow_schema::{DataType, Field, Schema};
use guideway_formats::arrow::{
    ArrowWriter, Column, ColumnType, Precision, WriteOptions, WriteProblem, write_layout,
};
use guideway_formats::{ReadOptions, read_bytes, read_file};
use guideway_layout::{
    Attribute, Code, Direction, Layout, Level, NewPath, RunPoints, TextColumn, Value, Values,
};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

/// `rows` straight polygons of four points, as list<fixed_size_list<float32, 2>>.
fn polygons(rows: usize) -> ListArray {
    let coordinates = (0..rows).flat_map(|row| (0..4).flat_map(move |x| [x as f32, row as f32]));
    let coordinates = arrow_array::Float32Array::from_iter_values(coordinates);
    let item = Arc::new(Field::new("item", DataType::Float32, true));
    let points = FixedSizeListArray::new(item, 2, Arc::new(coordinates), None);
    let item = Arc::new(Field::new(
        "item",
        arrow_array::Array::data_type(&points).clone(),
        true,
    ));
    let offsets = arrow_buffer::OffsetBuffer::from_lengths(vec![4; rows]);
    ListArray::new(item, offsets, Arc::new(points), None)
}

fn batch(columns: Vec<(&str, ArrayRef)>) -> RecordBatch {
    let batch = RecordBatch::try_from_iter_with_nullable(
        columns.into_iter().map(|(name, c)| (name, c, true)),
    )
    .expect("columns of one length");
    let metadata = HashMap::from([("guideway.version".to_owned(), "1".to_owned())]);
    let schema = Schema::clone(&batch.schema()).with_metadata(metadata);
    batch
        .with_schema(Arc::new(schema))
        .expect("the same columns")
}

fn file(batches: &[RecordBatch], compression: Option<CompressionType>) -> Vec<u8> {
    let options = IpcWriteOptions::default();
    let options = options.try_with_compression(compression).expect("a codec");
    let mut writer = FileWriter::try_new_with_options(Vec::new(), &batches[0].schema(), options)
        .expect("a writer");
    for batch in batches {
        writer.write(batch).expect("a batch");
    }
    writer.into_inner().expect("a file")
}

fn read(bytes: &[u8]) -> Layout {
    read_bytes("test", bytes, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn read_columns(columns: Vec<(&str, ArrayRef)>) -> Layout {
    read(&file(&[batch(columns)], None))
}

fn attribute<'a>(layout: &'a Layout, name: &str) -> &'a Attribute {
    let attribute = layout.paths.attributes.get(name);
    attribute.unwrap_or_else(|| panic!("no attribute {name}"))
}

fn ids(layout: &Layout) -> Vec<&str> {
    layout.paths.iter().map(|p| p.id()).collect()
}

#[test]
fn files_and_streams_of_several_batches_are_one_table() {
    let part = |from: usize| {
        let ids = StringArray::from_iter_values((from..from + 3).map(|i| format!("P{i}")));
        batch(vec![
            ("id", Arc::new(ids)),
            ("control_points", Arc::new(polygons(3))),
        ])
    };
    let batches = [part(0), part(3), part(6)];
    for compression in [
        None,
        Some(CompressionType::LZ4_FRAME),
        Some(CompressionType::ZSTD),
    ] {
        let layout = read(&file(&batches, compression));
        assert_eq!(
            ids(&layout),
            ["P0", "P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8"]
        );
        assert!(layout.diagnostics.is_empty());
        let counts = &layout.provenance.counts;
        assert_eq!(
            *counts,
            [("rows".to_owned(), 9), ("record batches".to_owned(), 3)]
        );
    }
    let mut stream = StreamWriter::try_new(Vec::new(), &batches[0].schema()).expect("a writer");
    for batch in &batches {
        stream.write(batch).expect("a batch");
    }
    let layout = read(&stream.into_inner().expect("a stream"));
    assert_eq!(layout.paths.len(), 9);
    assert_eq!(
        layout.paths.get(8).runs().next().expect("a run").get(3),
        Point::new(3.0, 2.0)
    );
}

#[test]
fn every_kind_of_text_is_read() {
    let words = ["a", "b", "b"];
    let kinds: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from(words.to_vec())),
        Arc::new(LargeStringArray::from(words.to_vec())),
        Arc::new(StringViewArray::from(words.to_vec())),
        Arc::new(DictionaryArray::<Int32Type>::from_iter(words)),
    ];
    for kind in kinds {
        let layout = read_columns(vec![
            ("id", kind.clone()),
            ("level", kind.clone()),
            ("zone", kind.clone()),
            ("control_points", Arc::new(polygons(3))),
        ]);
        assert_eq!(ids(&layout), words);
        let levels: Vec<_> = layout.paths.iter().map(|p| p.level()).collect();
        assert_eq!(levels, [Some(0), Some(1), Some(1)]);
        assert_eq!(
            attribute(&layout, "zone").values.get(2),
            Some(Value::Text("b"))
        );
        assert!(layout.diagnostics.is_empty());
    }
    let layout = read_columns(vec![
        ("id", Arc::new(Int64Array::from(vec![7, -1, 9]))),
        ("control_points", Arc::new(polygons(3))),
    ]);
    assert_eq!(ids(&layout), ["7", "-1", "9"]);
}

#[test]
fn every_kind_of_list_is_read() {
    let list = polygons(3);
    let points = list.value(0).data_type().clone();
    let item = || Arc::new(Field::new("item", points.clone(), true));
    for target in [
        DataType::LargeList(item()),
        DataType::ListView(item()),
        DataType::LargeListView(item()),
        DataType::FixedSizeList(item(), 4),
    ] {
        let column = arrow_cast::cast(&list, &target).expect("a cast");
        let layout = read_columns(vec![("control_points", column)]);
        assert_eq!(layout.paths.len(), 3, "{target}");
        let run = layout.paths.get(2).runs().next().expect("a run");
        assert_eq!(run.get(1), Point::new(1.0, 2.0), "{target}");
        assert_eq!(ids(&layout), ["0", "1", "2"]);
        assert_eq!(layout.diagnostics.count(Code::Attribute), 1);
    }
    let double = Arc::new(Field::new("item", DataType::Float64, true));
    let double = Arc::new(Field::new("item", DataType::FixedSizeList(double, 2), true));
    let column = arrow_cast::cast(&list, &DataType::List(double)).expect("a cast");
    let layout = read_columns(vec![("control_points", column)]);
    let run = layout.paths.get(0).runs().next().expect("a run");
    assert!(matches!(run, RunPoints::F64(_)));
}

#[test]
fn styles_of_other_widths_and_nulls_are_read() {
    let layout = read_columns(vec![
        (
            "width_m",
            Arc::new(Float64Array::from(vec![Some(0.5), None, Some(2.0)])),
        ),
        (
            "color",
            Arc::new(Int64Array::from(vec![Some(0xFF00_00FF), None, Some(-1)])),
        ),
        (
            "rank",
            Arc::new(Int8Array::from(vec![Some(-4), None, Some(4)])),
        ),
        ("control_points", Arc::new(polygons(3))),
    ]);
    let widths = layout.paths.width_m().expect("widths");
    assert!(widths[0] == 0.5 && widths[1].is_nan() && widths[2] == 2.0);
    assert_eq!(layout.paths.color_rgba(), Some(&[0xFF00_00FF, 0, 0][..]));
    assert_eq!(layout.paths.rank(), Some(&[-4, 1, 4][..]));
    assert_eq!(layout.diagnostics.count(Code::UnknownValue), 1);
}

#[test]
fn attributes_keep_their_type_and_others_become_text() {
    let nested = ListArray::from_iter_primitive::<Int32Type, _, _>([
        Some(vec![Some(1), None]),
        None,
        Some(vec![]),
    ]);
    let layout = read_columns(vec![
        (
            "small",
            Arc::new(Int8Array::from(vec![Some(1), None, Some(-3)])),
        ),
        ("large", Arc::new(UInt64Array::from(vec![u64::MAX, 0, 1]))),
        (
            "busy",
            Arc::new(BooleanArray::from(vec![Some(true), None, Some(false)])),
        ),
        ("day", Arc::new(Date32Array::from(vec![0, 1, 2]))),
        ("nested", Arc::new(nested)),
        ("control_points", Arc::new(polygons(3))),
    ]);
    let small = attribute(&layout, "small");
    assert_eq!(small.values, Values::Int(vec![Some(1), None, Some(-3)]));
    assert_eq!(small.source_type.as_deref(), Some("Int8"));
    let text = |name: &str, row| match attribute(&layout, name).values.get(row) {
        Some(Value::Text(text)) => Some(text.to_owned()),
        None => None,
        other => panic!("{other:?}"),
    };
    assert_eq!(text("large", 0).as_deref(), Some("18446744073709551615"));
    assert_eq!(text("day", 1).as_deref(), Some("1970-01-02"));
    assert_eq!(text("nested", 0).as_deref(), Some("[1, ]"));
    assert_eq!(text("nested", 1), None);
    assert_eq!(
        attribute(&layout, "busy").values,
        Values::Bool(vec![Some(true), None, Some(false)])
    );
    // large, day and nested, and the id that is absent.
    assert_eq!(layout.diagnostics.count(Code::Attribute), 4);
}

#[test]
fn rows_join_to_paths_across_batches_and_are_refused_together() {
    let part = |ids: [&str; 3], parts: [u32; 3], bad: Option<usize>| {
        let list = polygons(3);
        let nulls = arrow_buffer::NullBuffer::from_iter((0..3).map(|row| bad != Some(row)));
        let (item, offsets, values, _) = list.into_parts();
        batch(vec![
            ("id", Arc::new(StringArray::from(ids.to_vec()))),
            ("guideway.part", Arc::new(UInt32Array::from(parts.to_vec()))),
            (
                "control_points",
                Arc::new(ListArray::new(item, offsets, values, Some(nulls))),
            ),
            (
                "row",
                Arc::new(StringArray::from(ids.map(str::to_uppercase).to_vec())),
            ),
        ])
    };
    let layout = read(&file(
        &[
            part(["a", "b", "b"], [0, 0, 1], None),
            // The third run of b cannot be drawn: b goes, and what follows of it.
            part(["b", "b", "c"], [2, 3, 0], Some(0)),
            part(["c", "d", "e"], [1, 0, 0], Some(1)),
        ],
        None,
    ));
    assert_eq!(ids(&layout), ["a", "c", "e"]);
    let runs: Vec<_> = layout.paths.iter().map(|p| p.runs().len()).collect();
    assert_eq!(runs, [1, 2, 1]);
    let refused: Vec<_> = layout.refused.iter().map(|r| (r.id, r.code)).collect();
    assert_eq!(
        refused,
        [("b", Code::MissingField), ("d", Code::MissingField)]
    );
    assert_eq!(
        attribute(&layout, "row").values.get(1),
        Some(Value::Text("C"))
    );
    assert!(layout.diagnostics.is_empty());
}

#[test]
fn a_writer_that_is_dropped_leaves_the_target_as_it_was() {
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
fn values_that_do_not_fit_their_column_are_not_written() {
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
fn buffers_are_aligned_and_narrow_columns_are_narrow() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    let columns = vec![Column::new("speed", ColumnType::Float32)];
    let mut writer = ArrowWriter::create(&path, Precision::F32, columns).expect("a writer");
    for row in 0..70_000_u32 {
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
        [65_536, 4_464]
    );
    assert_eq!(
        batches[1].column(2).as_primitive::<Float32Type>().value(0),
        65_536.0
    );
}

#[test]
fn what_a_table_cannot_hold_is_said() {
    let mut layout = Layout::default();
    let node = layout.nodes.push("N1", Point::new(0.0, 0.0), None);
    layout.levels.push(Level {
        id: "L1".into(),
        name: Some("Ground".into()),
        elevation_m: None,
    });
    let mut runs = Runs::default();
    runs.push_line(Point::new(0.0, 0.0), Point::new(0.1, 5.0));
    layout.paths.push(&NewPath {
        id: "a",
        runs: &runs,
        start_node: Some(node),
        direction: Direction::Both,
        level: Some(0),
        vehicle_types: &["tugger", "forklift"],
        ..NewPath::default()
    });
    layout.refused.push("b", Code::NonFinite, "");
    layout.paths.attributes.set(0, "rank", Value::Text("high"));
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("paths.arrow");
    let losses = write_layout(&layout, &path, &WriteOptions::default()).expect("a file");
    let said: Vec<_> = losses.iter().map(|d| d.place.element.as_str()).collect();
    assert_eq!(said, ["nodes", "levels", "refused paths", "attribute rank"]);
    let back = read_file(&path, &ReadOptions::default()).expect("a layout");
    for (name, value) in [
        ("start_node", "N1"),
        ("direction", "both"),
        ("vehicle_types", "tugger, forklift"),
    ] {
        assert_eq!(
            attribute(&back, name).values.get(0),
            Some(Value::Text(value))
        );
    }
    assert_eq!(back.levels[0].id, "L1");
    // 0.1 is no binary fraction: `f32` holds it to a nanometre, which is exact enough.
    let run = back.paths.get(0).runs().next().expect("a run");
    assert!(matches!(run, RunPoints::F32(_)));
    let far = WriteOptions {
        precision: Some(Precision::F64),
    };
    write_layout(&layout, &path, &far).expect("a file");
    let back = read_file(&path, &ReadOptions::default()).expect("a layout");
    let run = back.paths.get(0).runs().next().expect("a run");
    assert_eq!(run.iter().collect::<Vec<_>>(), runs.points());
}

/// One path to be: its runs, then a value or none for each column.
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
    let text: TextColumn = rows
        .iter()
        .map(|r| r.4.as_deref().unwrap_or_default())
        .collect();
    let present = rows.iter().map(|r| r.4.is_some()).collect();
    layout
        .paths
        .attributes
        .insert(Attribute::new("note", Values::Text { text, present }));
    layout
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_layout_comes_back_as_it_was(rows in prop::collection::vec(row(), 1..12)) {
        let layout = layout_of(&rows);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("paths.arrow");
        let options = WriteOptions { precision: Some(Precision::F64) };
        let losses = write_layout(&layout, &path, &options).expect("a file");
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
        for name in ["serial", "note"] {
            prop_assert_eq!(attribute(&layout, name), attribute(&back, name));
        }
    }
}
