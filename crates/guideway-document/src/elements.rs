//! [`Elements`]: rows of paths, nodes and stations.

use guideway_scene::Table;

use crate::PathSet;
use crate::element::Element;

/// Rows of paths, nodes and stations.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Elements {
    /// Rows of paths.
    pub paths: PathSet,
    /// Rows of nodes.
    pub nodes: PathSet,
    /// Rows of stations.
    pub stations: PathSet,
}

impl Elements {
    /// Only paths.
    pub fn of_paths(paths: impl IntoIterator<Item = u32>) -> Self {
        Self {
            paths: paths.into_iter().collect(),
            ..Self::default()
        }
    }

    /// A single element.
    pub fn of(element: Element) -> Self {
        let mut elements = Self::default();
        elements.insert(element);
        elements
    }

    /// Adds an element.
    pub fn insert(&mut self, element: Element) {
        let (of, row) = element.table_row();
        self.rows_mut(of).insert(row);
    }

    /// Returns `true` if an element is among them.
    pub fn contains(&self, element: Element) -> bool {
        let (of, row) = element.table_row();
        self.rows(of).contains(row)
    }

    /// The rows of a table.
    pub fn rows(&self, of: Table) -> &PathSet {
        match of {
            Table::Paths => &self.paths,
            Table::Nodes => &self.nodes,
            Table::Stations => &self.stations,
        }
    }

    /// The rows of a table, to change.
    pub fn rows_mut(&mut self, of: Table) -> &mut PathSet {
        match of {
            Table::Paths => &mut self.paths,
            Table::Nodes => &mut self.nodes,
            Table::Stations => &mut self.stations,
        }
    }

    /// Number of elements.
    pub(crate) fn len(&self) -> u64 {
        self.paths.len() + self.nodes.len() + self.stations.len()
    }

    /// Memory of the rows, in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let sets = [&self.paths, &self.nodes, &self.stations];
        sets.map(PathSet::serialized_size).iter().sum()
    }

    /// Returns `true` if there are no rows.
    pub fn is_empty(&self) -> bool {
        self.paths.is_empty() && self.nodes.is_empty() && self.stations.is_empty()
    }
}
