//! Element: a reference to a path, node or station of a layout.

use guideway_layout::Layout;
use guideway_scene::Table;

/// A path, node or station, by its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// Row of a path.
    Path(u32),
    /// Row of a node.
    Node(u32),
    /// Row of a station.
    Station(u32),
}

impl Element {
    /// The element of a row of a table.
    pub fn new(of: Table, row: u32) -> Self {
        match of {
            Table::Paths => Self::Path(row),
            Table::Nodes => Self::Node(row),
            Table::Stations => Self::Station(row),
        }
    }

    /// Its table, and its row there.
    pub fn table_row(self) -> (Table, u32) {
        match self {
            Self::Path(row) => (Table::Paths, row),
            Self::Node(row) => (Table::Nodes, row),
            Self::Station(row) => (Table::Stations, row),
        }
    }

    /// The element's identifier.
    pub fn id(self, layout: &Layout) -> &str {
        let (of, row) = self.table_row();
        of.id(layout, row)
    }
}
