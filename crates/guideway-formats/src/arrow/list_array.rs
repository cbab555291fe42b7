//! List arrays: uniform access to the lists of a column, and to points in them.

use std::ops::Range;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt32Type};
use arrow_array::{Array, ArrayRef, Float64Array, LargeListArray, UInt32Array};
use arrow_schema::DataType;
use guideway_spline::Point;

use super::cast::cast;
use crate::Problem;

/// A column of lists, whose items lie in sequence in one array.
pub(super) struct ListArray(LargeListArray);

impl ListArray {
    /// Interprets a column of lists: `list`, `large_list` or `fixed_size_list`.
    pub(super) fn new(column: &ArrayRef) -> Result<Self, Problem> {
        let item = match column.data_type() {
            DataType::List(item) | DataType::FixedSizeList(item, _) => Arc::clone(item),
            _ => return Ok(Self(column.as_list::<i64>().clone())),
        };
        let large = cast(column, &DataType::LargeList(item))?;
        Ok(Self(large.as_list::<i64>().clone()))
    }

    /// Returns the items of all rows.
    pub(super) fn items(&self) -> &ArrayRef {
        self.0.values()
    }

    /// Returns the range of the items of a row, or `None` for null.
    pub(super) fn range(&self, row: usize) -> Option<Range<usize>> {
        let offsets = self.0.value_offsets();
        let range = offsets[row] as usize..offsets[row + 1] as usize;
        self.0.is_valid(row).then_some(range)
    }
}

/// A column of lists of whole numbers. Numbers that do not fit are null.
pub(super) struct IndexLists {
    lists: ListArray,
    items: UInt32Array,
}

impl IndexLists {
    pub(super) fn new(column: &ArrayRef) -> Result<Self, Problem> {
        let lists = ListArray::new(column)?;
        let items = indices(lists.items())?;
        Ok(Self { lists, items })
    }

    /// Returns the numbers of a row, none for null.
    pub(super) fn get(&self, row: usize) -> impl Iterator<Item = Option<u32>> {
        let range = self.lists.range(row).unwrap_or_default();
        range.map(|at| self.items.is_valid(at).then(|| self.items.value(at)))
    }
}

/// A column of lists of numbers.
pub(super) struct NumberLists {
    lists: ListArray,
    items: Float64Array,
}

impl NumberLists {
    pub(super) fn new(column: &ArrayRef) -> Result<Self, Problem> {
        let lists = ListArray::new(column)?;
        let items = numbers(lists.items())?;
        Ok(Self { lists, items })
    }

    /// Returns the numbers of a row, NaN for a missing one; `None` for null.
    pub(super) fn get(&self, row: usize) -> Option<Vec<f64>> {
        let range = self.lists.range(row)?;
        Some(range.map(|at| value_or_nan(&self.items, at)).collect())
    }
}

/// A column of lists of points.
pub(super) struct PointLists {
    lists: ListArray,
    coordinates: Float64Array,
}

impl PointLists {
    pub(super) fn new(column: &ArrayRef) -> Result<Self, Problem> {
        let lists = ListArray::new(column)?;
        let points = lists.items().as_fixed_size_list();
        let coordinates = numbers(points.values())?;
        Ok(Self { lists, coordinates })
    }

    /// Returns the points of a row, with NaN for missing numbers; none for null.
    pub(super) fn get(&self, row: usize) -> impl ExactSizeIterator<Item = Point<f64>> {
        let points = self.lists.items().as_fixed_size_list();
        let range = self.lists.range(row).unwrap_or_default();
        range.map(move |at| {
            let number = |axis| value_or_nan(&self.coordinates, 2 * at + axis);
            match points.is_valid(at) {
                true => Point::new(number(0), number(1)),
                false => Point::new(f64::NAN, f64::NAN),
            }
        })
    }
}

/// Casts a column to row numbers; numbers that do not fit are null.
pub(super) fn indices(column: &ArrayRef) -> Result<UInt32Array, Problem> {
    let cast = cast(column, &DataType::UInt32)?;
    Ok(cast.as_primitive::<UInt32Type>().clone())
}

fn numbers(column: &ArrayRef) -> Result<Float64Array, Problem> {
    let cast = cast(column, &DataType::Float64)?;
    Ok(cast.as_primitive::<Float64Type>().clone())
}

fn value_or_nan(numbers: &Float64Array, at: usize) -> f64 {
    match numbers.is_valid(at) {
        true => numbers.value(at),
        false => f64::NAN,
    }
}
