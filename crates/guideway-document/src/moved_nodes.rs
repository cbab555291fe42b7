use std::collections::BTreeMap;

use guideway_layout::{Layout, Nodes, Stations};
use guideway_spline::Point;

/// Nodes that are not where their layout has them, and the stations that they take along.
#[derive(Clone, Debug, Default)]
pub(crate) struct MovedNodes(BTreeMap<u32, Point<f64>>);

impl MovedNodes {
    /// Whether all are where their layout has them, for all that is known.
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Takes note of where some nodes are now.
    pub(crate) fn extend(&mut self, to: &[(u32, Point<f64>)]) {
        self.0.extend(to.iter().copied());
    }

    /// Where a node is now.
    pub(crate) fn node_position_m(&self, layout: &Layout, node: u32) -> Point<f64> {
        let moved = self.0.get(&node).copied();
        moved.unwrap_or_else(|| layout.nodes.position_m(node))
    }

    /// Where a station is now, if the layout says where it was: it goes along if all nodes that serve it do, as far as they
    /// go on the mean.
    fn placed_station_m(&self, layout: &Layout, station: u32) -> Option<Point<f64>> {
        let placed = layout.stations.position_m(station)?;
        let nodes = layout.stations.nodes(station);
        let by_m = |node| self.node_position_m(layout, node) - layout.nodes.position_m(node);
        let moves = nodes.iter().map(|&node| by_m(node));
        // What was moved there and back has not moved.
        let takes_it = !nodes.is_empty() && moves.clone().all(|by| by != Point::new(0.0, 0.0));
        let sum = moves.fold(Point::new(0.0, 0.0), |sum, by| sum + by);
        Some(if takes_it {
            placed + sum * (1.0 / nodes.len() as f64)
        } else {
            placed
        })
    }

    /// Where a station is now: where it was placed, or at the first node that serves it.
    pub(crate) fn station_position_m(&self, layout: &Layout, station: u32) -> Option<Point<f64>> {
        let placed = self.placed_station_m(layout, station);
        let at_node = || {
            let node = layout.stations.nodes(station).first()?;
            Some(self.node_position_m(layout, *node))
        };
        placed.or_else(at_node)
    }

    /// All nodes where they are now.
    pub(crate) fn nodes(&self, layout: &Layout) -> Nodes {
        let old = &layout.nodes;
        if self.0.is_empty() {
            return old.clone();
        }
        let mut nodes = Nodes::default();
        for node in 0..old.len() as u32 {
            let at_m = self.node_position_m(layout, node);
            nodes.push(old.id(node), at_m, old.level(node));
        }
        nodes.attributes = old.attributes.clone();
        nodes
    }

    /// All stations where they are now.
    pub(crate) fn stations(&self, layout: &Layout) -> Stations {
        let old = &layout.stations;
        if self.0.is_empty() {
            return old.clone();
        }
        let mut stations = Stations::default();
        for station in 0..old.len() as u32 {
            let at_m = self.placed_station_m(layout, station);
            let nodes = old.nodes(station).to_vec();
            stations.push(old.id(station), at_m, nodes, old.level(station));
        }
        stations.attributes = old.attributes.clone();
        stations
    }
}
