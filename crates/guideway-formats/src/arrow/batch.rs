use std::ops::Range;

use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use arrow_schema::DataType;
use guideway_layout::Cells;

use super::guard::{damaged, guarded};
use super::polygons::Fault;
use crate::Problem;

/// The columns of a record batch, and what became of its rows.
pub(super) struct Batch {
    /// Which rows of the table these are.
    pub(super) rows: Range<usize>,
    pub(super) columns: Vec<ArrayRef>,
    /// Rows, counted from its first, that begin a path that is drawn. Ascending and apart.
    pub(super) kept: Vec<Range<usize>>,
    /// Rows, counted likewise, that begin a path that is refused.
    pub(super) refused: Vec<(usize, Fault)>,
}

impl Batch {
    /// Appends the values of the kept rows.
    pub(super) fn extend<T: ArrowPrimitiveType, V>(
        &self,
        out: &mut Vec<V>,
        column: &PrimitiveArray<T>,
        mut value: impl FnMut(Option<T::Native>) -> V,
    ) {
        for rows in self.kept.iter().cloned() {
            if column.null_count() == 0 {
                let values = &column.values()[rows];
                out.extend(values.iter().map(|&v| value(Some(v))));
            } else {
                out.extend(rows.map(|row| value(get(column, row))));
            }
        }
    }

    /// Appends the values of the kept rows that have one.
    pub(super) fn add_cells<T: ArrowPrimitiveType, V: Copy + Default>(
        &self,
        out: &mut Cells<V>,
        column: &PrimitiveArray<T>,
        value: impl Fn(T::Native) -> V,
    ) {
        for rows in self.kept.iter().cloned() {
            if column.null_count() == 0 {
                out.extend_present(column.values()[rows].iter().map(|&v| value(v)));
            } else {
                rows.for_each(|row| out.push(get(column, row).map(&value)));
            }
        }
    }
}

fn get<T: ArrowPrimitiveType>(column: &PrimitiveArray<T>, row: usize) -> Option<T::Native> {
    column.is_valid(row).then(|| column.value(row))
}

/// The column in another type; values that do not fit it become null.
pub(super) fn cast(column: &ArrayRef, target: &DataType) -> Result<ArrayRef, Problem> {
    guarded("column", || {
        arrow_cast::cast(column, target).map_err(|e| damaged("column", e.to_string()))
    })
}

/// Number of values that became null as a column was cast.
pub(super) fn count_lost(column: &ArrayRef, cast: &ArrayRef) -> usize {
    let nulls = cast.logical_null_count();
    nulls.saturating_sub(column.logical_null_count())
}
