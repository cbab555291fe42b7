//! Layout rows: the rows that a layout has in a table, kind by kind.

use guideway_layout::{Layout, TypeEntries};

use super::element::Element;

/// One row to write.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// Row of the element in its table; for a row per vehicle type, the entry.
    pub(super) index: usize,
    /// Run of a path; 0 for other elements.
    pub(super) part: usize,
    /// Element that an entry belongs to; 0 for other rows.
    pub(super) of: usize,
}

impl Row {
    fn element(index: usize) -> Self {
        Self {
            index,
            part: 0,
            of: 0,
        }
    }
}

/// Returns the rows of a kind.
pub(super) fn rows(layout: &Layout, kind: Element) -> Box<dyn Iterator<Item = Row> + '_> {
    let count = match kind {
        Element::Path => return Box::new(path_rows(layout)),
        Element::PathType => return Box::new(entry_rows(layout.paths.vehicle_types())),
        Element::NodeType => return Box::new(entry_rows(layout.nodes.vehicle_types())),
        Element::Node => layout.nodes.len(),
        Element::Station => layout.stations.len(),
        Element::Level => layout.levels.len(),
        Element::VehicleType => layout.vehicle_types.len(),
        Element::Block => layout.blocks.len(),
        Element::Zone => layout.zones.len(),
        Element::Layout => {
            let mut columns = layout.attributes.iter();
            usize::from(columns.any(|column| column.values.get(0).is_some()))
        }
        Element::RefusedPath => layout.refused.len(),
    };
    Box::new((0..count).map(Row::element))
}

/// Returns a row per run, and one for a path without a curve.
fn path_rows(layout: &Layout) -> impl Iterator<Item = Row> + '_ {
    layout.paths.iter().flat_map(|path| {
        let parts = 0..path.runs().len().max(1);
        parts.map(move |part| Row {
            part,
            ..Row::element(path.row())
        })
    })
}

/// Returns a row per entry of the elements that have properties per vehicle type.
fn entry_rows(entries: &TypeEntries) -> impl Iterator<Item = Row> + '_ {
    let has_value = |entry: usize| {
        let mut columns = entries.attributes.iter();
        columns.any(|column| column.values.get(entry).is_some())
    };
    let elements = match entries.attributes.is_empty() {
        true => 0,
        false => entries.len(),
    };
    let of_element = move |of: usize| {
        let needed = entries.entries(of).any(has_value);
        let rows = if needed { entries.entries(of) } else { 0..0 };
        rows.map(move |entry| Row {
            of,
            ..Row::element(entry)
        })
    };
    (0..elements).flat_map(of_element)
}
