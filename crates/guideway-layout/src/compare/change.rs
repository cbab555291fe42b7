//! [`Change`]: a change of one element from one layout to another, and [`ElementChanges`], a list
//! of them. They refer to the rows of both layouts, so that ten million take few bytes: values
//! become text as they are written.

use super::difference::Difference;
use crate::{ElementKind, Layout};

/// Row of a layout that lacks the element.
const NONE: u32 = u32::MAX;

/// A change of one element.
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
    /// Row in the old layout; `None` for a new element.
    pub fn old_row(&self) -> Option<u32> {
        Some(self.rows[0]).filter(|row| *row != NONE)
    }

    /// Row in the new layout; `None` for a removed element.
    pub fn new_row(&self) -> Option<u32> {
        Some(self.rows[1]).filter(|row| *row != NONE)
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

impl Change {
    /// Name of the kind, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Added => "added",
            Self::Removed => "removed",
            Self::Renamed => "renamed",
            Self::Moved { .. } => "moved",
            Self::Reshaped { .. } => "reshaped",
            Self::Set(_) => "set",
        }
    }
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

/// Changes of elements, in 8 bytes each, and 12 per element.
#[derive(Clone, Debug, Default)]
pub struct ElementChanges {
    groups: Vec<ChangeGroup>,
}

impl ElementChanges {
    pub(super) fn extend(&mut self, groups: impl IntoIterator<Item = ChangeGroup>) {
        let groups = groups
            .into_iter()
            .filter(|group| !group.elements.is_empty());
        self.groups.extend(groups);
    }

    /// Number of changes.
    pub fn len(&self) -> usize {
        self.groups.iter().map(|group| group.changes.len()).sum()
    }

    /// Returns `true` if there are none.
    pub fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// Number of elements with a change.
    pub fn element_count(&self) -> usize {
        self.groups.iter().map(|group| group.elements.len()).sum()
    }

    /// The changes of each element.
    pub fn by_element(&self) -> impl Iterator<Item = Vec<ElementChange>> {
        let groups = self.groups.iter();
        groups.flat_map(|group| (0..group.elements.len()).map(move |i| group.of(i).collect()))
    }

    /// All changes.
    pub fn iter(&self) -> impl Iterator<Item = ElementChange> {
        let groups = self.groups.iter();
        groups.flat_map(|group| (0..group.elements.len()).flat_map(move |i| group.of(i)))
    }
}

/// Changes of some elements of a kind.
#[derive(Clone, Debug)]
pub(super) struct ChangeGroup {
    kind: ElementKind,
    /// Rows in both layouts, and the end of the changes of the element.
    elements: Vec<([u32; 2], u32)>,
    changes: Vec<PackedChange>,
    distances_m: Vec<f64>,
    /// Name and entry of changed values of one vehicle type.
    entries: Vec<(u32, u32)>,
}

/// A change in 8 bytes: what is longer is in a list of its group, at this index.
#[derive(Clone, Copy, Debug)]
enum PackedChange {
    Added,
    Removed,
    Renamed,
    Moved(u32),
    Reshaped(u32),
    Set(PlainValue),
    Column(u32),
    TypeColumn(u32),
}

/// A changed value that is no property.
#[derive(Clone, Copy, Debug)]
enum PlainValue {
    Position,
    Level,
    Direction,
    StartNode,
    EndNode,
    Nodes,
    VehicleTypes,
}

impl ChangeGroup {
    pub(super) fn new(kind: ElementKind) -> Self {
        Self {
            kind,
            elements: Vec::new(),
            changes: Vec::new(),
            distances_m: Vec::new(),
            entries: Vec::new(),
        }
    }

    /// Appends a change, which is of the last element if its rows are the same.
    pub(super) fn push(&mut self, rows: [Option<u32>; 2], change: Change) {
        let packed = match change {
            Change::Added => PackedChange::Added,
            Change::Removed => PackedChange::Removed,
            Change::Renamed => PackedChange::Renamed,
            Change::Moved { distance_m } => PackedChange::Moved(self.keep_distance(distance_m)),
            Change::Reshaped { greatest_m } => {
                PackedChange::Reshaped(self.keep_distance(greatest_m))
            }
            Change::Set(value) => match value {
                ChangedValue::Position => PackedChange::Set(PlainValue::Position),
                ChangedValue::Level => PackedChange::Set(PlainValue::Level),
                ChangedValue::Direction => PackedChange::Set(PlainValue::Direction),
                ChangedValue::StartNode => PackedChange::Set(PlainValue::StartNode),
                ChangedValue::EndNode => PackedChange::Set(PlainValue::EndNode),
                ChangedValue::Nodes => PackedChange::Set(PlainValue::Nodes),
                ChangedValue::VehicleTypes => PackedChange::Set(PlainValue::VehicleTypes),
                ChangedValue::Column { name, entry: None } => PackedChange::Column(name),
                ChangedValue::Column {
                    name,
                    entry: Some(entry),
                } => {
                    self.entries.push((name, entry));
                    PackedChange::TypeColumn(self.entries.len() as u32 - 1)
                }
            },
        };
        self.changes.push(packed);
        let (rows, end) = (
            rows.map(|row| row.unwrap_or(NONE)),
            self.changes.len() as u32,
        );
        match self.elements.last_mut() {
            Some((last, of_last)) if *last == rows => *of_last = end,
            _ => self.elements.push((rows, end)),
        }
    }

    fn keep_distance(&mut self, meters: f64) -> u32 {
        self.distances_m.push(meters);
        self.distances_m.len() as u32 - 1
    }

    /// Gives back memory that no change needs.
    pub(super) fn shrunk(mut self) -> Self {
        self.elements.shrink_to_fit();
        self.changes.shrink_to_fit();
        self.distances_m.shrink_to_fit();
        self.entries.shrink_to_fit();
        self
    }

    /// The changes of an element.
    fn of(&self, i: usize) -> impl Iterator<Item = ElementChange> {
        let (rows, end) = self.elements[i];
        let start = i.checked_sub(1).map_or(0, |before| self.elements[before].1);
        let changes = self.changes[start as usize..end as usize].iter();
        changes.map(move |&change| ElementChange {
            element: self.kind,
            change: self.unpacked(change),
            rows,
        })
    }

    fn unpacked(&self, change: PackedChange) -> Change {
        let distance_m = |at: u32| self.distances_m[at as usize];
        Change::Set(match change {
            PackedChange::Added => return Change::Added,
            PackedChange::Removed => return Change::Removed,
            PackedChange::Renamed => return Change::Renamed,
            PackedChange::Moved(at) => {
                let distance_m = distance_m(at);
                return Change::Moved { distance_m };
            }
            PackedChange::Reshaped(at) => {
                let greatest_m = distance_m(at);
                return Change::Reshaped { greatest_m };
            }
            PackedChange::Set(value) => match value {
                PlainValue::Position => ChangedValue::Position,
                PlainValue::Level => ChangedValue::Level,
                PlainValue::Direction => ChangedValue::Direction,
                PlainValue::StartNode => ChangedValue::StartNode,
                PlainValue::EndNode => ChangedValue::EndNode,
                PlainValue::Nodes => ChangedValue::Nodes,
                PlainValue::VehicleTypes => ChangedValue::VehicleTypes,
            },
            PackedChange::Column(name) => ChangedValue::Column { name, entry: None },
            PackedChange::TypeColumn(at) => {
                let (name, entry) = self.entries[at as usize];
                let entry = Some(entry);
                ChangedValue::Column { name, entry }
            }
        })
    }
}

/// All changes from one layout to another.
#[derive(Clone, Debug)]
pub struct Changes<'a> {
    /// Changes of nodes, paths and stations, in this order, each in the order of the old layout;
    /// new elements last.
    pub elements: ElementChanges,
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
    fn a_change_takes_8_bytes() {
        assert_eq!(size_of::<PackedChange>(), 8);
        assert_eq!(size_of::<([u32; 2], u32)>(), 12);
    }

    #[test]
    fn packed_changes_are_those_that_were_added() {
        let column = |name, entry| Change::Set(ChangedValue::Column { name, entry });
        let changes = [
            ([Some(3), Some(4)], Change::Renamed),
            ([Some(3), Some(4)], Change::Moved { distance_m: 2.5 }),
            ([Some(3), Some(4)], column(70_000, None)),
            ([Some(3), Some(4)], column(7, Some(9))),
            ([Some(5), Some(5)], Change::Reshaped { greatest_m: 0.5 }),
            ([Some(5), Some(5)], column(8, Some(u32::MAX))),
            ([Some(5), Some(5)], Change::Set(ChangedValue::Nodes)),
            ([Some(6), None], Change::Removed),
            ([None, Some(6)], Change::Added),
        ];
        let mut group = ChangeGroup::new(ElementKind::Path);
        for (rows, change) in changes {
            group.push(rows, change);
        }
        let mut all = ElementChanges::default();
        all.extend([ChangeGroup::new(ElementKind::Node), group.shrunk()]);
        let found = all
            .iter()
            .map(|of| ([of.old_row(), of.new_row()], of.change));
        assert!(found.eq(changes));
        assert!(all.iter().all(|of| of.element == ElementKind::Path));
        let counts: Vec<usize> = all.by_element().map(|changes| changes.len()).collect();
        assert_eq!(counts, [4, 3, 1, 1]);
        assert_eq!((all.len(), all.element_count()), (9, 4));
    }
}
