//! Vehicle types of paths and nodes: the column with a list of them per element.

use guideway_layout::{Code, Diagnostics, Place, TypeEntries};

use super::batch::Batch;
use super::column_names::VEHICLE_TYPES;
use super::list_array::ListArray;
use super::reading::Reading;
use super::schema::Role;
use super::text_array::TextArray;
use crate::Problem;

/// Entries per vehicle type under construction.
pub(super) struct TypeLists {
    index: usize,
    entries: TypeEntries,
    count: u64,
    unnamed: u64,
}

impl TypeLists {
    /// Makes the column, if the table has one.
    pub(super) fn new(reading: Reading<'_>) -> Option<Self> {
        Some(Self {
            index: reading.columns.get(Role::VehicleTypes)?,
            entries: TypeEntries::default(),
            count: 0,
            unnamed: 0,
        })
    }

    /// Appends the drawn rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        let lists = ListArray::new(&batch.columns[self.index])?;
        let names = TextArray::new(lists.items())?;
        let mut types = Vec::new();
        for row in batch.drawn.iter().cloned().flatten() {
            types.clear();
            let items = lists.range(row).unwrap_or_default();
            let length = items.len();
            types.extend(items.filter_map(|item| names.get(item)));
            self.unnamed += (length - types.len()) as u64;
            self.count += types.len() as u64;
            if self.count > u64::from(u32::MAX) {
                return Err(Problem::LimitReached {
                    what: "vehicle types of paths or nodes",
                    limit: u64::from(u32::MAX),
                    actual: self.count,
                });
            }
            self.entries.push(&types);
        }
        Ok(())
    }

    /// Returns the entries of all elements, without properties.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> TypeEntries {
        if self.unnamed > 0 {
            diagnostics.push(
                Code::UnknownValue,
                || Place::element(format!("column {VEHICLE_TYPES}")),
                || format!("{} vehicle types are null", self.unnamed),
                "They are left out; write the name of each vehicle type",
            );
        }
        self.entries
    }
}
