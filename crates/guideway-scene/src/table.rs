//! [`Table`]: the tables of a layout that have rows of elements, and what they have in common.

use guideway_layout::{Attributes, Layout, TypeEntries};

/// A table of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Table {
    /// The paths.
    Paths,
    /// The nodes.
    Nodes,
    /// The stations.
    Stations,
}

impl Table {
    /// All tables.
    pub const ALL: [Self; 3] = [Self::Paths, Self::Nodes, Self::Stations];

    /// Name of one element: `path`, `node` or `station`.
    pub fn element(self) -> &'static str {
        match self {
            Self::Paths => "path",
            Self::Nodes => "node",
            Self::Stations => "station",
        }
    }

    /// Number of rows, including removed ones.
    pub fn row_count(self, layout: &Layout) -> usize {
        match self {
            Self::Paths => layout.paths.len(),
            Self::Nodes => layout.nodes.len(),
            Self::Stations => layout.stations.len(),
        }
    }

    /// Identifier of an element.
    ///
    /// # Panics
    /// When the row does not exist.
    pub fn id(self, layout: &Layout, row: u32) -> &str {
        match self {
            Self::Paths => layout.paths.id(row as usize),
            Self::Nodes => layout.nodes.id(row),
            Self::Stations => layout.stations.id(row),
        }
    }

    /// Index of the level of an element.
    ///
    /// # Panics
    /// When the row does not exist.
    pub fn level(self, layout: &Layout, row: u32) -> Option<u32> {
        match self {
            Self::Paths => layout.paths.get(row as usize).level(),
            Self::Nodes => layout.nodes.level(row),
            Self::Stations => layout.stations.level(row),
        }
    }

    /// Sets the level of an element.
    pub(crate) fn set_level(self, layout: &mut Layout, row: u32, level: Option<u32>) {
        match self {
            Self::Paths => layout.paths.set_level(row as usize, level),
            Self::Nodes => layout.nodes.set_level(row, level),
            Self::Stations => layout.stations.set_level(row, level),
        }
    }

    /// Rows of the elements on a level, of removed ones too.
    pub(crate) fn on_level(self, layout: &Layout, level: u32) -> impl Iterator<Item = u32> {
        let rows = 0..self.row_count(layout) as u32;
        rows.filter(move |&row| self.level(layout, row) == Some(level))
    }

    /// The columns that hold for all vehicle types.
    pub fn attributes(self, layout: &Layout) -> &Attributes {
        match self {
            Self::Paths => &layout.paths.attributes,
            Self::Nodes => &layout.nodes.attributes,
            Self::Stations => &layout.stations.attributes,
        }
    }

    /// The entries per vehicle type; stations have none.
    pub fn entries(self, layout: &Layout) -> Option<&TypeEntries> {
        match self {
            Self::Paths => Some(layout.paths.vehicle_types()),
            Self::Nodes => Some(layout.nodes.vehicle_types()),
            Self::Stations => None,
        }
    }

    /// The columns of the elements, or those of their entries per vehicle type.
    pub(crate) fn columns(self, layout: &Layout, per_type: bool) -> Option<&Attributes> {
        match per_type {
            true => Some(&self.entries(layout)?.attributes),
            false => Some(self.attributes(layout)),
        }
    }

    /// As [`Self::columns`], to edit.
    pub(crate) fn columns_mut(
        self,
        layout: &mut Layout,
        per_type: bool,
    ) -> Option<&mut Attributes> {
        match (self, per_type) {
            (Self::Paths, false) => Some(&mut layout.paths.attributes),
            (Self::Nodes, false) => Some(&mut layout.nodes.attributes),
            (Self::Stations, false) => Some(&mut layout.stations.attributes),
            (_, true) => Some(&mut self.entries_mut(layout)?.attributes),
        }
    }

    /// The entries per vehicle type, to edit.
    pub(crate) fn entries_mut(self, layout: &mut Layout) -> Option<&mut TypeEntries> {
        match self {
            Self::Paths => Some(layout.paths.vehicle_types_mut()),
            Self::Nodes => Some(layout.nodes.vehicle_types_mut()),
            Self::Stations => None,
        }
    }
}
