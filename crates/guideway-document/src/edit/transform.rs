//! Moves, turns, mirrors and scales elements; nodes, stations and neighbors follow.

use std::sync::Arc;

use guideway_scene::{Edit, EditError, NewNode, Table, TableEdit};
use guideway_spline::{Affine, Point};

use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

/// Paths that are not transformed, but share a node with one that is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Neighbors {
    /// They stretch, so that they still end at the node, which moves along.
    #[default]
    Follow,
    /// They stay with the node. The transformed paths get a node of their own.
    Detach,
}

impl Document {
    /// Transforms the selected paths with [`Neighbors::Follow`]. See [`Self::transform`].
    ///
    /// # Errors
    /// As [`Self::transform`].
    pub fn transform_selection(&mut self, name: &'static str, by: Affine) -> Result<(), EditError> {
        let selected = Arc::clone(&self.selection);
        self.transform(name, &selected, by, Neighbors::Follow)
    }

    /// Translates, rotates, mirrors or scales elements. The nodes of the paths move along, and the
    /// stations whose nodes all move. Other stations move by the mean of the moves of their nodes.
    ///
    /// # Errors
    /// When an element does not exist, or would exceed the coordinate limit; the document is
    /// unchanged.
    pub fn transform(
        &mut self,
        name: &'static str,
        elements: &Elements,
        by: Affine,
        neighbors: Neighbors,
    ) -> Result<(), EditError> {
        self.check_exist(elements)?;
        let paths = &elements.paths;
        let ends = self.end_nodes(paths);
        let shared = match neighbors {
            Neighbors::Follow => PathSet::new(),
            Neighbors::Detach => &(&ends - &self.nodes_of_only(paths)) - &elements.nodes,
        };
        let nodes = &(&ends - &shared) | &elements.nodes;
        let stations = &self.stations_of_only(&nodes) | &elements.stations;

        let mut changes = Vec::new();
        if !paths.is_empty() {
            let paths: Arc<[u32]> = paths.iter().collect();
            changes.push(Edit::Transform { paths, by }.into());
        }
        changes.extend(self.transformed_lengths(paths, by));
        let to = |node| (node, by.apply(self.node_position_m(node)));
        let to: Vec<(u32, Point<f64>)> = nodes.iter().map(to).collect();
        changes.extend(self.moves_of_nodes(&to, paths));
        let at_m = |station| self.layout().stations.position_m(station);
        let placed = stations
            .iter()
            .filter_map(|row| Some((row, Some(by.apply(at_m(row)?)))));
        let placed: Arc<[_]> = placed.collect();
        if !placed.is_empty() {
            changes.push(TableEdit::MoveStations(placed).into());
        }
        changes.extend(self.nodes_of_their_own(paths, &shared, by));
        self.perform(name, changes)
    }

    /// Gives `paths` copies of the `shared` nodes, at their transformed positions.
    fn nodes_of_their_own(&self, paths: &PathSet, shared: &PathSet, by: Affine) -> Vec<Change> {
        if shared.is_empty() {
            return Vec::new();
        }
        let (layout, mut names) = (self.layout(), self.names(Table::Nodes));
        let copy = |node| NewNode {
            id: names.unique(&format!("{} copy 1", layout.nodes.id(node))),
            position_m: by.apply(layout.nodes.position_m(node)),
            level: layout.nodes.level(node),
            vehicle_types: layout
                .nodes
                .vehicle_types()
                .of(node as usize)
                .map(str::to_owned)
                .collect(),
            attributes_of: Some(node),
        };
        let copies: Arc<[NewNode]> = shared.iter().map(copy).collect();
        let first = layout.nodes.len() as u32;
        let own = |node: Option<u32>| {
            let node = node?;
            let is_shared = shared.contains(node);
            // The rank counts the rows up to and with this one.
            Some(if is_shared {
                first + shared.rank(node) as u32 - 1
            } else {
                node
            })
        };
        let ends = paths.iter().map(|row| {
            let path = layout.paths.get(row as usize);
            (row, [own(path.start_node()), own(path.end_node())])
        });
        vec![
            TableEdit::InsertNodes(copies).into(),
            TableEdit::SetEnds(ends.collect()).into(),
        ]
    }
}
