//! Gives paths other curves: lines, or curves that end at their nodes.

use guideway_layout::PathRef;
use guideway_spline::bezier::SAME_M;
use guideway_spline::{Point, Runs};

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
        self.give_curves("attach to nodes", paths, |document, path, [start, end]| {
            let shift = |node: Option<u32>, from: Point<f64>| {
                node.map_or(Point::new(0.0, 0.0), |node| {
                    document.node_position_m(node) - from
                })
            };
            let by = [shift(path.start_node(), start), shift(path.end_node(), end)];
            let is_off = by.iter().any(|by| by.norm() > 0.0);
            Ok(is_off.then(|| with_moved_ends(&runs_of(path), by[0], by[1])))
        })
    }

    /// Replaces each path by the line between its ends.
    ///
    /// # Errors
    /// When no path is given, a path begins and ends at one place, or as for other edits.
    pub fn straighten(&mut self, paths: &PathSet) -> Result<(), ShapeError> {
        self.give_curves("straighten", paths, |_, path, [start, end]| {
            if start.distance(end) <= SAME_M {
                let path = path.id().to_owned();
                return Err(ShapeError::Loop { path });
            }
            let mut line = Runs::default();
            line.push_line(start, end);
            Ok(Some(line))
        })
    }

    /// Gives paths other curves, as one step: `curve` makes that of a path with these ends, or
    /// leaves it as it is.
    ///
    /// # Errors
    /// When no path is given or one does not exist, or as `curve` and other edits.
    fn give_curves(
        &mut self,
        name: &'static str,
        paths: &PathSet,
        curve: impl Fn(&Self, PathRef<'_>, [Point<f64>; 2]) -> Result<Option<Runs>, ShapeError>,
    ) -> Result<(), ShapeError> {
        self.check_paths(paths)?;
        let mut plan = Plan::new(self);
        for row in paths.iter() {
            let path = self.layout().paths.get(row as usize);
            let Some((start, end)) = path.ends() else {
                continue;
            };
            if let Some(runs) = curve(self, path, [start, end])? {
                plan.set_curve(row, runs);
            }
        }
        let changes = plan.changes();
        Ok(self.perform(name, changes)?)
    }
}
