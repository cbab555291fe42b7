//! Grid lookup of new end nodes: paths without nodes that meet share one node.
//!
//! A hash grid of squares finds a node within the join tolerance in constant time.

use guideway_spline::Point;
use hashbrown::HashMap;

/// Largest distance of path ends that share a new node, in meters.
const JOIN_TOLERANCE_M: f64 = 1e-3;

/// Side of a square of the grid, in meters. Derived: with 8 tolerances a search seldom leaves one
/// square.
const SQUARE_M: f64 = 8.0 * JOIN_TOLERANCE_M;

/// New nodes by square. No two nodes of a level are within [`JOIN_TOLERANCE_M`], so a square has
/// few.
#[derive(Default)]
pub(crate) struct EndNodes(HashMap<Square, Vec<(Point<f64>, u32)>>);

/// Level, column and row of a square.
type Square = (usize, i64, i64);

impl EndNodes {
    /// Returns the first node within the join tolerance of a position.
    pub(crate) fn near(&self, level: usize, position: Point<f64>) -> Option<u32> {
        let reach = Point::new(JOIN_TOLERANCE_M, JOIN_TOLERANCE_M);
        let [(_, left, low), (_, right, high)] =
            [position - reach, position + reach].map(|corner| square(level, corner));
        let around = (left..=right).flat_map(|x| (low..=high).map(move |y| (level, x, y)));
        let all = around.filter_map(|square| self.0.get(&square)).flatten();
        let near = all.filter(|(other, _)| other.distance(position) <= JOIN_TOLERANCE_M);
        near.map(|(_, node)| *node).min()
    }

    /// Adds a node.
    pub(crate) fn add(&mut self, level: usize, position: Point<f64>, node: u32) {
        let nodes = self.0.entry(square(level, position)).or_default();
        nodes.push((position, node));
    }
}

fn square(level: usize, position: Point<f64>) -> Square {
    let [x, y] = [position.x, position.y].map(|v| (v / SQUARE_M).floor() as i64);
    (level, x, y)
}
