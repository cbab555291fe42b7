//! Point items: converts points as other programs write them (lists or structs of any numbers) to
//! pairs of floating-point numbers.

use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, FixedSizeListArray, Float64Array};
use arrow_buffer::NullBuffer;
use arrow_schema::{DataType, Field, Fields};
use guideway_spline::Point;

use super::budget::Budget;
use super::list_array::{ListArray, flat, numbers, value_or_nan};
use crate::Problem;

/// Names of the fields of a struct that holds a point.
const AXES: [&str; 2] = ["x", "y"];
/// Bytes of a converted point.
const PAIR_BYTES: u64 = 16;

/// Returns whether values of a type are points: lists of numbers, or structs of x and y.
pub(super) fn is_point(item: &DataType) -> bool {
    match item {
        DataType::FixedSizeList(number, count) => *count >= 2 && number.data_type().is_numeric(),
        DataType::List(number)
        | DataType::LargeList(number)
        | DataType::ListView(number)
        | DataType::LargeListView(number) => number.data_type().is_numeric(),
        DataType::Struct(fields) => {
            let is_axis = |name| {
                let field = axis(fields, name).map(|at| fields[at].data_type());
                field.is_some_and(DataType::is_numeric)
            };
            AXES.into_iter().all(is_axis)
        }
        _ => false,
    }
}

/// Returns whether values of a type are pairs of floating-point numbers, which need no conversion.
pub(super) fn is_pair(item: &DataType) -> bool {
    match item {
        DataType::FixedSizeList(number, 2) => {
            matches!(number.data_type(), DataType::Float32 | DataType::Float64)
        }
        _ => false,
    }
}

/// Converts points to pairs. A point of fewer than two numbers is null; further numbers are left
/// out. Returns the pairs and the number of points that had further numbers.
pub(super) fn pairs(
    items: &ArrayRef,
    budget: &Budget,
) -> Result<(FixedSizeListArray, u64), Problem> {
    budget.charge((items.len() as u64).saturating_mul(PAIR_BYTES))?;
    match items.data_type() {
        DataType::Struct(fields) => pairs_of_structs(items, fields),
        _ => pairs_of_lists(items, budget),
    }
}

fn pairs_of_structs(
    items: &ArrayRef,
    fields: &Fields,
) -> Result<(FixedSizeListArray, u64), Problem> {
    let points = items.as_struct();
    let column = |name| {
        let at = axis(fields, name).unwrap_or_default();
        numbers(points.column(at))
    };
    let axes = [column(AXES[0])?, column(AXES[1])?];
    let number = |at: usize, axis: usize| {
        let numbers: &Float64Array = &axes[axis];
        (points.is_valid(at) && numbers.is_valid(at)).then(|| numbers.value(at))
    };
    let heights = match axis(fields, "z") {
        Some(_) => points.len() - points.null_count(),
        None => 0,
    };
    let values = (0..2 * points.len()).map(|i| number(i / 2, i % 2));
    Ok((pair_array(values.collect(), None), heights as u64))
}

fn pairs_of_lists(items: &ArrayRef, budget: &Budget) -> Result<(FixedSizeListArray, u64), Problem> {
    let lists = ListArray::new(&flat(items, budget)?)?;
    let numbers = numbers(lists.items())?;
    let mut heights = 0;
    let mut values = Vec::with_capacity(2 * items.len());
    let mut present = Vec::with_capacity(items.len());
    for row in 0..items.len() {
        let range = lists.range(row).filter(|range| range.len() >= 2);
        present.push(range.is_some());
        heights += u64::from(range.as_ref().is_some_and(|range| range.len() > 2));
        let number = |axis| {
            let at = range.as_ref()?.start + axis;
            numbers.is_valid(at).then(|| numbers.value(at))
        };
        values.extend([number(0), number(1)]);
    }
    let pairs = pair_array(values.into(), Some(present.into()));
    Ok((pairs, heights))
}

fn pair_array(values: Float64Array, present: Option<NullBuffer>) -> FixedSizeListArray {
    let item = Arc::new(Field::new("item", DataType::Float64, true));
    FixedSizeListArray::new(item, 2, Arc::new(values), present)
}

fn axis(fields: &Fields, name: &str) -> Option<usize> {
    fields
        .iter()
        .position(|field| field.name().eq_ignore_ascii_case(name))
}

/// A column of lists of points.
pub(super) struct PointLists {
    lists: ListArray,
    points: FixedSizeListArray,
    coordinates: Float64Array,
}

impl PointLists {
    pub(super) fn new(column: &ArrayRef, budget: &Budget) -> Result<Self, Problem> {
        let lists = ListArray::new(column)?;
        let points = match is_pair(lists.items().data_type()) {
            true => lists.items().as_fixed_size_list().clone(),
            false => pairs(lists.items(), budget)?.0,
        };
        Ok(Self {
            coordinates: numbers(points.values())?,
            lists,
            points,
        })
    }

    /// Returns the points of a row, with NaN for missing numbers; none for null.
    pub(super) fn get(&self, row: usize) -> impl ExactSizeIterator<Item = Point<f64>> {
        let range = self.lists.range(row).unwrap_or_default();
        range.map(move |at| {
            let number = |axis| value_or_nan(&self.coordinates, 2 * at + axis);
            match self.points.is_valid(at) {
                true => Point::new(number(0), number(1)),
                false => Point::new(f64::NAN, f64::NAN),
            }
        })
    }
}
