//! Edits of single control points: move, insert, remove.

use guideway_scene::{EditError, Table};
use guideway_spline::{Point, Runs, uniform};

use super::clamped::{clamped, unclamped};
use super::curves::{runs_of, with_changed_run, with_moved_ends};
use crate::document::Document;

/// Distance of two ends, in meters, up to which they are one.
const JOINED_M: f64 = 1e-6;

/// Reference to a clamped control point of a path: the first and the last one of a run lie on the
/// ends of its curve, and those beside them on its tangents there.
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
    /// Moves a control point. One at a node takes the node along, and one where two runs meet moves
    /// the ends of both; straight runs stay straight. Other points leave the ends of the path at
    /// their nodes, and its runs together.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or when the path is unknown.
    pub fn move_point(&mut self, point: PointRef, to_m: Point<f64>) -> Result<(), EditError> {
        const NAME: &str = "move point";
        let runs = self.runs_to_edit(point)?;
        let Some(run) = runs.iter().nth(point.run) else {
            return Ok(());
        };
        let is_start = point.point == 0;
        if !is_start && point.point + 1 != run.len() {
            return self.reshape_run(NAME, point, &runs, |points| {
                points.get_mut(point.point).is_some_and(|p| {
                    *p = to_m;
                    true
                })
            });
        }
        let by = to_m - clamped(run)[point.point];
        match self.node_of_end(point, is_start, &runs) {
            Some(node) => {
                let to_m = self.node_position_m(node) + by;
                self.move_nodes(NAME, &[(node, to_m)])
            }
            None => {
                let moved = with_moved_joint(&runs, point.run, is_start, by);
                self.perform(NAME, self.reshape(vec![point.path], &[moved]))
            }
        }
    }

    /// The runs of the path of a point.
    fn runs_to_edit(&self, point: PointRef) -> Result<Runs, EditError> {
        let path = point.path;
        match self.scene.exists(Table::Paths, path) {
            true => Ok(runs_of(self.layout().paths.get(path as usize))),
            false => Err(EditError::UnknownPath {
                path,
                rows: self.scene.row_count(),
            }),
        }
    }

    /// The node at the start or end of a run, if that is an end of the path.
    fn node_of_end(&self, point: PointRef, is_start: bool, runs: &Runs) -> Option<u32> {
        let path = self.layout().paths.get(point.path as usize);
        match is_start {
            true => path.start_node().filter(|_| point.run == 0),
            false => path.end_node().filter(|_| point.run + 1 == runs.len()),
        }
    }

    /// Inserts a control point after another, halfway to the next. The curve changes slightly
    /// there.
    ///
    /// # Errors
    /// As [`Self::move_point`].
    pub fn insert_point(&mut self, point: PointRef) -> Result<(), EditError> {
        let runs = self.runs_to_edit(point)?;
        self.reshape_run("insert point", point, &runs, |points| {
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
        let runs = self.runs_to_edit(point)?;
        self.reshape_run("remove point", point, &runs, |points| {
            let exists = point.point < points.len();
            if exists {
                points.remove(point.point);
            }
            exists
        })
    }

    /// Changes the clamped points of one run; no step if `change` returns false. The run still
    /// starts and ends where a node or another run is.
    fn reshape_run(
        &mut self,
        name: &'static str,
        point: PointRef,
        runs: &Runs,
        change: impl FnOnce(&mut Vec<Point<f64>>) -> bool,
    ) -> Result<(), EditError> {
        let path = self.layout().paths.get(point.path as usize);
        let holds_start = point.run > 0 || path.start_node().is_some();
        let holds_end = point.run + 1 < runs.len() || path.end_node().is_some();
        let changed = with_changed_run(runs, point.run, |run| {
            let before = clamped(run);
            let mut points = before.clone();
            if !change(&mut points) || points.len() < 4 {
                return false;
            }
            let last = points.len() - 1;
            if holds_start {
                points[0] = before[0];
            }
            if holds_end {
                points[last] = before[before.len() - 1];
            }
            *run = unclamped(&points);
            true
        });
        match changed {
            Some(runs) => self.perform(name, self.reshape(vec![point.path], &[runs])),
            None => Ok(()),
        }
    }
}

/// The curve with the start or end of one run moved, and that of the run that meets it there.
fn with_moved_joint(runs: &Runs, index: usize, is_start: bool, by: Point<f64>) -> Runs {
    let ends = |run: &[Point<f64>]| {
        let last = run.len() - 4;
        [
            uniform::start(uniform::segment(run, 0)),
            uniform::end(uniform::segment(run, last)),
        ]
    };
    let joint = runs
        .iter()
        .nth(index)
        .map(|run| ends(run)[usize::from(!is_start)]);
    let mut moved = Runs::default();
    for (i, run) in runs.iter().enumerate() {
        let [start, end] = ends(run);
        let meets = |end: Point<f64>| joint.is_some_and(|joint| joint.distance(end) <= JOINED_M);
        // Runs follow each other: only the neighbor on that side can meet it.
        let moves_start = i == index && is_start || !is_start && i == index + 1 && meets(start);
        let moves_end = i == index && !is_start || is_start && i + 1 == index && meets(end);
        let shift = |moves| if moves { by } else { Point::new(0.0, 0.0) };
        let mut one = Runs::default();
        one.push(run);
        if moves_start || moves_end {
            one = with_moved_ends(&one, shift(moves_start), shift(moves_end));
        }
        one.iter().for_each(|run| moved.push(run));
    }
    moved
}
