//! Attaches paths to their nodes.

use guideway_spline::Point;

use super::error::ShapeError;
use super::plan::Plan;
use crate::PathSet;
use crate::document::Document;
use crate::edit::curves::{runs_of, with_moved_ends};

impl Document {
    /// Moves the ends of paths onto their nodes; the curve between follows evenly.
    ///
    /// # Errors
    /// When no path is given or one does not exist, or an end would exceed the coordinate limit.
    pub fn attach_ends(&mut self, paths: &PathSet) -> Result<(), ShapeError> {
        self.check_paths(paths)?;
        let mut plan = Plan::new(self);
        for row in paths.iter() {
            let path = self.layout().paths.get(row as usize);
            let Some((start, end)) = path.ends() else {
                continue;
            };
            let shift = |node: Option<u32>, from: Point<f64>| {
                node.map_or(Point::new(0.0, 0.0), |node| {
                    self.node_position_m(node) - from
                })
            };
            let by = [shift(path.start_node(), start), shift(path.end_node(), end)];
            if by.iter().any(|by| by.norm() > 0.0) {
                plan.set_curve(row, with_moved_ends(&runs_of(path), by[0], by[1]));
            }
        }
        let changes = plan.changes();
        Ok(self.perform("attach to nodes", changes)?)
    }
}
