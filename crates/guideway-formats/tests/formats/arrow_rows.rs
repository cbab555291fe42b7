//! Arrow rows: parts joined to paths, refused rows, and the columns of the drawn paths.

use std::sync::Arc;

use arrow_array::types::Int32Type;
use arrow_array::{
    ArrayRef, BooleanArray, Date32Array, Float64Array, Int8Array, Int64Array, ListArray,
    StringArray, UInt32Array, UInt64Array,
};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{Code, Value, Values};

use crate::arrow_tables::{attribute, batch, file, ids, polygons, read, read_columns};

#[test]
fn joins_parts_across_batches_and_refuses_whole_paths() {
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
            // The third run of b cannot be drawn, so b and its later parts are refused.
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
    let found = layout.diagnostics.iter();
    let found: Vec<_> = found.map(|d| (d.code, d.place.element.as_str())).collect();
    let missing = |place| (Code::MissingField, place);
    assert_eq!(found, [missing("path \"b\""), missing("path \"d\"")]);
}

#[test]
fn keeps_values_aligned_after_refused_rows() {
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
fn converts_all_batches_to_text_for_a_late_u64() {
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
    let max = text("18446744073709551615");
    assert_eq!(texts, [text("7"), None, text("0"), text("1"), max, None]);
    let layout = read(&file(&[first], None));
    let values = &attribute(&layout, "large").values;
    assert_eq!(
        *values,
        Values::Int([Some(7), None, Some(0)].into_iter().collect())
    );
}

#[test]
fn refuses_a_path_of_many_batches_for_its_last_row() {
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

#[test]
fn rejects_text_above_the_limit() {
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
fn keeps_attribute_types_and_formats_others_as_text() {
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
fn reads_style_columns_of_other_types_and_nulls() {
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
