//! Nav2 identifiers: numbers for nodes and edges, which the route server requires.

use std::collections::HashSet;

use guideway_layout::{Direction, Layout, PathRef};

use crate::driven::driven_nodes;
use crate::unique_names::UniqueNames;

/// Numbers of the nodes and edges of a layout, all different.
pub(super) struct Nav2Ids {
    /// Number of each node; `None` for a node of walls and doors only.
    pub(super) nodes: Vec<Option<u32>>,
    /// Numbers of each path; `None` for a path that is no edge.
    pub(super) edges: Vec<Option<EdgeIds>>,
}

/// Numbers of a path.
pub(super) struct EdgeIds {
    pub(super) number: u32,
    /// Number and identifier of the edge against the direction of a two-way path.
    pub(super) reverse: Option<(u32, String)>,
}

impl Nav2Ids {
    /// Numbers all nodes and edges: identifiers that are numbers stay, others take the least free
    /// number.
    pub(super) fn new(layout: &Layout) -> Self {
        let mut free = FreeNumbers::default();
        let nodes = driven_nodes(layout).into_iter().enumerate();
        let nodes: Vec<_> = nodes
            .map(|(node, is_driven)| is_driven.then(|| free.keep(layout.nodes.id(node as u32))))
            .collect();
        let edges = layout.paths.iter();
        let edges: Vec<_> = edges
            .map(|path| is_edge(layout, &path).then(|| (path, free.keep(path.id()))))
            .collect();
        let nodes = nodes.into_iter();
        let nodes = nodes.map(|node| node.map(|kept| kept.unwrap_or_else(|| free.next())));
        let nodes = nodes.collect();
        let mut names = UniqueNames::new(layout.paths.iter().map(PathRef::id));
        let edges = edges.into_iter().map(|edge| {
            let (path, kept) = edge?;
            let number = kept.unwrap_or_else(|| free.next());
            let is_two_way = path.direction() == Direction::Both;
            let reverse = is_two_way.then(|| (free.next(), names.make_unique(path.id())));
            Some(EdgeIds { number, reverse })
        });
        let edges = edges.collect();
        Self { nodes, edges }
    }
}

/// Returns whether a path becomes an edge: vehicles drive on it, it has a curve and both nodes.
pub(super) fn is_edge(layout: &Layout, path: &PathRef<'_>) -> bool {
    let has_nodes = path.start_node().is_some() && path.end_node().is_some();
    path.runs().len() > 0 && has_nodes && layout.paths.is_driven(path.row())
}

/// Numbers that are not in use.
#[derive(Default)]
struct FreeNumbers {
    used: HashSet<u32>,
    next: u32,
}

impl FreeNumbers {
    /// Takes an identifier that is a number, unless another element has it.
    fn keep(&mut self, id: &str) -> Option<u32> {
        let number = id.parse::<u32>().ok()?;
        let is_free = number.to_string() == id && self.used.insert(number);
        is_free.then_some(number)
    }

    fn next(&mut self) -> u32 {
        while !self.used.insert(self.next) {
            self.next += 1;
        }
        self.next
    }
}
