//! Arrow tables as other programs write them: control points of any list type, and columns of types
//! that layouts do not have.

use std::sync::Arc;

use arrow_array::types::{Float64Type, Int32Type, UInt8Type};
use arrow_array::{
    Array, ArrayRef, DictionaryArray, FixedSizeListArray, Float64Array, Int8Array,
    LargeStringArray, ListArray, StringArray, StringViewArray, StructArray,
    TimestampMicrosecondArray, TimestampSecondArray,
};
use arrow_buffer::OffsetBuffer;
use arrow_schema::{DataType, Field};
use guideway_layout::{Code, Layout, Value};
use guideway_spline::Point;

use crate::arrow_tables::{attribute, batch, file, polygons, read, read_columns};

/// Reads a table of one straight path and a column.
fn read_attribute(column: ArrayRef) -> Layout {
    let rows = column.len();
    read_columns(vec![
        ("a", column),
        ("control_points", Arc::new(polygons(rows))),
    ])
}

fn text(layout: &Layout, row: usize) -> Option<String> {
    match attribute(layout, "a").values.get(row) {
        Some(Value::Text(text)) => Some(text.to_owned()),
        None => None,
        other => panic!("{other:?}"),
    }
}

/// The library refuses a batch for one byte of one text.
#[test]
fn texts_that_are_not_utf8_do_not_refuse_a_file() {
    let texts = StringArray::from(vec!["W?nde", "ok"]);
    let columns: [(ArrayRef, &str, u64); 6] = [
        (Arc::new(texts.clone()), "W\u{FFFD}nde", 1),
        (
            Arc::new(LargeStringArray::from(vec!["W?nde", "ok"])),
            "W\u{FFFD}nde",
            1,
        ),
        (
            Arc::new(StringViewArray::from(vec!["W?nde", "ok"])),
            "W\u{FFFD}nde",
            1,
        ),
        (
            Arc::new(DictionaryArray::<Int32Type>::from_iter(["W?nde", "ok"])),
            "W\u{FFFD}nde",
            1,
        ),
        (
            Arc::new(ListArray::new(
                Arc::new(Field::new("item", DataType::Utf8, true)),
                OffsetBuffer::from_lengths([1, 1]),
                Arc::new(texts.clone()),
                None,
            )),
            "[W\u{FFFD}nde]",
            1,
        ),
        (
            Arc::new(StructArray::from(vec![(
                Arc::new(Field::new("k", DataType::Utf8, true)),
                Arc::new(texts) as ArrayRef,
            )])),
            "{k: W\u{FFFD}nde}",
            1,
        ),
    ];
    for (column, expected, count) in columns {
        let kind = column.data_type().to_string();
        let ids: ArrayRef = Arc::new(StringArray::from(vec!["x", "y"]));
        let points: ArrayRef = Arc::new(polygons(2));
        let table = batch(vec![("id", ids), ("a", column), ("control_points", points)]);
        let mut bytes = file(&[table], None);
        let at = bytes.windows(5).position(|part| part == b"W?nde").unwrap();
        bytes[at + 1] = 0xE4;
        let layout = read(&bytes);
        assert_eq!(crate::arrow_tables::ids(&layout), ["x", "y"], "{kind}");
        assert_eq!(text(&layout, 0).as_deref(), Some(expected), "{kind}");
        let message = format!("{count} texts are not UTF-8");
        let mut found = layout.diagnostics.iter();
        assert!(
            found.any(|d| d.message == message && d.place.element == "column a"),
            "{kind}"
        );
    }
}

#[test]
fn times_of_any_zone_are_kept_in_utc() {
    let times = |zone: &str| {
        let times = TimestampMicrosecondArray::from(vec![Some(1_714_557_600_000_000), None]);
        times.with_timezone(zone)
    };
    for (zone, expected, is_lost) in [
        ("UTC", "2024-05-01T10:00:00Z", false),
        ("Etc/UTC", "2024-05-01T10:00:00Z", false),
        ("GMT", "2024-05-01T10:00:00Z", false),
        ("Europe/Berlin", "2024-05-01T10:00:00Z", true),
        ("no such zone", "2024-05-01T10:00:00Z", true),
        ("+02:00", "2024-05-01T12:00:00+02:00", false),
    ] {
        let layout = read_attribute(Arc::new(times(zone)));
        assert_eq!(layout.paths.len(), 2, "{zone}");
        assert_eq!(text(&layout, 0).as_deref(), Some(expected), "{zone}");
        assert_eq!(text(&layout, 1), None, "{zone}");
        let found: Vec<&str> = layout
            .diagnostics
            .iter()
            .map(|d| d.message.as_str())
            .collect();
        let lost = format!("the time zone {zone} is lost");
        assert_eq!(
            found.iter().any(|message| *message == lost),
            is_lost,
            "{found:?}"
        );
    }
}

#[test]
fn zones_within_other_types_refuse_no_file() {
    let times = TimestampSecondArray::from(vec![0, 60]).with_timezone("Asia/Tokyo");
    let item = Arc::new(Field::new("t", times.data_type().clone(), true));
    let times: ArrayRef = Arc::new(times);
    let fields = vec![(Arc::clone(&item), Arc::clone(&times))];
    let lists = |item| {
        let offsets = OffsetBuffer::from_lengths([1, 1]);
        ListArray::new(item, offsets, Arc::clone(&times), None)
    };
    let keys = arrow_array::Int32Array::from(vec![1, 0]);
    let columns: [(ArrayRef, &str); 3] = [
        (
            Arc::new(StructArray::from(fields)),
            "{t: 1970-01-01T00:00:00Z}",
        ),
        (Arc::new(lists(item)), "[1970-01-01T00:00:00Z]"),
        (
            Arc::new(DictionaryArray::<Int32Type>::new(keys, Arc::clone(&times))),
            "1970-01-01T00:01:00Z",
        ),
    ];
    for (column, expected) in columns {
        assert_eq!(text(&read_attribute(column), 0).as_deref(), Some(expected));
    }
}

#[test]
fn times_beyond_the_calendar_are_kept_as_numbers() {
    let far = 9_000_000_000_000_000_000;
    let times = TimestampSecondArray::from(vec![0, far]);
    let layout = read_attribute(Arc::new(times));
    assert_eq!(text(&layout, 0).as_deref(), Some("1970-01-01T00:00:00"));
    assert_eq!(text(&layout, 1), Some(far.to_string()));
    // A struct has no number: the value is missing, and reported.
    let times: ArrayRef = Arc::new(TimestampSecondArray::from(vec![0, far]));
    let field = Arc::new(Field::new("t", times.data_type().clone(), true));
    let layout = read_attribute(Arc::new(StructArray::from(vec![(field, times)])));
    assert_eq!(text(&layout, 1), None);
    let mut found = layout.diagnostics.iter();
    assert!(found.any(|d| d.message.contains("1 values that have no text")));
}

/// The points of one row.
const POINTS: [[f64; 2]; 4] = [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, 7.0]];

fn item(data_type: &DataType) -> Arc<Field> {
    Arc::new(Field::new("item", data_type.clone(), true))
}

/// A list of these points in one row.
fn one_row(points: ArrayRef) -> ListArray {
    let offsets = OffsetBuffer::from_lengths([points.len()]);
    ListArray::new(item(points.data_type()), offsets, points, None)
}

fn numbers(axes: usize) -> Float64Array {
    let extra = [100.0, 200.0];
    let numbers = POINTS
        .iter()
        .flat_map(|p| p.iter().chain(&extra).take(axes));
    numbers.copied().collect()
}

#[test]
fn control_points_of_any_list_type_are_read() {
    let lists = |axes: usize| -> ArrayRef {
        let offsets = OffsetBuffer::from_lengths(vec![axes; 4]);
        let numbers = Arc::new(numbers(axes));
        Arc::new(ListArray::new(
            item(numbers.data_type()),
            offsets,
            numbers,
            None,
        ))
    };
    let fixed = |axes: usize| -> ArrayRef {
        let numbers = Arc::new(numbers(axes));
        Arc::new(FixedSizeListArray::new(
            item(numbers.data_type()),
            axes as i32,
            numbers,
            None,
        ))
    };
    let structs = |names: &[&str]| -> ArrayRef {
        let axis = |(axis, name): (usize, &&str)| {
            let of = |p: &[f64; 2]| p.get(axis).copied().unwrap_or(100.0);
            let numbers: Float64Array = POINTS.iter().map(of).collect();
            let numbers: ArrayRef = Arc::new(numbers);
            (
                Arc::new(Field::new(*name, DataType::Float64, true)),
                numbers,
            )
        };
        Arc::new(StructArray::from(
            names.iter().enumerate().map(axis).collect::<Vec<_>>(),
        ))
    };
    let small: Int8Array = POINTS.iter().flatten().map(|&n| n as i8).collect();
    let small = Arc::new(small);
    let ints = FixedSizeListArray::new(item(small.data_type()), 2, small, None);
    let cases: Vec<(&str, ListArray, bool)> = vec![
        ("list<list<double>>", one_row(lists(2)), false),
        ("list<list> of three", one_row(lists(3)), true),
        ("fixed of three", one_row(fixed(3)), true),
        ("struct x y", one_row(structs(&["x", "y"])), false),
        ("struct X Y z", one_row(structs(&["X", "Y", "z"])), true),
        ("integers", one_row(Arc::new(ints)), false),
    ];
    for (name, column, has_heights) in cases {
        let layout = read_columns(vec![("control_points", Arc::new(column))]);
        assert_points(&layout, name);
        let mut found = layout.diagnostics.iter();
        let reported = found.any(|d| d.message.contains("more than two numbers"));
        assert_eq!(reported, has_heights, "{name}");
    }
    let keys = arrow_array::UInt8Array::from(vec![0]);
    let dictionary = DictionaryArray::<UInt8Type>::new(keys, Arc::new(one_row(fixed(2))));
    let layout = read(&file(
        &[batch(vec![("control_points", Arc::new(dictionary))])],
        None,
    ));
    assert_points(&layout, "dictionary");
}

fn assert_points(layout: &Layout, name: &str) {
    assert_eq!(layout.paths.len(), 1, "{name}");
    let runs = layout.paths.get(0).runs();
    let points: Vec<_> = runs
        .flat_map(|run| run.iter().collect::<Vec<_>>())
        .collect();
    assert_eq!(points, POINTS.map(|[x, y]| Point::new(x, y)), "{name}");
}

#[test]
fn a_point_without_two_numbers_refuses_its_path() {
    let list = ListArray::from_iter_primitive::<Float64Type, _, _>([
        Some(vec![Some(0.0), Some(1.0)]),
        Some(vec![Some(2.0)]),
        None,
        Some(vec![Some(6.0), None]),
    ]);
    let layout = read_columns(vec![("control_points", Arc::new(one_row(Arc::new(list))))]);
    let refused: Vec<_> = layout.refused.iter().map(|r| (r.code, r.detail)).collect();
    assert_eq!(refused, [(Code::MissingField, "control point 1 is null")]);
}

#[test]
fn all_public_cases_are_read() {
    let Some(folder) = crate::common::shared("cases/arrow") else {
        return;
    };
    for name in [
        "tz_utc",
        "tz_etc",
        "tz_off",
        "a10_types",
        "a11b_list_list",
        "a11c_list_struct_xy",
        "a11d_xyz",
        "a11e_fixed_fixed",
        "a11f_list_view",
        "a11g_ints",
        "a11h_half",
        "a11i_dict_cp",
        "a24d_polars_listlist",
        "a25b_duckdb_struct",
        "a25e_duckdb_listlist",
    ] {
        let layout = crate::common::read_real(&folder.join(format!("{name}.arrow")));
        assert!(
            !layout.paths.is_empty() && layout.refused.is_empty(),
            "{name}"
        );
    }
    for name in ["a23_pandas.feather", "a23b_pandas_idx.feather"] {
        let layout = crate::common::read_real(&folder.join(name));
        assert!(
            !layout.paths.is_empty() && layout.refused.is_empty(),
            "{name}"
        );
    }
}
