//! Column types: the tests by which a column fits a meaning.

use arrow_schema::{DataType, Fields};

use super::column_names::{DEGREE, KNOTS, MEMBER_ELEMENT, MEMBER_INDEX, POINTS, WEIGHTS};
use super::point_items::is_point;

/// Returns the type of the values, which a dictionary may hold.
pub(super) fn value_type(column: &DataType) -> &DataType {
    match column {
        DataType::Dictionary(_, values) => values,
        plain => plain,
    }
}

/// Returns whether values are text, in any encoding.
pub(super) fn is_text(column: &DataType) -> bool {
    matches!(
        value_type(column),
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View
    )
}

pub(super) fn is_id(column: &DataType) -> bool {
    is_text(column) || is_integer(column)
}

pub(super) fn is_integer(column: &DataType) -> bool {
    column.is_integer()
}

pub(super) fn is_number(column: &DataType) -> bool {
    column.is_integer() || column.is_floating()
}

/// Returns whether a column has lists whose items fit.
fn is_list(column: &DataType, fits: impl Fn(&DataType) -> bool) -> bool {
    match column {
        DataType::List(items) | DataType::LargeList(items) | DataType::FixedSizeList(items, _) => {
            fits(items.data_type())
        }
        _ => false,
    }
}

pub(super) fn is_texts(column: &DataType) -> bool {
    is_list(column, is_text)
}

pub(super) fn is_integers(column: &DataType) -> bool {
    is_list(column, is_integer)
}

pub(super) fn is_points(column: &DataType) -> bool {
    is_list(column, is_point)
}

pub(super) fn is_members(column: &DataType) -> bool {
    is_list(column, |item| match item {
        DataType::Struct(fields) => {
            has(fields, MEMBER_ELEMENT, is_text) && has(fields, MEMBER_INDEX, is_integer)
        }
        _ => false,
    })
}

pub(super) fn is_curve(column: &DataType) -> bool {
    let is_numbers = |column: &DataType| is_list(column, is_number);
    match column {
        DataType::Struct(fields) => {
            has(fields, DEGREE, is_integer)
                && has(fields, KNOTS, is_numbers)
                && has(fields, WEIGHTS, is_numbers)
                && has(fields, POINTS, is_points)
        }
        _ => false,
    }
}

fn has(fields: &Fields, name: &str, fits: impl Fn(&DataType) -> bool) -> bool {
    let field = fields.find(name);
    field.is_some_and(|(_, field)| fits(field.data_type()))
}
