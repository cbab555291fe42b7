//! Snapping: moves a pointer position onto a node, a place of a path, a direction or a grid.

mod objects;
mod target;

use std::f64::consts::TAU;

use guideway_scene::Table;
use guideway_spline::{Bounds, Point};

use self::objects::nearest_object;
pub use self::target::SnapTarget;
use crate::document::Document;

/// Snap targets; nodes come first, then places of paths, directions, and the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SnapOptions {
    /// Snaps to nodes within this distance, in meters.
    pub node_reach_m: Option<f64>,
    /// The node that is being moved, which is no target.
    pub moving_node: Option<u32>,
    /// Snaps to places of paths within this distance, in meters: ends, middles, crossings, and
    /// where a line from the previous point touches a path or meets it at a right angle.
    pub object_reach_m: Option<f64>,
    /// Snaps to the crossings of a grid with this spacing, in meters.
    pub grid_m: Option<f64>,
    /// Snaps to this number of directions per turn, seen from the previous point.
    pub directions: Option<u32>,
}

/// A position, and what it snapped to, if anything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapped {
    /// The position, in meters.
    pub at_m: Point<f64>,
    /// The target that it snapped to.
    pub to: Option<SnapTarget>,
}

impl Document {
    /// Snaps the position `at_m`; `from_m` is the previous point, if there is one. In meters.
    pub fn snap(
        &self,
        snap: &SnapOptions,
        at_m: Point<f64>,
        from_m: Option<Point<f64>>,
    ) -> Snapped {
        let onto = |at_m, to| Snapped { at_m, to: Some(to) };
        let node = snap
            .node_reach_m
            .and_then(|reach_m| self.nearest_node_except(at_m, reach_m, snap.moving_node));
        if let Some(node) = node {
            return onto(self.node_position_m(node), SnapTarget::Node(node));
        }
        let object = snap
            .object_reach_m
            .and_then(|reach_m| nearest_object(self, at_m, from_m, reach_m));
        if let Some((at_m, to)) = object {
            return onto(at_m, to);
        }
        if let (Some(count), Some(from)) = (snap.directions, from_m) {
            return onto(in_direction(from, at_m, count), SnapTarget::Direction);
        }
        let on_grid = |v: f64, step: f64| (v / step).round() * step;
        match snap.grid_m {
            Some(step) => {
                let at_m = Point::new(on_grid(at_m.x, step), on_grid(at_m.y, step));
                onto(at_m, SnapTarget::Grid)
            }
            None => Snapped { at_m, to: None },
        }
    }

    /// The nearest station within `reach_m` meters of a position, on a level that is shown.
    pub fn station_near(&self, at_m: Point<f64>, reach_m: f64) -> Option<u32> {
        let shown = self.existing(Table::Stations).filter(|&station| {
            let level = self.layout().stations.level(station);
            self.shows_level(level)
        });
        let near = shown.filter_map(|station| {
            let distance_m = self.station_position_m(station)?.distance(at_m);
            (distance_m <= reach_m).then_some((distance_m, station))
        });
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map(|(_, station)| station)
    }

    /// The nearest node within `reach_m` meters of a position, on a level that is shown.
    pub fn node_near(&self, at_m: Point<f64>, reach_m: f64) -> Option<u32> {
        self.nearest_node_except(at_m, reach_m, None)
    }

    fn nearest_node_except(
        &self,
        at_m: Point<f64>,
        reach_m: f64,
        except: Option<u32>,
    ) -> Option<u32> {
        let spot = Bounds {
            min: at_m,
            max: at_m,
        };
        let distance = |node: u32| self.node_position_m(node).distance(at_m);
        let near = self.index.nodes_in(spot.inflated(reach_m));
        let nodes = &self.layout().nodes;
        let is_target = |node: u32| Some(node) != except && self.shows_level(nodes.level(node));
        let near = near.filter(|&node| is_target(node));
        let near = near.map(|node| (distance(node), node));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        (nearest.0 <= reach_m).then_some(nearest.1)
    }
}

/// Projects `to` onto the nearest of `count` evenly spaced directions from `from`.
fn in_direction(from: Point<f64>, to: Point<f64>, count: u32) -> Point<f64> {
    let offset = to - from;
    let step = TAU / f64::from(count.max(1));
    let angle = (offset.y.atan2(offset.x) / step).round() * step;
    let unit = Point::new(angle.cos(), angle.sin());
    from + unit * offset.dot(unit)
}
