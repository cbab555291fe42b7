//! List arrays: uniform access to the lists of a column.

use std::ops::Range;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, Float64Array, LargeListArray, UInt32Array, make_array};
use arrow_buffer::{NullBuffer, OffsetBuffer};
use arrow_data::transform::MutableArrayData;
use arrow_schema::{ArrowError, DataType, FieldRef};

use super::budget::Budget;
use super::cast;
use super::catch_decode_panic::catch_decode_panic;
use super::problems::damaged;
use crate::Problem;

/// A column of lists, whose items lie in sequence in one array.
pub(super) struct ListArray(LargeListArray);

impl ListArray {
    /// Interprets a column of lists: `list`, `large_list` or `fixed_size_list`.
    pub(super) fn new(column: &ArrayRef) -> Result<Self, Problem> {
        let (item, ends, items) = match column.data_type() {
            DataType::List(item) => {
                let lists = column.as_list::<i32>();
                let ends = lists.offsets().iter().map(|&end| i64::from(end));
                (item, ends.collect(), lists.values())
            }
            DataType::FixedSizeList(item, count) => {
                let lists = column.as_fixed_size_list();
                let ends = (0..=lists.len() as i64).map(|row| row * i64::from(*count));
                (item, ends.collect(), lists.values())
            }
            _ => return Ok(Self(column.as_list::<i64>().clone())),
        };
        let nulls = column.nulls().cloned();
        catch_decode_panic("column", || {
            let ends = OffsetBuffer::new(ends);
            let large = LargeListArray::try_new(Arc::clone(item), ends, Arc::clone(items), nulls);
            Ok(Self(large.map_err(not_listed)?))
        })
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
    cast::numbers(column)
}

pub(super) fn numbers(column: &ArrayRef) -> Result<Float64Array, Problem> {
    cast::numbers(column)
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
    let rows = 0..column.len();
    let view = |start: usize, count: usize| start..start.saturating_add(count);
    match column.data_type() {
        DataType::ListView(item) => {
            let views = column.as_list_view::<i32>();
            let range = |row| {
                view(
                    views.value_offset(row) as usize,
                    views.value_size(row) as usize,
                )
            };
            let ranges = rows.map(|row| views.is_valid(row).then(|| range(row)));
            in_sequence(item, views.values(), ranges.collect(), budget)
        }
        DataType::LargeListView(item) => {
            let views = column.as_list_view::<i64>();
            let range = |row| {
                view(
                    views.value_offset(row) as usize,
                    views.value_size(row) as usize,
                )
            };
            let ranges = rows.map(|row| views.is_valid(row).then(|| range(row)));
            in_sequence(item, views.values(), ranges.collect(), budget)
        }
        _ => Ok(Arc::clone(column)),
    }
}

/// Converts a dictionary of lists to the lists that its keys name, which are charged to the budget.
pub(super) fn unpacked(column: &ArrayRef, budget: &Budget) -> Result<ArrayRef, Problem> {
    let Some(dictionary) = column.as_any_dictionary_opt() else {
        return Ok(Arc::clone(column));
    };
    let values = dictionary.values();
    let (DataType::List(item) | DataType::LargeList(item) | DataType::FixedSizeList(item, _)) =
        values.data_type()
    else {
        return Ok(Arc::clone(column));
    };
    let lists = ListArray::new(values)?;
    let rows = cast::value_rows(dictionary).into_iter();
    let ranges = rows.map(|row| row.and_then(|row| lists.range(row)));
    in_sequence(item, lists.items(), ranges.collect(), budget)
}

/// Copies the items of each row in sequence, and charges the part of the copies that exceeds the
/// items themselves.
fn in_sequence(
    item: &FieldRef,
    items: &ArrayRef,
    ranges: Vec<Option<Range<usize>>>,
    budget: &Budget,
) -> Result<ArrayRef, Problem> {
    let counts = || ranges.iter().map(|r| r.as_ref().map_or(0, Range::len));
    let count = counts().fold(0, |sum: u64, count| sum.saturating_add(count as u64));
    let bytes = (items.get_buffer_memory_size() as u64).div_ceil(items.len().max(1) as u64);
    let copied = count.saturating_sub(items.len() as u64);
    budget.charge(copied.saturating_mul(bytes))?;
    catch_decode_panic("column", || {
        let data = items.to_data();
        let mut copies = MutableArrayData::new(vec![&data], false, count as usize);
        for range in ranges.iter().flatten() {
            let copied = copies.try_extend(0, range.start, range.end);
            copied.map_err(not_listed)?;
        }
        let nulls: NullBuffer = ranges.iter().map(Option::is_some).collect();
        let lists = LargeListArray::try_new(
            Arc::clone(item),
            OffsetBuffer::from_lengths(counts()),
            make_array(copies.freeze()),
            Some(nulls),
        );
        Ok(Arc::new(lists.map_err(not_listed)?) as ArrayRef)
    })
}

fn not_listed(error: ArrowError) -> Problem {
    damaged("column", error.to_string())
}
