//! Rows per vehicle type: properties of a path or node that differ between its vehicle types.

use std::collections::HashSet;

use guideway_layout::{Code, TypeEntries};

use super::element_rows::ElementRows;
use super::faults::Faults;
use crate::Problem;
use crate::arrow::batch::Batch;
use crate::arrow::element::Element;
use crate::arrow::numbering::Numbering;
use crate::arrow::reading::Reading;
use crate::arrow::schema::Role;

/// Row of an entry without properties: past the end of every column.
const NONE: usize = usize::MAX;

/// Properties per vehicle type under construction.
pub(super) struct TypeRows<'a> {
    kind: Element,
    rows: ElementRows<'a>,
}

impl<'a> TypeRows<'a> {
    /// Makes the rows of a kind: paths or nodes for a vehicle type.
    pub(super) fn new(kind: Element, reading: Reading<'a>) -> Self {
        Self {
            kind,
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
        let mut set: HashSet<usize> = HashSet::new();
        for row in 0..rows.len() {
            let vehicle_type = rows.ids.get(row);
            let element = rows.index(Role::Of, row).and_then(|of| elements.row(of));
            let mut of_element = element.map_or(0..0, |e| entries.entries(e as usize));
            let entry = of_element
                .find(|&entry| entries.type_of(entry) == vehicle_type && !set.contains(&entry));
            match entry {
                Some(entry) => {
                    set.insert(entry);
                    row_of[entry] = row;
                }
                None => faults.report(
                    (Code::UnknownValue, self.kind),
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
