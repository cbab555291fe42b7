//! Gaps of a network: the nearest node that no path connects with a given one.

use std::collections::VecDeque;

use guideway_layout::Direction;
use guideway_scene::{PathState, Table};
use guideway_spline::Bounds;

use crate::PathSet;
use crate::document::Document;

/// Most nodes of a part that are compared with the others: enough for a forgotten aisle, and done
/// within a frame.
const MAX_NODES: usize = 2_000;
/// Widest gap that is proposed to close, in meters.
const WIDEST_M: f64 = 50.0;
/// First distance to look at, in meters.
const FIRST_M: f64 = 0.5;

/// Two nodes, and their distance in meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gap {
    pub(super) nodes: [u32; 2],
    pub(super) distance_m: f64,
}

impl Document {
    /// The smallest gap between the part of the network with a node and other nodes of its level.
    pub(super) fn gap_of_part(&self, node: u32) -> Option<Gap> {
        let part = self.part_of(node);
        let gaps = part.iter().filter_map(|node| self.gap_at(node, &part));
        gaps.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m))
    }

    /// The nearest node of the level that is not among `others`.
    pub(super) fn gap_at(&self, node: u32, others: &PathSet) -> Option<Gap> {
        let nodes = &self.layout().nodes;
        let at_m = self.node_position_m(node);
        let mut reach_m = FIRST_M;
        while reach_m <= WIDEST_M {
            let bounds = Bounds {
                min: at_m,
                max: at_m,
            }
            .inflated(reach_m);
            let is_other = |&other: &u32| {
                other != node && !others.contains(other) && nodes.level(other) == nodes.level(node)
            };
            let near = self.index().nodes_in(bounds).filter(is_other);
            let gaps = near.map(|other| Gap {
                nodes: [node, other],
                distance_m: self.node_position_m(other).distance(at_m),
            });
            let nearest = gaps.min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
            // A corner of the box is farther away than its sides.
            if let Some(gap) = nearest.filter(|gap| gap.distance_m <= reach_m) {
                return Some(gap);
            }
            reach_m *= 2.0;
        }
        None
    }

    /// Nodes that paths connect with a node, in any direction; the nearest ones of a large part.
    fn part_of(&self, node: u32) -> PathSet {
        let mut part = PathSet::from_iter([node]);
        let mut queue = VecDeque::from([node]);
        while let Some(node) = queue.pop_front() {
            for other in self.neighbors(node) {
                if part.len() < MAX_NODES as u64 && part.insert(other) {
                    queue.push_back(other);
                }
            }
        }
        part
    }

    /// Nodes at the other ends of the paths of a node.
    pub(super) fn neighbors(&self, node: u32) -> Vec<u32> {
        let ends = self.paths_at(node).into_iter().flat_map(|path| {
            let path = self.layout().paths.get(path as usize);
            [path.start_node(), path.end_node()]
        });
        ends.flatten().filter(|&other| other != node).collect()
    }

    /// Paths that start or end at a node.
    pub(super) fn paths_at(&self, node: u32) -> Vec<u32> {
        let exists = |&path: &u32| self.scene().state(path) != PathState::Removed;
        self.index().paths_at(node).filter(exists).collect()
    }

    /// One-way paths that end at a node.
    pub(super) fn one_way_to(&self, node: u32) -> PathSet {
        let leads_here = |&path: &u32| {
            let path = self.layout().paths.get(path as usize);
            path.end_node() == Some(node) && path.direction() == Direction::Forward
        };
        self.paths_at(node).into_iter().filter(leads_here).collect()
    }

    /// Returns `true` if a row of a table exists.
    pub(super) fn has_row(&self, of: Table, row: u32) -> bool {
        (row as usize) < of.row_count(self.layout()) && self.scene().exists(of, row)
    }
}
