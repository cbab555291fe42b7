use std::f64::consts::TAU;

use guideway_spline::{Bounds, Point};

use crate::Document;

/// What a place is drawn to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SnapOptions {
    /// Nodes this near, in meters; they come first.
    pub node_reach_m: Option<f64>,
    /// A node that does not count, for it is what moves.
    pub moving_node: Option<u32>,
    /// Crossings of a grid of this step, in meters.
    pub grid_m: Option<f64>,
    /// Directions from the point before: so many a turn, at the distance pointed at.
    pub directions: Option<u32>,
}

impl Document {
    /// Where a person means who points at `at_m`, coming from `from_m`.
    pub fn snap(
        &self,
        snap: &SnapOptions,
        at_m: Point<f64>,
        from_m: Option<Point<f64>>,
    ) -> Point<f64> {
        let node = snap
            .node_reach_m
            .and_then(|reach_m| self.node_near_but(at_m, reach_m, snap.moving_node));
        if let Some(node) = node {
            return self.node_position_m(node);
        }
        if let (Some(count), Some(from)) = (snap.directions, from_m) {
            return in_direction(from, at_m, count);
        }
        let on_grid = |v: f64, step: f64| (v / step).round() * step;
        match snap.grid_m {
            Some(step) => Point::new(on_grid(at_m.x, step), on_grid(at_m.y, step)),
            None => at_m,
        }
    }

    /// The node nearest to a place, if one is within reach.
    pub fn node_near(&self, at_m: Point<f64>, reach_m: f64) -> Option<u32> {
        self.node_near_but(at_m, reach_m, None)
    }

    fn node_near_but(&self, at_m: Point<f64>, reach_m: f64, but: Option<u32>) -> Option<u32> {
        let spot = Bounds {
            min: at_m,
            max: at_m,
        };
        let distance = |node: u32| self.node_position_m(node).distance(at_m);
        let near = self.index.nodes_in(spot.inflated(reach_m));
        let near = near.filter(|&node| Some(node) != but);
        let near = near.map(|node| (distance(node), node));
        let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        (nearest.0 <= reach_m).then_some(nearest.1)
    }
}

fn in_direction(from: Point<f64>, to: Point<f64>, count: u32) -> Point<f64> {
    let way = to - from;
    let step = TAU / f64::from(count.max(1));
    let angle = (way.y.atan2(way.x) / step).round() * step;
    let unit = Point::new(angle.cos(), angle.sin());
    from + unit * way.dot(unit)
}
