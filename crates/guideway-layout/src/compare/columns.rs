//! Differences of columns, cell by cell.

use std::collections::BTreeSet;

use super::difference::{CompareOptions, Differences};
use crate::{Attributes, Value};

/// Names of the columns of several tables, each once.
pub(super) fn names<'a>(tables: &[&'a Attributes]) -> BTreeSet<&'a str> {
    let columns = tables.iter().flat_map(|table| table.iter());
    columns.map(|column| column.name.as_str()).collect()
}

/// Compares all cells of one row of two tables.
pub(super) fn compare_row(
    [a, b]: [(&Attributes, usize); 2],
    element: impl Fn() -> String,
    options: &CompareOptions,
    found: &mut Differences,
) {
    for name in names(&[a.0, b.0]) {
        let cells = [a.0.value(a.1, name), b.0.value(b.1, name)];
        compare_cells(cells, name, &element, options, found);
    }
}

/// Compares two cells of a column.
pub(super) fn compare_cells(
    cells: [Option<Value<'_>>; 2],
    name: &str,
    element: impl Fn() -> String,
    options: &CompareOptions,
    found: &mut Differences,
) {
    if are_equal(cells, options.relative_tolerance) {
        return;
    }
    let what = match cells[0] {
        Some(_) => format!("column {name}"),
        None => format!("new column {name}"),
    };
    found.add(&what, || {
        let [before, after] = cells.map(describe);
        format!("{}: {name} is {after} instead of {before}", element())
    });
}

/// Returns `true` if two cells are equal, numbers within a relative tolerance. A whole number
/// equals the number of the same value; NaN equals NaN; JSON texts may differ in white space.
pub(super) fn are_equal(cells: [Option<Value<'_>>; 2], relative_tolerance: f64) -> bool {
    match cells {
        [None, None] => true,
        [Some(Value::Int(a)), Some(Value::Int(b))] => a == b,
        [Some(a), Some(b)] => match (a.number(), b.number()) {
            (Some(a), Some(b)) => {
                let size = a.abs().max(b.abs());
                a == b || (a - b).abs() <= size * relative_tolerance || a.is_nan() && b.is_nan()
            }
            _ => match (a, b) {
                (Value::Json(a), Value::Json(b)) => is_same_json(a, b),
                _ => a == b,
            },
        },
        _ => false,
    }
}

/// Returns true if two JSON texts are the same but for white space between their tokens.
fn is_same_json(a: &str, b: &str) -> bool {
    significant_bytes(a).eq(significant_bytes(b))
}

/// The bytes of a JSON text without the white space outside of its strings.
fn significant_bytes(text: &str) -> impl Iterator<Item = u8> {
    let (mut is_string, mut is_escaped) = (false, false);
    text.bytes().filter(move |&byte| {
        let is_kept = is_string || !byte.is_ascii_whitespace();
        if byte == b'"' && !is_escaped {
            is_string = !is_string;
        }
        is_escaped = is_string && byte == b'\\' && !is_escaped;
        is_kept
    })
}

fn describe(cell: Option<Value<'_>>) -> String {
    match cell {
        None => "absent".to_owned(),
        Some(Value::Text(text)) => format!("{text:?}"),
        Some(value) => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_equal_by_value_and_kind() {
        let equal = |a, b| are_equal([a, b], 1e-12);
        assert!(equal(Some(Value::Int(2)), Some(Value::Float(2.0))));
        assert!(equal(
            Some(Value::Float(0.1 + 0.2)),
            Some(Value::Float(0.3))
        ));
        assert!(equal(
            Some(Value::Float(f64::NAN)),
            Some(Value::Float(f64::NAN))
        ));
        assert!(!equal(
            Some(Value::Int(1 << 60)),
            Some(Value::Int((1 << 60) + 1))
        ));
        assert!(!equal(Some(Value::Text("2")), Some(Value::Int(2))));
        assert!(!equal(Some(Value::Text("[]")), Some(Value::Json("[]"))));
        assert!(!equal(Some(Value::Text("")), None));
        let json = |a, b| equal(Some(Value::Json(a)), Some(Value::Json(b)));
        assert!(json(r#"{"a\"": [1, " x"]}"#, "{\"a\\\"\":[1,\n\" x\"]}"));
        assert!(!json(r#"["a b"]"#, r#"["ab"]"#));
        assert!(!json(r#"["a\\", " "]"#, r#"["a\\",""]"#));
    }
}
