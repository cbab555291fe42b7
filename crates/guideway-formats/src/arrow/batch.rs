use std::ops::Range;

use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use arrow_schema::DataType;

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
                let get = |row| column.is_valid(row).then(|| column.value(row));
                out.extend(rows.map(|row| value(get(row))));
            }
        }
    }
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
