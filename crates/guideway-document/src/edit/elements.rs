//! Elements of a document: which exist, and which belong together.

use guideway_scene::{EditError, Table};

use crate::PathSet;
use crate::document::Document;
use crate::elements::Elements;
use crate::index::nodes_of;

impl Document {
    /// Rows of a table that exist.
    pub fn existing(&self, of: Table) -> impl Iterator<Item = u32> {
        let rows = 0..of.row_count(self.layout()) as u32;
        rows.filter(move |&row| self.scene.exists(of, row))
    }

    /// Checks that all elements exist.
    pub(super) fn check_exist(&self, elements: &Elements) -> Result<(), EditError> {
        Table::ALL
            .into_iter()
            .try_for_each(|of| self.check_rows_exist(of, elements.rows(of)))
    }

    /// Checks that all rows of a table exist.
    pub(super) fn check_rows_exist(&self, of: Table, rows: &PathSet) -> Result<(), EditError> {
        let what = of.element();
        match rows.iter().find(|&row| !self.scene.exists(of, row)) {
            None => Ok(()),
            Some(row) => Err(EditError::UnknownReference { what, row }),
        }
    }

    /// The end nodes of paths.
    pub(super) fn end_nodes(&self, paths: &PathSet) -> PathSet {
        let path = |row: u32| self.layout().paths.get(row as usize);
        paths.iter().flat_map(|row| nodes_of(path(row))).collect()
    }

    /// Paths that start or end at a node, without removed ones.
    pub(super) fn existing_paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        let exists = |&path: &u32| self.scene.exists(Table::Paths, path);
        self.index.paths_at(node).filter(exists)
    }

    /// Stations that exist and have nodes, all of which are among `nodes`.
    pub(super) fn stations_of_only(&self, nodes: &PathSet) -> PathSet {
        let at_nodes = nodes.iter().flat_map(|node| self.index.stations_at(node));
        let at_nodes: PathSet = at_nodes.collect();
        let are_all = |&station: &u32| {
            let own = self.layout().stations.nodes(station);
            self.scene.exists(Table::Stations, station)
                && own.iter().all(|&node| nodes.contains(node))
        };
        at_nodes.iter().filter(are_all).collect()
    }

    /// Nodes all of whose paths are among `paths`.
    pub(super) fn nodes_of_only(&self, paths: &PathSet) -> PathSet {
        let ends = self.end_nodes(paths);
        let ends = ends.iter().filter(|node| self.has_only(*node, paths));
        ends.collect()
    }

    /// Returns `true` if all paths that start or end at a node are among `paths`.
    pub(crate) fn has_only(&self, node: u32, paths: &PathSet) -> bool {
        let mut own = self.existing_paths_at(node);
        own.all(|path| paths.contains(path))
    }
}
