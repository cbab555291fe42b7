//! Rows per vehicle type: properties of a path or node that differ between its vehicle types.

use guideway_layout::{Code, TypeEntries};

use super::element_rows::ElementRows;
use super::faults::Faults;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::budget::Budget;
use crate::arrow::element::Element;
use crate::arrow::numbering::Numbering;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;

/// Row of an entry without properties: past the end of every column.
const NONE: usize = usize::MAX;

/// Properties per vehicle type under construction.
pub(super) struct TypeRows<'a> {
    kind: Element,
    budget: &'a Budget,
    rows: ElementRows<'a>,
}

impl<'a> TypeRows<'a> {
    /// Makes the rows of a kind: paths or nodes for a vehicle type.
    pub(super) fn new(kind: Element, reading: Reading<'a>) -> Self {
        Self {
            kind,
            budget: reading.budget,
            rows: ElementRows::new(kind, reading, &[Role::Of]),
        }
    }

    pub(super) fn add(&mut self, batch: &Batch) -> Result<(), Problem> {
        self.rows.add(batch)
    }

    /// Sets the properties of the entries. `elements` has the rows of the elements by their
    /// numbers. Of several rows for one type of an element, each is for one of its entries.
    pub(super) fn finish(
        self,
        entries: &mut TypeEntries,
        elements: &Numbering,
        faults: &mut Faults<'_>,
    ) -> Result<(), Problem> {
        let rows = self.rows.finish(faults.diagnostics)?;
        if rows.len() == 0 {
            return Ok(());
        }
        let count = match entries.len() {
            0 => 0,
            elements => entries.entries(elements - 1).end,
        };
        let mut row_of = vec![NONE; count];
        // Rows are mostly in the order of the entries.
        let mut next = 0;
        for row in 0..rows.len() {
            let vehicle_type = rows.ids.get(row);
            let of = rows.index(Role::Of, row);
            if of.is_some_and(|of| elements.is_skipped(of)) {
                continue;
            }
            let element = of.and_then(|of| elements.row(of));
            let of_element = element.map_or(0..0, |e| entries.entries(e as usize));
            let is_free =
                |&entry: &usize| row_of[entry] == NONE && entries.type_of(entry) == vehicle_type;
            let expected = Some(next.max(of_element.start));
            let expected = expected.filter(|entry| of_element.contains(entry) && is_free(entry));
            let entry = match expected {
                Some(entry) => Some(entry),
                None => {
                    // Many rows of one element with many types would else take time without end.
                    self.budget.charge(of_element.len() as u64)?;
                    of_element.into_iter().find(is_free)
                }
            };
            match entry {
                Some(entry) => {
                    row_of[entry] = row;
                    next = entry + 1;
                }
                None => faults.report(
                    Code::UnknownValue,
                    self.kind,
                    vehicle_type,
                    || "column of names no element that has this vehicle type".into(),
                    "The row is not read; list the vehicle type in vehicle_types of its element",
                ),
            }
        }
        entries.attributes = rows.into_attributes(faults.diagnostics).select(&row_of);
        Ok(())
    }
}
