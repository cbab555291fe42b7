//! Moves of nodes, with the stations and the ends of the paths that follow.

use std::collections::HashMap;

use guideway_layout::PathRef;
use guideway_scene::{EditError, Table};
use guideway_spline::Point;

use super::curves::{runs_of, with_moved_ends};
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;

impl Document {
    /// Moves a node, the ends of its paths, and its stations.
    ///
    /// # Errors
    /// When the node does not exist, or something would exceed the coordinate limit.
    pub fn move_node(&mut self, node: u32, to_m: Point<f64>) -> Result<(), EditError> {
        self.move_nodes("move node", &[(node, to_m)])
    }

    /// Moves several nodes, the ends of their paths, and their stations, in one step.
    ///
    /// # Errors
    /// As [`Self::move_node`].
    pub fn move_nodes(
        &mut self,
        name: &'static str,
        to: &[(u32, Point<f64>)],
    ) -> Result<(), EditError> {
        let nodes: PathSet = to.iter().map(|(node, _)| *node).collect();
        self.check_rows_exist(Table::Nodes, &nodes)?;
        let changes = self.moves_of_nodes(to, &PathSet::new());
        self.perform(name, changes)
    }

    /// Changes that move nodes and their stations, and stretch the paths there so that they still
    /// end at their nodes, except those in `except`. Each node is named once.
    pub(super) fn moves_of_nodes(&self, to: &[(u32, Point<f64>)], except: &PathSet) -> Vec<Change> {
        if to.is_empty() {
            return Vec::new();
        }
        let shift = |&(node, at_m): &(u32, Point<f64>)| (node, at_m - self.node_position_m(node));
        let shifts: HashMap<u32, Point<f64>> = to.iter().map(shift).collect();
        let at_nodes = to
            .iter()
            .flat_map(|(node, _)| self.existing_paths_at(*node));
        let rows: PathSet = at_nodes.filter(|&path| !except.contains(path)).collect();
        let by = |node: Option<u32>| {
            let shift = node.and_then(|node| shifts.get(&node));
            shift.copied().unwrap_or(Point::new(0.0, 0.0))
        };
        let stretched = |path: PathRef<'_>| {
            let (start_by, end_by) = (by(path.start_node()), by(path.end_node()));
            with_moved_ends(&runs_of(path), start_by, end_by)
        };
        let paths = rows.iter().map(|row| self.layout().paths.get(row as usize));
        let curves: Vec<_> = paths.map(stretched).collect();
        let mut changes = vec![Change::MoveNodes(to.into())];
        if !rows.is_empty() {
            changes.extend(self.reshape(rows.iter().collect(), &curves));
        }
        changes
    }
}
