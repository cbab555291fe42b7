//! [`Change`]: what happened to one element from one layout to another.

use super::difference::Difference;
use crate::ElementKind;

/// A change of one element.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementChange {
    /// Kind of the element: a node, a path or a station.
    pub element: ElementKind,
    /// Identifier, the old one if the element was renamed.
    pub id: String,
    /// Row in the old layout; `None` for a new element.
    pub old_row: Option<u32>,
    /// Row in the new layout; `None` for a removed element.
    pub new_row: Option<u32>,
    /// The change.
    pub change: Change,
}

/// A kind of change, with its values.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// Only the new layout has the element.
    Added,
    /// Only the old layout has the element.
    Removed,
    /// The element has another identifier at the same place.
    Renamed {
        /// New identifier.
        to: String,
    },
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
    /// A property, a reference or the direction has another value.
    Set {
        /// Name of the property, such as `maxSpeed` or `start node`.
        property: String,
        /// Vehicle type, if the value is that of one type.
        vehicle_type: Option<String>,
        /// Old value with its unit; `None` for a new value.
        before: Option<String>,
        /// New value with its unit; `None` for a value that was removed.
        after: Option<String>,
    },
}

/// All changes from one layout to another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Changes of nodes, paths and stations, in this order, each in the order of the old layout;
    /// new elements last.
    pub elements: Vec<ElementChange>,
    /// Differences of levels, vehicle types, blocks, zones and the layout as a whole.
    pub groups: Vec<Difference>,
}

impl Changes {
    /// Returns true if the layouts mean the same.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty() && self.groups.is_empty()
    }
}
