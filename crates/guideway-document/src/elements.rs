//! [`Elements`]: rows of paths, nodes and stations, with levels and vehicle types.

use std::collections::BTreeSet;

use guideway_scene::Table;

use crate::PathSet;
use crate::element::Element;
use crate::select_mode::SelectMode;

/// Rows of paths, nodes and stations; beside them levels and vehicle types, which selections have.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Elements {
    /// Rows of paths.
    pub paths: PathSet,
    /// Rows of nodes.
    pub nodes: PathSet,
    /// Rows of stations.
    pub stations: PathSet,
    /// Rows of levels, without their elements.
    pub levels: PathSet,
    /// Names of vehicle types.
    pub vehicle_types: BTreeSet<String>,
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

    /// Number of paths, nodes and stations.
    pub(crate) fn len(&self) -> u64 {
        self.paths.len() + self.nodes.len() + self.stations.len()
    }

    /// Memory of the rows, in bytes.
    pub(crate) fn heap_bytes(&self) -> usize {
        let sets = [&self.paths, &self.nodes, &self.stations, &self.levels];
        let rows: usize = sets.map(PathSet::serialized_size).iter().sum();
        rows + self.vehicle_types.iter().map(String::len).sum::<usize>()
    }

    /// Returns `true` if there is nothing.
    pub fn is_empty(&self) -> bool {
        !self.has_elements() && !self.has_groups()
    }

    /// Returns `true` if there are paths, nodes or stations.
    pub fn has_elements(&self) -> bool {
        !(self.paths.is_empty() && self.nodes.is_empty() && self.stations.is_empty())
    }

    /// Returns `true` if there are levels or vehicle types.
    pub fn has_groups(&self) -> bool {
        !self.levels.is_empty() || !self.vehicle_types.is_empty()
    }

    /// These together with others, without others, or the others alone.
    pub(crate) fn combined(&self, others: Self, mode: SelectMode) -> Self {
        let sets = |own: &PathSet, others: PathSet| match mode {
            SelectMode::Replace => others,
            SelectMode::Add => own | &others,
            SelectMode::Remove => own - &others,
        };
        let (own, types) = (&self.vehicle_types, others.vehicle_types);
        Self {
            paths: sets(&self.paths, others.paths),
            nodes: sets(&self.nodes, others.nodes),
            stations: sets(&self.stations, others.stations),
            levels: sets(&self.levels, others.levels),
            vehicle_types: match mode {
                SelectMode::Replace => types,
                SelectMode::Add => own | &types,
                SelectMode::Remove => own - &types,
            },
        }
    }
}
