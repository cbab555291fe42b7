//! Edits of single control points: move, insert, remove.

use std::sync::Arc;

use guideway_scene::{Edit, EditError};
use guideway_spline::{Point, Runs};

use super::curves::{geometry_of, runs_of, with_changed_run};
use crate::change::Change;
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
    /// Moves a control point.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or when the path is unknown.
    pub fn move_point(&mut self, point: PointRef, to_m: Point<f64>) -> Result<(), EditError> {
        self.reshape_run("move point", point, |points| {
            points.get_mut(point.point).is_some_and(|p| {
                *p = to_m;
                true
            })
        })
    }

    /// Inserts a control point after another, halfway to the next. The curve changes slightly
    /// there.
    ///
    /// # Errors
    /// As [`Self::move_point`].
    pub fn insert_point(&mut self, point: PointRef) -> Result<(), EditError> {
        self.reshape_run("insert point", point, |points| {
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
        self.reshape_run("remove point", point, |points| {
            let exists = point.point < points.len();
            if exists {
                points.remove(point.point);
            }
            exists
        })
    }

    /// Changes the points of one run; no step if `change` returns false.
    fn reshape_run(
        &mut self,
        name: &'static str,
        point: PointRef,
        change: impl FnOnce(&mut Vec<Point<f64>>) -> bool,
    ) -> Result<(), EditError> {
        let rows = self.scene.row_count();
        if point.path as usize >= rows {
            return Err(EditError::UnknownPath {
                path: point.path,
                rows,
            });
        }
        let old = runs_of(self.layout().paths.get(point.path as usize));
        match with_changed_run(&old, point.run, change) {
            Some(runs) => self.perform(name, vec![reshape(vec![point.path], &[runs])]),
            None => Ok(()),
        }
    }
}

/// A change that replaces the curves of paths.
pub(super) fn reshape(paths: Vec<u32>, curves: &[Runs]) -> Change {
    Change::Scene(Edit::Reshape {
        paths: paths.into(),
        curves: Arc::new(geometry_of(curves)),
    })
}
