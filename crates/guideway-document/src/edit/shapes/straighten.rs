//! Straightens paths.

use guideway_spline::Runs;
use guideway_spline::bezier::SAME_M;

use super::error::ShapeError;
use super::plan::Plan;
use crate::PathSet;
use crate::document::Document;

impl Document {
    /// Replaces each path by the line between its ends.
    ///
    /// # Errors
    /// When no path is given, a path begins and ends at one place, or as for other edits.
    pub fn straighten(&mut self, paths: &PathSet) -> Result<(), ShapeError> {
        self.check_paths(paths)?;
        let mut plan = Plan::new(self);
        for row in paths.iter() {
            let path = self.layout().paths.get(row as usize);
            let Some((start, end)) = path.ends() else {
                continue;
            };
            if start.distance(end) <= SAME_M {
                let path = path.id().to_owned();
                return Err(ShapeError::Loop { path });
            }
            let mut line = Runs::default();
            line.push_line(start, end);
            plan.set_curve(row, line);
        }
        let changes = plan.changes();
        Ok(self.perform("straighten", changes)?)
    }
}
