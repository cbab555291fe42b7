//! [`Change`]: a change of one element from one layout to another. It refers to the rows of both,
//! so that a million changes take few bytes: values become text as they are written.

use super::difference::Difference;
use crate::{ElementKind, Layout};

/// Row of a layout that lacks the element.
const NONE: u32 = u32::MAX;

/// A change of one element: 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementChange {
    /// Kind of the element: a node, a path or a station.
    pub element: ElementKind,
    /// The change.
    pub change: Change,
    /// Rows in the old and the new layout.
    rows: [u32; 2],
}

impl ElementChange {
    pub(super) fn new(element: ElementKind, rows: [Option<u32>; 2], change: Change) -> Self {
        Self {
            element,
            change,
            rows: rows.map(|row| row.unwrap_or(NONE)),
        }
    }

    /// Row in the old layout; `None` for a new element.
    pub fn old_row(&self) -> Option<u32> {
        Some(self.rows[0]).filter(|row| *row != NONE)
    }

    /// Row in the new layout; `None` for a removed element.
    pub fn new_row(&self) -> Option<u32> {
        Some(self.rows[1]).filter(|row| *row != NONE)
    }

    /// Returns `true` if another change is of the same element.
    pub fn is_same_element(&self, other: &Self) -> bool {
        (self.element, self.rows) == (other.element, other.rows)
    }
}

/// A kind of change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// Only the new layout has the element.
    Added,
    /// Only the old layout has the element.
    Removed,
    /// The element has another identifier.
    Renamed,
    /// The element is elsewhere; a path with the same shape.
    Moved {
        /// Distance, in meters.
        distance_m: f64,
    },
    /// The path has another shape.
    Reshaped {
        /// Greatest distance of the two curves, in meters.
        greatest_m: f64,
    },
    /// A property, a reference or the direction has another value: see [`Changes::values`].
    Set(ChangedValue),
}

/// A value of an element that has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChangedValue {
    /// The position of a station, which only one layout has.
    Position,
    /// The level.
    Level,
    /// The directions of a path.
    Direction,
    /// The node where a path begins.
    StartNode,
    /// The node where a path ends.
    EndNode,
    /// The nodes of a station.
    Nodes,
    /// The vehicle types.
    VehicleTypes,
    /// A property.
    Column {
        /// Row of its name in the columns of the comparison.
        name: u32,
        /// Entry of the old layout, if the value is that of one vehicle type.
        entry: Option<u32>,
    },
}

/// All changes from one layout to another.
#[derive(Clone, Debug)]
pub struct Changes<'a> {
    /// Changes of nodes, paths and stations, in this order, each in the order of the old layout;
    /// new elements last.
    pub elements: Vec<ElementChange>,
    /// Differences of levels, vehicle types, blocks, zones and the layout as a whole.
    pub groups: Vec<Difference>,
    /// The old and the new layout.
    pub(super) layouts: [&'a Layout; 2],
    /// Names of the columns that [`ChangedValue::Column`] refers to.
    pub(super) columns: Vec<&'a str>,
}

impl<'a> Changes<'a> {
    /// Returns true if the layouts mean the same.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty() && self.groups.is_empty()
    }

    /// The identifier of an element, the old one if it was renamed.
    pub fn id(&self, of: &ElementChange) -> &'a str {
        match (of.old_row(), of.new_row()) {
            (Some(row), _) => id(self.layouts[0], of.element, row),
            (None, Some(row)) => id(self.layouts[1], of.element, row),
            (None, None) => "",
        }
    }

    /// The identifier of an element in the new layout.
    pub fn new_id(&self, of: &ElementChange) -> Option<&'a str> {
        Some(id(self.layouts[1], of.element, of.new_row()?))
    }
}

fn id(layout: &Layout, kind: ElementKind, row: u32) -> &str {
    match kind {
        ElementKind::Path => layout.paths.id(row as usize),
        ElementKind::Station => layout.stations.id(row),
        _ => layout.nodes.id(row),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_takes_32_bytes() {
        assert_eq!(size_of::<ElementChange>(), 32);
    }
}
