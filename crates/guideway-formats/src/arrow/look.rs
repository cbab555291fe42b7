use std::collections::HashMap;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int32Type, UInt32Type};
use arrow_schema::DataType;
use guideway_layout::{Code, Diagnostics, Level, Paths, Place};

use super::batch::{Batch, cast, count_lost};
use super::budget::Budget;
use super::schema::Columns;
use super::text::Texts;
use crate::Problem;

/// The levels of paths and what they bring of their own look.
pub(super) struct Look<'a> {
    budget: &'a Budget,
    known: HashMap<String, u32>,
    named: Vec<Level>,
    levels: Option<Column<u32>>,
    widths: Option<Column<f32>>,
    colors: Option<Column<u32>>,
    ranks: Option<Column<i32>>,
}

struct Column<T> {
    index: usize,
    values: Vec<T>,
    /// Number of values that are taken as not given.
    unfit: usize,
}

impl<T> Column<T> {
    fn new(index: Option<usize>, rows: usize) -> Option<Self> {
        index.map(|index| Self {
            index,
            values: Vec::with_capacity(rows),
            unfit: 0,
        })
    }

    fn note_unfit(&self, name: &str, expected: &str, diagnostics: &mut Diagnostics) {
        if self.unfit == 0 {
            return;
        }
        diagnostics.push(
            Code::UnknownValue,
            || Place::element(format!("column {name}")),
            || format!("{} values are not {expected}", self.unfit),
            "Correct the values; they are taken as not given",
        );
    }
}

impl<'a> Look<'a> {
    /// With room for about so many rows.
    pub(super) fn new(columns: &Columns, rows: usize, budget: &'a Budget) -> Self {
        Self {
            budget,
            known: HashMap::new(),
            named: Vec::new(),
            levels: Column::new(columns.level, rows),
            widths: Column::new(columns.width, rows),
            colors: Column::new(columns.color, rows),
            ranks: Column::new(columns.rank, rows),
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.add_levels(batch)?;
        if let Some(widths) = &mut self.widths {
            let column = cast(&batch.columns[widths.index], &DataType::Float32)?;
            let fits = |width: &f32| width.is_finite() && *width >= 0.0;
            let unfit = &mut widths.unfit;
            let width = |width: Option<f32>| {
                *unfit += usize::from(width.is_some_and(|w| !fits(&w)));
                width.filter(fits).unwrap_or(f32::NAN)
            };
            let column = column.as_primitive::<Float32Type>();
            batch.extend(&mut widths.values, column, width);
        }
        if let Some(colors) = &mut self.colors {
            let column = &batch.columns[colors.index];
            let cast = cast(column, &DataType::UInt32)?;
            colors.unfit += count_lost(column, &cast);
            let cast = cast.as_primitive::<UInt32Type>();
            batch.extend(&mut colors.values, cast, Option::unwrap_or_default);
        }
        if let Some(ranks) = &mut self.ranks {
            let column = &batch.columns[ranks.index];
            let cast = cast(column, &DataType::Int32)?;
            ranks.unfit += count_lost(column, &cast);
            // As for paths that are pushed without a rank: file order.
            let mut path = ranks.values.len();
            let in_order = |rank: Option<i32>| {
                path += 1;
                rank.unwrap_or_else(|| i32::try_from(path - 1).unwrap_or(i32::MAX))
            };
            batch.extend(
                &mut ranks.values,
                cast.as_primitive::<Int32Type>(),
                in_order,
            );
        }
        Ok(())
    }

    fn add_levels(&mut self, batch: &Batch) -> Result<(), Problem> {
        let Some(levels) = &mut self.levels else {
            return Ok(());
        };
        let texts = Texts::of_text(&batch.columns[levels.index])?;
        for row in batch.kept.iter().cloned().flatten() {
            let Some(id) = texts.get(row) else {
                levels.values.push(u32::MAX);
                continue;
            };
            if let Some(&level) = self.known.get(id) {
                levels.values.push(level);
                continue;
            }
            self.budget.charge(2 * id.len() as u64)?;
            let level = self.named.len() as u32;
            self.known.insert(id.to_owned(), level);
            self.named.push(Level {
                id: id.to_owned(),
                ..Level::default()
            });
            levels.values.push(level);
        }
        Ok(())
    }

    /// Gives the columns to paths; the levels that there are.
    pub(super) fn finish(self, paths: &mut Paths, diagnostics: &mut Diagnostics) -> Vec<Level> {
        if let Some(levels) = self.levels {
            paths.set_levels(levels.values);
        }
        if let Some(widths) = self.widths {
            widths.note_unfit("width_m", "a number of meters from 0", diagnostics);
            paths.set_width_m(widths.values);
        }
        if let Some(colors) = self.colors {
            colors.note_unfit("color", "0xRRGGBBAA", diagnostics);
            paths.set_color_rgba(colors.values);
        }
        if let Some(ranks) = self.ranks {
            ranks.note_unfit("rank", "a whole number of 32 bits", diagnostics);
            paths.set_rank(ranks.values);
        }
        self.named
    }
}
