//! Style columns: stroke width, color and draw rank of the paths.

use arrow_array::{Float32Array, Int32Array, UInt32Array};
use guideway_layout::{Code, Diagnostics, Paths, Place};

use super::batch::Batch;
use super::cast::{count_lost, numbers};
use super::schema::{ColumnRoles, Role};
use crate::Problem;

/// Style of the paths under construction.
pub(super) struct StyleColumns {
    widths: Option<Column<f32>>,
    colors: Option<Column<u32>>,
    ranks: Option<Column<i32>>,
}

struct Column<T> {
    index: usize,
    values: Vec<T>,
    /// Number of invalid values, which are read as missing.
    invalid: usize,
}

impl<T> Column<T> {
    fn new(index: Option<usize>, rows: usize) -> Option<Self> {
        index.map(|index| Self {
            index,
            values: Vec::with_capacity(rows),
            invalid: 0,
        })
    }

    fn report_invalid(&self, name: &str, expected: &str, diagnostics: &mut Diagnostics) {
        if self.invalid == 0 {
            return;
        }
        diagnostics.push(
            Code::UnknownValue,
            || Place::element(format!("column {name}")),
            || format!("{} values are not {expected}", self.invalid),
            "They are read as missing; correct the values",
        );
    }
}

impl StyleColumns {
    /// Makes the columns with capacity for an estimated number of rows.
    pub(super) fn new(columns: &ColumnRoles, rows: usize) -> Self {
        Self {
            widths: Column::new(columns.get(Role::Width), rows),
            colors: Column::new(columns.get(Role::Color), rows),
            ranks: Column::new(columns.get(Role::Rank), rows),
        }
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        if let Some(widths) = &mut self.widths {
            let column: Float32Array = numbers(&batch.columns[widths.index])?;
            let is_valid = |width: &f32| width.is_finite() && *width >= 0.0;
            let invalid = &mut widths.invalid;
            let width = |width: Option<f32>| {
                *invalid += usize::from(width.is_some_and(|w| !is_valid(&w)));
                width.filter(is_valid).unwrap_or(f32::NAN)
            };
            batch.extend(&mut widths.values, &column, width);
        }
        if let Some(colors) = &mut self.colors {
            let column = &batch.columns[colors.index];
            let cast: UInt32Array = numbers(column)?;
            colors.invalid += count_lost(column, &cast);
            batch.extend(&mut colors.values, &cast, Option::unwrap_or_default);
        }
        if let Some(ranks) = &mut self.ranks {
            let column = &batch.columns[ranks.index];
            let cast: Int32Array = numbers(column)?;
            ranks.invalid += count_lost(column, &cast);
            // A missing rank is the row, as for paths without a rank column.
            let mut path = ranks.values.len();
            let in_order = |rank: Option<i32>| {
                path += 1;
                rank.unwrap_or_else(|| i32::try_from(path - 1).unwrap_or(i32::MAX))
            };
            batch.extend(&mut ranks.values, &cast, in_order);
        }
        Ok(())
    }

    /// Sets the columns of the paths.
    pub(super) fn finish(self, paths: &mut Paths, diagnostics: &mut Diagnostics) {
        if let Some(widths) = self.widths {
            widths.report_invalid("width_m", "a number of meters from 0", diagnostics);
            paths.set_width_m(widths.values);
        }
        if let Some(colors) = self.colors {
            colors.report_invalid("color", "0xRRGGBBAA", diagnostics);
            paths.set_color_rgba(colors.values);
        }
        if let Some(ranks) = self.ranks {
            ranks.report_invalid("rank", "a 32-bit integer", diagnostics);
            paths.set_rank(ranks.values);
        }
    }
}
