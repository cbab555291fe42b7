//! Edits of single control points: move, insert, remove.

use guideway_scene::{EditError, Table};
use guideway_spline::Point;

use super::curves::{hold_start, runs_of, start_of, with_changed_run};
use crate::document::Document;

/// Reference to a control point of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointRef {
    /// Row of the path.
    pub path: u32,
    /// Index of the run in the path.
    pub run: usize,
    /// Index of the point in the run.
    pub point: usize,
}

impl Document {
    /// Moves a control point. The point at a node, the second or the last but one of the path,
    /// takes the node along. Other points leave the ends of the path at their nodes, and its runs
    /// together.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or when the path is unknown.
    pub fn move_point(&mut self, point: PointRef, to_m: Point<f64>) -> Result<(), EditError> {
        const NAME: &str = "move point";
        if let Some((node, from_m)) = self.node_of_point(point) {
            let to_m = self.node_position_m(node) + (to_m - from_m);
            return self.move_nodes(NAME, &[(node, to_m)]);
        }
        self.reshape_run(NAME, point, true, |points| {
            points.get_mut(point.point).is_some_and(|p| {
                *p = to_m;
                true
            })
        })
    }

    /// The node that a control point takes along, and the position of the point.
    fn node_of_point(&self, point: PointRef) -> Option<(u32, Point<f64>)> {
        if !self.scene.exists(Table::Paths, point.path) {
            return None;
        }
        let path = self.layout().paths.get(point.path as usize);
        let runs = runs_of(path);
        let run = runs.iter().nth(point.run)?;
        let start = path
            .start_node()
            .filter(|_| point.run == 0 && point.point == 1);
        let is_last = point.run + 1 == runs.len() && point.point + 2 == run.len();
        let node = start.or_else(|| path.end_node().filter(|_| is_last))?;
        Some((node, run[point.point]))
    }

    /// Inserts a control point after another, halfway to the next. The curve changes slightly
    /// there.
    ///
    /// # Errors
    /// As [`Self::move_point`].
    pub fn insert_point(&mut self, point: PointRef) -> Result<(), EditError> {
        self.reshape_run("insert point", point, false, |points| {
            let Some([a, b]) = points
                .get(point.point..)
                .and_then(|rest| rest.first_chunk())
            else {
                return false;
            };
            let middle = a.lerp(*b, 0.5);
            points.insert(point.point + 1, middle);
            true
        })
    }

    /// Removes a control point. A run of four points, the minimum, stays unchanged.
    ///
    /// # Errors
    /// As [`Self::move_point`].
    pub fn remove_point(&mut self, point: PointRef) -> Result<(), EditError> {
        self.reshape_run("remove point", point, false, |points| {
            let exists = point.point < points.len();
            if exists {
                points.remove(point.point);
            }
            exists
        })
    }

    /// Changes the points of one run; no step if `change` returns false. The run still starts and
    /// ends where a node or another run is. `keeps_point` leaves the named point where `change` put
    /// it.
    fn reshape_run(
        &mut self,
        name: &'static str,
        point: PointRef,
        keeps_point: bool,
        change: impl FnOnce(&mut Vec<Point<f64>>) -> bool,
    ) -> Result<(), EditError> {
        let rows = self.scene.row_count();
        if !self.scene.exists(Table::Paths, point.path) {
            return Err(EditError::UnknownPath {
                path: point.path,
                rows,
            });
        }
        let path = self.layout().paths.get(point.path as usize);
        let old = runs_of(path);
        let holds_start = point.run > 0 || path.start_node().is_some();
        let holds_end = point.run + 1 < old.len() || path.end_node().is_some();
        let changed = with_changed_run(&old, point.run, |points| {
            let start = start_of(points);
            points.reverse();
            let end = start_of(points);
            points.reverse();
            if !change(points) {
                return false;
            }
            let keeps = |index: Option<usize>| keeps_point && index == Some(point.point);
            let keeps_first = keeps(Some(0));
            let keeps_last = keeps(points.len().checked_sub(1));
            if holds_start {
                hold_start(points, start, keeps_first);
            }
            if holds_end {
                points.reverse();
                hold_start(points, end, keeps_last);
                points.reverse();
            }
            // Holding the end by the last but one of four points has moved the start.
            if holds_start && keeps_last {
                hold_start(points, start, false);
            }
            true
        });
        match changed {
            Some(runs) => self.perform(name, self.reshape(vec![point.path], &[runs])),
            None => Ok(()),
        }
    }
}
