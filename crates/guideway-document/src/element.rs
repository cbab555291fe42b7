//! Element: a reference to a path, node or station of a layout.

use guideway_layout::Layout;

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
    /// The element's identifier.
    pub fn id(self, layout: &Layout) -> &str {
        match self {
            Self::Path(row) => layout.paths.id(row as usize),
            Self::Node(row) => layout.nodes.id(row),
            Self::Station(row) => layout.stations.id(row),
        }
    }
}
