//! Node positions that edits changed, and the station positions that follow from them.

use std::collections::BTreeMap;

use guideway_layout::{Layout, Nodes, Stations};
use guideway_spline::Point;

/// New positions of moved nodes, by row. All other nodes are where the layout has them.
#[derive(Clone, Debug, Default)]
pub(crate) struct MovedNodes(BTreeMap<u32, Point<f64>>);

impl MovedNodes {
    /// Returns `true` if no node was ever moved.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Records new positions, in meters.
    pub(crate) fn extend(&mut self, to: &[(u32, Point<f64>)]) {
        self.0.extend(to.iter().copied());
    }

    /// Present position of a node, in meters.
    pub(crate) fn node_position_m(&self, layout: &Layout, node: u32) -> Point<f64> {
        let moved = self.0.get(&node).copied();
        moved.unwrap_or_else(|| layout.nodes.position_m(node))
    }

    /// Present position of a station that the layout places. If all of its nodes moved, it moves by
    /// the mean of their moves.
    fn placed_station_m(&self, layout: &Layout, station: u32) -> Option<Point<f64>> {
        let placed = layout.stations.position_m(station)?;
        let nodes = layout.stations.nodes(station);
        let by_m = |node| self.node_position_m(layout, node) - layout.nodes.position_m(node);
        let moves = nodes.iter().map(|&node| by_m(node));
        // A node moved there and back has not moved.
        let moves_along = !nodes.is_empty() && moves.clone().all(|by| by != Point::new(0.0, 0.0));
        let sum = moves.fold(Point::new(0.0, 0.0), |sum, by| sum + by);
        Some(if moves_along {
            placed + sum * (1.0 / nodes.len() as f64)
        } else {
            placed
        })
    }

    /// Present position of a station: its own, or that of its first node.
    pub(crate) fn station_position_m(&self, layout: &Layout, station: u32) -> Option<Point<f64>> {
        let placed = self.placed_station_m(layout, station);
        let at_node = || {
            let node = layout.stations.nodes(station).first()?;
            Some(self.node_position_m(layout, *node))
        };
        placed.or_else(at_node)
    }

    /// All nodes at their present positions.
    pub(crate) fn nodes(&self, layout: &Layout) -> Nodes {
        let old = &layout.nodes;
        if self.0.is_empty() {
            return old.clone();
        }
        let mut nodes = old.clone();
        for (&node, &at_m) in &self.0 {
            nodes.set_position_m(node, at_m);
        }
        nodes
    }

    /// All stations at their present positions.
    pub(crate) fn stations(&self, layout: &Layout) -> Stations {
        let old = &layout.stations;
        if self.0.is_empty() {
            return old.clone();
        }
        let mut stations = old.clone();
        for station in 0..old.len() as u32 {
            stations.set_position_m(station, self.placed_station_m(layout, station));
        }
        stations
    }
}
