//! Casts of columns, with a count of the values that do not fit.

use arrow_array::{Array, ArrayRef};
use arrow_schema::DataType;

use super::catch_decode_panic::catch_decode_panic;
use super::problems::damaged;
use crate::Problem;

/// Casts a column to another type; values that do not fit it are set to null.
pub(super) fn cast(column: &ArrayRef, target: &DataType) -> Result<ArrayRef, Problem> {
    catch_decode_panic("column", || {
        arrow_cast::cast(column, target).map_err(|e| damaged("column", e.to_string()))
    })
}

/// Returns the number of values that a cast set to null.
pub(super) fn count_lost(column: &ArrayRef, cast: &ArrayRef) -> usize {
    let nulls = cast.logical_null_count();
    nulls.saturating_sub(column.logical_null_count())
}
