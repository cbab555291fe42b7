//! Path identifiers: those of drawn paths, and the refused paths with their reasons.

use guideway_layout::{Diagnostics, Place, Refused, TextColumn, element_name};

use super::batch::Batch;
use super::id_column::{IdColumn, id_texts};
use super::reading::Reading;
use super::schema::Role;
use crate::Problem;

/// Identifiers under construction.
pub(super) struct PathIds<'a> {
    reading: Reading<'a>,
    drawn: IdColumn<'a>,
    refused: Refused,
}

impl<'a> PathIds<'a> {
    /// Makes the identifiers with capacity for an estimated number of rows.
    pub(super) fn new(reading: Reading<'a>, rows: usize) -> Self {
        Self {
            reading,
            drawn: IdColumn::new(reading, rows),
            refused: Refused::default(),
        }
    }

    /// Appends the drawn and refused rows of a batch.
    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.drawn.add(batch)?;
        let Reading {
            columns,
            limits,
            budget,
            ..
        } = self.reading;
        let texts = id_texts(columns.get(Role::Id), &batch.columns);
        for &(row, fault) in &batch.refused {
            let number = batch.number(row);
            let id = texts.as_ref().and_then(|t| t.get(row)).unwrap_or(&number);
            budget.charge(id.len() as u64)?;
            self.refused.push(id, fault.code(), &fault.detail(limits));
        }
        Ok(())
    }

    /// Returns the identifiers of drawn paths, and the refused paths.
    pub(super) fn finish(self, diagnostics: &mut Diagnostics) -> (TextColumn, Refused) {
        for path in self.refused.iter() {
            let place = || Place::element(element_name("path", 0, path.id));
            let remedy = "It is left out; correct its control points";
            diagnostics.push_refused(path, place, remedy);
        }
        (self.drawn.finish("paths", diagnostics), self.refused)
    }
}
