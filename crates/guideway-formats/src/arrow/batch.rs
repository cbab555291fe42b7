//! Record batch during assembly: its columns, and its rows that begin drawn and refused paths, or
//! hold other elements.

use std::ops::Range;

use arrow_array::{Array, ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use guideway_layout::Cells;

use super::fault::Fault;

/// Columns of a record batch, and the fate of its rows.
pub(super) struct Batch {
    /// Rows of the table.
    pub(super) rows: Range<usize>,
    pub(super) columns: Vec<ArrayRef>,
    /// Rows of the batch that begin a drawn path, or hold an element of another kind: ascending,
    /// disjoint ranges.
    pub(super) drawn: Vec<Range<usize>>,
    /// Rows of the batch that begin a refused path, with the reason.
    pub(super) refused: Vec<(usize, Fault)>,
}

impl Batch {
    /// Returns the number of drawn rows.
    pub(super) fn drawn_rows(&self) -> usize {
        self.drawn.iter().map(Range::len).sum()
    }

    /// Returns the number in the table of a row of the batch, as text.
    pub(super) fn number(&self, row: usize) -> String {
        (self.rows.start + row).to_string()
    }

    /// Appends the values of the drawn rows.
    pub(super) fn extend<T: ArrowPrimitiveType, V>(
        &self,
        out: &mut Vec<V>,
        column: &PrimitiveArray<T>,
        mut value: impl FnMut(Option<T::Native>) -> V,
    ) {
        for rows in self.drawn.iter().cloned() {
            if column.null_count() == 0 {
                let values = &column.values()[rows];
                out.extend(values.iter().map(|&v| value(Some(v))));
            } else {
                out.extend(rows.map(|row| value(get(column, row))));
            }
        }
    }

    /// Appends the values of the drawn rows, some of which may be null.
    pub(super) fn add_cells<T: ArrowPrimitiveType, V: Copy + Default>(
        &self,
        out: &mut Cells<V>,
        column: &PrimitiveArray<T>,
        value: impl Fn(T::Native) -> V,
    ) {
        for rows in self.drawn.iter().cloned() {
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
