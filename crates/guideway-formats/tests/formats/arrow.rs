//! Arrow container and encodings: files, streams, and every promised type of text, list and column.

use std::sync::Arc;

use arrow_array::types::Int32Type;
use arrow_array::{
    Array, ArrayRef, BooleanArray, Date32Array, DictionaryArray, FixedSizeBinaryArray, Int8Array,
    Int64Array, LargeStringArray, ListArray, NullArray, StringArray, StringViewArray, StructArray,
};
use arrow_ipc::CompressionType;
use arrow_ipc::writer::{DictionaryHandling, IpcWriteOptions, StreamWriter};
use arrow_schema::{DataType, Field};
use guideway_formats::{ReadOptions, read_file};
use guideway_layout::{Code, RunPoints, Value};
use guideway_spline::Point;

use crate::arrow_tables::{attribute, batch, file, ids, polygons, read, read_columns};

#[test]
fn reads_all_batches_of_files_and_streams() {
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

/// A stream of batches with a dictionary of texts that grows from one to the next.
fn grown_dictionary() -> Vec<u8> {
    let rows: [&[&str]; 3] = [&["a", "W?nde"], &["a", "b"], &["c", "b"]];
    let mut values: Vec<&str> = Vec::new();
    let batches = rows.map(|rows| {
        for row in rows {
            if !values.contains(row) {
                values.push(row);
            }
        }
        let key = |row: &&str| values.iter().position(|value| value == row);
        let keys = rows.iter().map(|row| key(row).map(|key| key as i32));
        let texts = Arc::new(StringArray::from(values.clone()));
        let column = DictionaryArray::<Int32Type>::new(keys.collect(), texts);
        batch(vec![
            ("name", Arc::new(column)),
            ("control_points", Arc::new(polygons(2))),
        ])
    });
    let options = IpcWriteOptions::default().with_dictionary_handling(DictionaryHandling::Delta);
    let schema = batches[0].schema();
    let stream = StreamWriter::try_new_with_options(Vec::new(), &schema, options);
    let mut stream = stream.expect("a writer");
    for batch in &batches {
        stream.write(batch).expect("a batch");
    }
    stream.into_inner().expect("a stream")
}

#[test]
fn reads_dictionaries_that_grow() {
    let mut stream = grown_dictionary();
    let names = |stream: &[u8]| -> Vec<String> {
        let layout = read(stream);
        let column = layout.paths.attributes.get("name").expect("a column");
        let rows = 0..layout.paths.len();
        rows.map(|row| column.values.get(row).expect("a text").to_string())
            .collect()
    };
    assert_eq!(names(&stream), ["a", "W?nde", "a", "b", "c", "b"]);
    // The first texts are not UTF-8, those that come later are.
    let at = stream.windows(6).position(|bytes| bytes == b"aW?nde");
    stream[at.expect("the first texts") + 2] = 0xE4;
    assert_eq!(names(&stream), ["a", "W\u{FFFD}nde", "a", "b", "c", "b"]);
}

#[test]
fn reads_every_text_encoding() {
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
fn reads_every_list_type() {
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
fn finds_points_after_columns_of_every_type() {
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
fn file_and_bytes_give_the_same_layout() {
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
