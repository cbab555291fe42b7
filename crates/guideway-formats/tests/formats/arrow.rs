//! Arrow tables: every type that is promised is read.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::types::Int32Type;
use arrow_array::{
    Array, ArrayRef, BooleanArray, Date32Array, DictionaryArray, FixedSizeBinaryArray,
    FixedSizeListArray, Float64Array, Int8Array, Int64Array, LargeStringArray, ListArray,
    NullArray, RecordBatch, StringArray, StringViewArray, StructArray, UInt32Array, UInt64Array,
};
use arrow_ipc::CompressionType;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions, StreamWriter};
use arrow_schema::{DataType, Field, Schema};
use guideway_formats::{ReadOptions, read_bytes, read_file};
use guideway_layout::{Attribute, Code, Layout, RunPoints, Value, Values};
use guideway_spline::Point;

/// `rows` straight polygons of four points, as list<fixed_size_list<float32, 2>>.
fn polygons(rows: usize) -> ListArray {
    let coordinates = (0..rows).flat_map(|row| (0..4).flat_map(move |x| [x as f32, row as f32]));
    let coordinates = arrow_array::Float32Array::from_iter_values(coordinates);
    let item = Arc::new(Field::new("item", DataType::Float32, true));
    let points = FixedSizeListArray::new(item, 2, Arc::new(coordinates), None);
    let item = Arc::new(Field::new("item", points.data_type().clone(), true));
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
fn points_are_found_behind_columns_of_every_kind() {
    let list = || polygons(3);
    let items = || {
        Arc::new(Field::new(
            "item",
            list().value(0).data_type().clone(),
            true,
        ))
    };
    let cast = |to| arrow_cast::cast(&list(), &to).expect("a cast");
    let numbers = || -> ArrayRef { Arc::new(Int8Array::from(vec![1, 2, 3])) };
    let texts = StringArray::from(vec!["a", "bc", ""]);
    let text = |to| arrow_cast::cast(&texts, &to).expect("a cast");
    let keys = DictionaryArray::<Int32Type>::from_iter(["a", "b", "a"]);
    let records = StructArray::try_from(vec![("a", numbers()), ("b", text(DataType::Utf8))]);
    let columns: Vec<ArrayRef> = vec![
        Arc::new(NullArray::new(3)),
        Arc::new(BooleanArray::from(vec![true, false, true])),
        numbers(),
        Arc::new(Date32Array::from(vec![1, 2, 3])),
        text(DataType::Utf8),
        text(DataType::LargeUtf8),
        text(DataType::Utf8View),
        text(DataType::Binary),
        text(DataType::LargeBinary),
        Arc::new(FixedSizeBinaryArray::try_from_iter(["ab"; 3].iter()).expect("an array")),
        Arc::new(keys),
        Arc::new(list()),
        cast(DataType::LargeList(items())),
        cast(DataType::FixedSizeList(items(), 4)),
        cast(DataType::ListView(items())),
        Arc::new(records.expect("columns of one length")),
    ];
    let check = |before: &[ArrayRef]| {
        let names: Vec<String> = (0..before.len()).map(|i| i.to_string()).collect();
        let before = names.iter().map(String::as_str).zip(before.iter().cloned());
        let mut columns: Vec<(&str, ArrayRef)> = before.collect();
        columns.push(("control_points", Arc::new(list())));
        columns.push(("behind", Arc::new(list())));
        let layout = read_columns(columns);
        for path in 0..3 {
            let run = layout.paths.get(path).runs().next().expect("a run");
            let points: Vec<Point<f64>> = run.iter().collect();
            let expected = |x| Point::new(f64::from(x), path as f64);
            assert_eq!(
                points,
                (0..4).map(expected).collect::<Vec<_>>(),
                "{names:?}"
            );
        }
    };
    for column in &columns {
        check(std::slice::from_ref(column));
        check(&[column.clone(), column.clone()]);
    }
}

#[test]
fn a_file_and_its_bytes_are_one_layout() {
    // More than is read ahead at once, with rows that are refused.
    let rows = 60_000;
    let list = polygons(rows);
    let nulls = (0..rows).map(|row| row % 7_001 != 3).collect::<Vec<bool>>();
    let (item, offsets, values, _) = list.into_parts();
    let list = ListArray::new(item, offsets, values, Some(nulls.into()));
    let ids: Vec<String> = (0..rows).map(|row| format!("path-{row}")).collect();
    let batch = batch(vec![
        ("control_points", Arc::new(list)),
        ("id", Arc::new(StringArray::from(ids))),
    ]);
    for compression in [None, Some(CompressionType::LZ4_FRAME)] {
        let bytes = file(
            &[batch.clone(), batch.slice(5, 100), batch.clone()],
            compression,
        );
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("paths");
        std::fs::write(&path, &bytes).expect("a file");
        let of_file = read_file(&path, &ReadOptions::default()).expect("a layout");
        let of_bytes = read(&bytes);
        assert_eq!(of_file.refused.len(), 2 * rows.div_ceil(7_001));
        for (a, b) in of_file.paths.iter().zip(of_bytes.paths.iter()) {
            let points = a.runs().flat_map(|run| run.iter().collect::<Vec<_>>());
            let of_bytes = b.runs().flat_map(|run| run.iter().collect::<Vec<_>>());
            assert!(a.id() == b.id() && points.eq(of_bytes), "{}", a.id());
            let row: f64 = a.id()[5..].parse().expect("a number");
            let run = a.runs().next().expect("a run");
            assert_eq!(run.get(3), Point::new(3.0, row));
        }
        assert_eq!(of_file.paths.len(), of_bytes.paths.len());
    }
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
    assert_eq!(
        small.values,
        Values::Int([Some(1), None, Some(-3)].into_iter().collect())
    );
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
        Values::Bool([Some(true), None, Some(false)].into_iter().collect())
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
fn values_stay_with_their_paths_where_rows_between_are_refused() {
    let text = |i: usize| format!("{}é", "x".repeat(i));
    let words: Vec<String> = (0..6).map(text).collect();
    let with_none = |i: usize| (i != 4).then(|| text(i));
    let batch = |list: ListArray| {
        batch(vec![
            ("id", Arc::new(StringArray::from(words.clone()))),
            (
                "zone",
                Arc::new((0..6).map(with_none).collect::<StringArray>()),
            ),
            ("word", Arc::new(StringArray::from(words.clone()))),
            (
                "speed",
                Arc::new(Float64Array::from_iter_values((0..6).map(f64::from))),
            ),
            ("control_points", Arc::new(list)),
        ])
    };
    let (item, _, points, _) = polygons(6).into_parts();
    // The second and the last of these have no four points.
    let lengths = arrow_buffer::OffsetBuffer::from_lengths([4, 2, 4, 4, 5, 3]);
    let broken = ListArray::new(item, lengths, points, None);
    let layout = read(&file(&[batch(broken), batch(polygons(6))], None));
    let rows = [0, 2, 3, 4, 0, 1, 2, 3, 4, 5];
    assert_eq!(ids(&layout), rows.map(text));
    assert_eq!(layout.refused.len(), 2);
    for (path, row) in rows.into_iter().enumerate() {
        let value = |name| attribute(&layout, name).values.get(path);
        assert_eq!(value("word"), Some(Value::Text(&words[row])));
        assert_eq!(value("speed"), Some(Value::Float(row as f64)));
        let zone = (row != 4).then_some(Value::Text(&words[row]));
        assert_eq!(value("zone"), zone, "path {path}");
    }
}

#[test]
fn a_text_that_is_too_long_is_found_among_others() {
    let mut options = ReadOptions::default();
    options.limits.text_bytes = 3;
    for column in ["id", "zone"] {
        let texts: ArrayRef = Arc::new(StringArray::from(vec!["abc", "abcd", "a"]));
        let columns = vec![
            (column, texts),
            ("control_points", Arc::new(polygons(3)) as ArrayRef),
        ];
        let error = read_bytes("test", &file(&[batch(columns)], None), &options)
            .expect_err("the second text is too long");
        assert!(error.to_string().contains("bytes in one text"), "{error}");
    }
}

#[test]
fn numbers_of_all_batches_become_text_if_a_late_one_is_too_large() {
    let large = |values: Vec<Option<u64>>| {
        batch(vec![
            ("large", Arc::new(UInt64Array::from(values))),
            ("control_points", Arc::new(polygons(3))),
        ])
    };
    let first = large(vec![Some(7), None, Some(0)]);
    let last = large(vec![Some(1), Some(u64::MAX), None]);
    let layout = read(&file(&[first.clone(), last], None));
    let values = &attribute(&layout, "large").values;
    let texts: Vec<_> = (0..6).map(|row| values.get(row)).collect();
    let text = |text| Some(Value::Text(text));
    let most = text("18446744073709551615");
    assert_eq!(texts, [text("7"), None, text("0"), text("1"), most, None]);
    let layout = read(&file(&[first], None));
    let values = &attribute(&layout, "large").values;
    assert_eq!(
        *values,
        Values::Int([Some(7), None, Some(0)].into_iter().collect())
    );
}

#[test]
fn a_path_of_many_batches_is_refused_for_its_last_row() {
    let part = |ids: [&str; 2], parts: [u32; 2], bad: bool| {
        let (item, offsets, values, _) = polygons(2).into_parts();
        let nulls = arrow_buffer::NullBuffer::from(vec![!bad, true]);
        let list = ListArray::new(item, offsets, values, Some(nulls));
        batch(vec![
            ("id", Arc::new(StringArray::from(ids.to_vec()))),
            ("guideway.part", Arc::new(UInt32Array::from(parts.to_vec()))),
            ("control_points", Arc::new(list)),
            ("name", Arc::new(StringArray::from(ids.to_vec()))),
        ])
    };
    let batches = |bad| {
        [
            part(["a", "b"], [0, 0], false),
            part(["b", "b"], [1, 2], false),
            part(["b", "b"], [3, 4], false),
            part(["b", "c"], [5, 0], bad),
        ]
    };
    for (bad, expected) in [(false, &["a", "b", "c"][..]), (true, &["a", "c"])] {
        let layout = read(&file(&batches(bad), None));
        assert_eq!(ids(&layout), expected);
        let names = &attribute(&layout, "name").values;
        assert_eq!(names.len(), expected.len());
        for (row, &name) in expected.iter().enumerate() {
            assert_eq!(names.get(row), Some(Value::Text(name)));
        }
        let refused: Vec<_> = layout.refused.iter().map(|r| r.id).collect();
        assert_eq!(refused, if bad { &["b"][..] } else { &[] });
    }
}
