//! [`StepKind`]: a kind of step, and [`Touched`]: what a step has touched.

use std::collections::BTreeMap;

use guideway_document::{Document, Elements};
use guideway_scene::Table;

use super::error::StepError;
use super::members::Members;

/// Names per step that a report lists.
pub const SHOWN_NAMES: usize = 10;

/// A kind of step.
pub(super) struct StepKind {
    /// Value of `do`.
    pub(super) name: &'static str,
    pub(super) meaning: &'static str,
    pub(super) members: &'static [Member],
    /// A step for the example site.
    pub(super) example: &'static str,
    pub(super) perform: fn(&Members<'_>, &mut Document) -> Result<Touched, StepError>,
}

/// A member of a step.
pub(super) struct Member {
    pub(super) name: &'static str,
    /// Its form, such as `text` or `[x, y] in m`.
    pub(super) form: &'static str,
    pub(super) is_required: bool,
    pub(super) meaning: &'static str,
}

/// A member that a step needs.
pub(super) const fn required(
    name: &'static str,
    form: &'static str,
    meaning: &'static str,
) -> Member {
    Member {
        name,
        form,
        is_required: true,
        meaning,
    }
}

/// A member that a step may have.
pub(super) const fn optional(
    name: &'static str,
    form: &'static str,
    meaning: &'static str,
) -> Member {
    Member {
        is_required: false,
        ..required(name, form, meaning)
    }
}

/// The elements that a step touched, or made.
#[derive(Debug, Default)]
pub struct Touched {
    elements: Elements,
    /// Their names, those of the first ones only: at most one more than [`SHOWN_NAMES`].
    pub names: Vec<String>,
    /// Number of values per property that went with their elements.
    pub lost: BTreeMap<String, usize>,
}

impl Touched {
    /// Names that a step keeps: one more than a report lists.
    const MAX_NAMES: usize = SHOWN_NAMES + 1;

    pub(super) fn of(elements: Elements, document: &Document) -> Self {
        let layout = document.layout();
        let tables = [Table::Paths, Table::Nodes, Table::Stations];
        let names = tables.iter().flat_map(|&of| {
            let rows = elements.rows(of).iter();
            rows.map(move |row| of.id(layout, row).to_owned())
        });
        Self {
            names: names.take(Self::MAX_NAMES).collect(),
            lost: BTreeMap::new(),
            elements,
        }
    }

    /// A level or a vehicle type, and the elements that went with it.
    pub(super) fn group(name: &str, elements: Elements) -> Self {
        Self {
            names: vec![name.to_owned()],
            lost: BTreeMap::new(),
            elements,
        }
    }

    /// The same with values that went with their elements.
    pub(super) fn with_lost(self, lost: BTreeMap<String, usize>) -> Self {
        Self { lost, ..self }
    }

    /// One element.
    pub(super) fn one(of: Table, row: u32, document: &Document) -> Self {
        let rows = [row].into_iter().collect();
        let mut elements = Elements::default();
        match of {
            Table::Paths => elements.paths = rows,
            Table::Nodes => elements.nodes = rows,
            Table::Stations => elements.stations = rows,
        }
        Self::of(elements, document)
    }

    /// Number of elements of a table.
    pub fn count(&self, of: Table) -> u64 {
        self.elements.rows(of).len()
    }
}
