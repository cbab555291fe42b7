//! List arrays: uniform access to the lists of a column.

use std::ops::Range;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt32Type};
use arrow_array::{Array, ArrayRef, Float64Array, LargeListArray, UInt32Array, new_null_array};
use arrow_schema::DataType;

use super::budget::Budget;
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

/// Casts a column to row numbers; numbers that do not fit are null.
pub(super) fn indices(column: &ArrayRef) -> Result<UInt32Array, Problem> {
    let cast = cast(column, &DataType::UInt32)?;
    Ok(cast.as_primitive::<UInt32Type>().clone())
}

pub(super) fn numbers(column: &ArrayRef) -> Result<Float64Array, Problem> {
    let cast = cast(column, &DataType::Float64)?;
    Ok(cast.as_primitive::<Float64Type>().clone())
}

pub(super) fn value_or_nan(numbers: &Float64Array, at: usize) -> f64 {
    match numbers.is_valid(at) {
        true => numbers.value(at),
        false => f64::NAN,
    }
}

/// Converts a list view column to a list column, whose rows are in sequence.
///
/// Views may refer to the same items many times; the copies are charged to the budget.
pub(super) fn flat(column: &ArrayRef, budget: &Budget) -> Result<ArrayRef, Problem> {
    let (items, values, count) = match column.data_type() {
        DataType::ListView(items) => {
            let views = column.as_list_view::<i32>();
            let sizes = views.sizes().iter().map(|&size| size as u64);
            (items, views.values(), sizes.sum::<u64>())
        }
        DataType::LargeListView(items) => {
            let views = column.as_list_view::<i64>();
            let sizes = views.sizes().iter().map(|&size| size as u64);
            (items, views.values(), sizes.sum::<u64>())
        }
        _ => return Ok(Arc::clone(column)),
    };
    charge_copies(count, values, budget)?;
    cast(column, &DataType::LargeList(Arc::clone(items)))
}

/// Converts a dictionary of lists to the lists that its keys name, which are charged to the budget.
pub(super) fn unpacked(column: &ArrayRef, budget: &Budget) -> Result<ArrayRef, Problem> {
    let Some(dictionary) = column.as_any_dictionary_opt() else {
        return Ok(Arc::clone(column));
    };
    let values = dictionary.values();
    let (DataType::List(_) | DataType::LargeList(_) | DataType::FixedSizeList(..)) =
        values.data_type()
    else {
        return Ok(Arc::clone(column));
    };
    if values.is_empty() {
        // All keys are null, and their values are undefined.
        return Ok(new_null_array(values.data_type(), column.len()));
    }
    let lists = ListArray::new(values)?;
    let keys = dictionary.normalized_keys().into_iter().enumerate();
    let keys = keys.filter(|(row, _)| column.is_valid(*row));
    let count = keys.map(|(_, key)| lists.range(key).map_or(0, |range| range.len() as u64));
    charge_copies(count.sum(), lists.items(), budget)?;
    cast(column, values.data_type())
}

/// Charges copies of items for the part that exceeds the items themselves.
fn charge_copies(count: u64, items: &ArrayRef, budget: &Budget) -> Result<(), Problem> {
    let bytes = (items.get_buffer_memory_size() as u64).div_ceil(items.len().max(1) as u64);
    let copied = count.saturating_sub(items.len() as u64);
    budget.charge(copied.saturating_mul(bytes))
}
