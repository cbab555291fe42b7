//! Deletes paths, nodes and stations.

use std::sync::Arc;

use guideway_scene::{EditError, PathState, Table, TableEdit};

use super::error::OperationError;
use super::perform::set_states;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

impl Document {
    /// Deletes what is selected, the paths of selected nodes, and the nodes that only the deleted
    /// paths use.
    ///
    /// # Errors
    /// When the scene rejects a change; the document is unchanged.
    pub fn delete_selection(&mut self) -> Result<(), EditError> {
        let changes = self.deletion_with_paths(&self.selection);
        self.perform("delete", changes)
    }

    /// Deletes elements, and the nodes that only the deleted paths use. A station loses a deleted
    /// node, and keeps its place. `with_paths` deletes the other paths of the nodes too.
    ///
    /// # Errors
    /// When an element does not exist, or a path that stays uses a node.
    pub fn delete(&mut self, elements: &Elements, with_paths: bool) -> Result<(), OperationError> {
        self.check_exist(elements)?;
        let mut all = elements.clone();
        for node in &elements.nodes {
            let others = self.existing_paths_at(node);
            let others: Vec<u32> = others.filter(|&path| !all.paths.contains(path)).collect();
            match others.first() {
                Some(&path) if !with_paths => {
                    return Err(OperationError::NodeInUse {
                        node: self.layout().nodes.id(node).to_owned(),
                        path: self.layout().paths.id(path as usize).to_owned(),
                        count: others.len(),
                    });
                }
                _ => all.paths.extend(others),
            }
        }
        let changes = self.deletion_of(&all);
        Ok(self.perform("delete", changes)?)
    }

    /// The deletion of elements, of the paths of the nodes among them, and of the nodes that only
    /// these paths use.
    pub(super) fn deletion_with_paths(&self, elements: &Elements) -> Vec<Change> {
        let mut all = elements.clone();
        for node in &elements.nodes {
            all.paths.extend(self.existing_paths_at(node));
        }
        self.deletion_of(&all)
    }

    fn deletion_of(&self, elements: &Elements) -> Vec<Change> {
        let serves = |&node: &u32| {
            let mut stations = self.index.stations_at(node);
            stations.any(|station| {
                self.scene.exists(Table::Stations, station) && !elements.stations.contains(station)
            })
        };
        let unused = self.nodes_of_only(&elements.paths);
        let unused = unused.iter().filter(|node| !serves(node));
        let nodes = &elements.nodes | &unused.collect::<PathSet>();
        let mut changes = Vec::new();
        if !elements.paths.is_empty() {
            changes.push(set_states(elements.paths.iter(), PathState::Removed));
        }
        changes.extend(self.stations_without(&nodes, &elements.stations));
        for (of, rows) in [
            (Table::Nodes, &nodes),
            (Table::Stations, &elements.stations),
        ] {
            if !rows.is_empty() {
                let rows = rows.iter().map(|row| (row, false)).collect();
                changes.push(TableEdit::SetExists { of, rows }.into());
            }
        }
        changes
    }

    /// Takes nodes off the stations that stay. A station without a position of its own keeps that
    /// of its first node.
    fn stations_without(&self, nodes: &PathSet, deleted: &PathSet) -> Vec<Change> {
        let at_nodes = nodes.iter().flat_map(|node| self.index.stations_at(node));
        let exists = |&row: &u32| self.scene.exists(Table::Stations, row) && !deleted.contains(row);
        let rows: PathSet = at_nodes.filter(exists).collect();
        if rows.is_empty() {
            return Vec::new();
        }
        let layout = self.layout();
        let left = |row: u32| {
            let left = layout.stations.nodes(row).iter().copied();
            (row, left.filter(|&node| !nodes.contains(node)).collect())
        };
        let left: Arc<[(u32, Box<[u32]>)]> = rows.iter().map(left).collect();
        let has_place = |row: u32| layout.stations.position_m(row).is_some();
        let placed = rows.iter().filter(|&row| !has_place(row));
        let placed: Arc<[_]> = placed
            .map(|row| (row, self.station_position_m(row)))
            .collect();
        let mut changes = Vec::new();
        if !placed.is_empty() {
            changes.push(TableEdit::MoveStations(placed).into());
        }
        changes.push(TableEdit::SetStationNodes(left).into());
        changes
    }
}
