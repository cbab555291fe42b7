//! Levels: those of the layout, and the column with the level of each element of a table.

use std::collections::HashMap;

use arrow_array::Array;
use guideway_layout::{Code, Diagnostics, Level, Place};

use super::batch::Batch;
use super::budget::Budget;
use super::column_names::LEVEL;
use super::column_types::is_text;
use super::list_array::indices;
use super::reading::Reading;
use super::schema::Role;
use super::text_array::TextArray;
use crate::Problem;

/// Number that means "no level".
const NONE: u32 = u32::MAX;

/// The levels of the layout. An identifier without a level adds one.
#[derive(Default)]
pub(super) struct Levels {
    levels: Vec<Level>,
    /// First level of each identifier.
    rows: HashMap<String, u32>,
}

impl Levels {
    pub(super) fn new(levels: Vec<Level>) -> Self {
        let mut rows = HashMap::new();
        for (row, level) in levels.iter().enumerate() {
            rows.entry(level.id.clone()).or_insert(row as u32);
        }
        Self { levels, rows }
    }

    fn named(&mut self, id: String) -> u32 {
        let row = self.levels.len() as u32;
        *self.rows.entry(id).or_insert_with_key(|id| {
            self.levels.push(Level {
                id: id.clone(),
                ..Level::default()
            });
            row
        })
    }

    pub(super) fn into_vec(self) -> Vec<Level> {
        self.levels
    }
}

/// Levels of the elements of a table under construction, by their identifiers or numbers.
pub(super) struct LevelColumn<'a> {
    index: usize,
    budget: &'a Budget,
    /// Per element a number of [`Self::ids`], or that of the level.
    values: Vec<u32>,
    ids: Option<Interned>,
    /// Number of values that are no row number.
    invalid: usize,
}

/// Identifiers in the order of their first use.
#[derive(Default)]
struct Interned {
    rows: HashMap<String, u32>,
    ids: Vec<String>,
}

impl<'a> LevelColumn<'a> {
    /// Makes the column, if the table has one, with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Option<Self> {
        let index = reading.columns.get(Role::Level)?;
        Some(Self {
            index,
            budget: reading.budget,
            values: Vec::with_capacity(rows),
            ids: is_text(reading.schema.field(index).data_type()).then(Interned::default),
            invalid: 0,
        })
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let column = &batch.columns[self.index];
        let Some(interned) = &mut self.ids else {
            let numbers = indices(column)?;
            for row in batch.drawn.iter().cloned().flatten() {
                let number = numbers.is_valid(row).then(|| numbers.value(row));
                let number = number.unwrap_or(NONE);
                self.invalid += usize::from(number == NONE && column.is_valid(row));
                self.values.push(number);
            }
            return Ok(());
        };
        let texts = TextArray::new(column)?;
        for row in batch.drawn.iter().cloned().flatten() {
            let Some(id) = texts.get(row) else {
                self.values.push(NONE);
                continue;
            };
            if let Some(&level) = interned.rows.get(id) {
                self.values.push(level);
                continue;
            }
            self.budget.charge(2 * id.len() as u64)?;
            let level = interned.ids.len() as u32;
            interned.rows.insert(id.to_owned(), level);
            interned.ids.push(id.to_owned());
            self.values.push(level);
        }
        Ok(())
    }

    /// Returns the level of each element, `u32::MAX` for none. `elements` names them in a message.
    pub(super) fn finish(
        mut self,
        levels: &mut Levels,
        elements: &str,
        diagnostics: &mut Diagnostics,
    ) -> Vec<u32> {
        let count = levels.levels.len() as u32;
        let rows = self.ids.map(|interned| -> Vec<u32> {
            let ids = interned.ids.into_iter();
            ids.map(|id| levels.named(id)).collect()
        });
        for value in self.values.iter_mut().filter(|value| **value != NONE) {
            *value = match &rows {
                Some(rows) => rows[*value as usize],
                None if *value < count => *value,
                None => {
                    self.invalid += 1;
                    NONE
                }
            };
        }
        if self.invalid > 0 {
            diagnostics.push(
                Code::UnknownValue,
                || Place::element(format!("column {LEVEL}")),
                || {
                    let invalid = self.invalid;
                    format!("{invalid} {elements} are on a level that the table does not have")
                },
                "They are read without a level; write the identifier of a level, or its number",
            );
        }
        self.values
    }
}

/// Returns the level in a finished column, if the table has one.
pub(super) fn level_at(column: Option<&Vec<u32>>, row: usize) -> Option<u32> {
    column
        .map(|column| column[row])
        .filter(|&level| level != NONE)
}
