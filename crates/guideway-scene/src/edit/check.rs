//! Checks an edit against a scene before it is applied, so that a rejected edit changes nothing.

use guideway_layout::{Layout, rows_ascend};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::error::EditError;
use super::operation::{Edit, Insertion};
use crate::scene::Scene;

/// Largest coordinate of a control point after an edit, in meters: far beyond any site, and still
/// with a resolution of 1e-7 m in `f64`.
pub(super) const MAX_COORDINATE_M: f64 = 1e9;

/// Rows of a task.
const TASK_ROWS: usize = 1 << 13;

impl Edit {
    /// Accepts the edit or returns the reason for rejecting it.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), EditError> {
        match self {
            Self::Transform { paths, .. } | Self::Reshape { paths, .. } => {
                check_known(scene, paths, |path| *path)?;
            }
            Self::Restyle(styles) => check_known(scene, styles, |(path, _)| *path)?,
            Self::SetStates(states) => check_known(scene, states, |(path, _)| *path)?,
            Self::Insert(_) | Self::Tables(_) => {}
        }
        let geometry = scene.layout().paths.geometry();
        match self {
            Self::Transform { paths, by } => {
                check_rows(scene, paths)?;
                // A map that keeps the corners of a box in bounds keeps all points inside it in
                // bounds.
                let hull = hull_of(scene, paths);
                let corners = hull.into_iter().flat_map(Bounds::corners);
                if is_in_bounds(corners.map(|p| by.apply(p))) {
                    return Ok(());
                }
                let outside = paths.iter().find(|&&path| {
                    let points = geometry.runs(path as usize).flat_map(|run| run.iter());
                    !is_in_bounds(points.map(|p| by.apply(p)))
                });
                outside.map_or(Ok(()), |&path| {
                    Err(EditError::OutOfBounds { path: Some(path) })
                })
            }
            Self::Reshape {
                paths,
                curves,
                written,
            } => {
                let last_written = written.iter().last().map(|(place, _)| place);
                if paths.len() != curves.path_count() || last_written >= Some(paths.len()) {
                    return Err(EditError::CurveCountMismatch);
                }
                let outside = curves.first_out_of_range(MAX_COORDINATE_M);
                outside.map_or(Ok(()), |from| {
                    let path = Some(paths[from]);
                    Err(EditError::OutOfBounds { path })
                })
            }
            Self::Insert(paths) => paths.iter().try_for_each(|path| path.check(scene.layout())),
            Self::Tables(edit) => edit.check(scene),
            Self::Restyle(_) | Self::SetStates(_) => Ok(()),
        }
    }
}

impl Insertion {
    fn check(&self, layout: &Layout) -> Result<(), EditError> {
        let mut runs = self.runs.iter().peekable();
        if runs.peek().is_none() || !is_in_bounds(runs.flatten().copied()) {
            return Err(EditError::OutOfBounds { path: None });
        }
        let parts = [
            ("level", self.level, layout.levels.len()),
            ("node", self.start_node, layout.nodes.len()),
            ("node", self.end_node, layout.nodes.len()),
        ];
        for (what, row, rows) in parts {
            if let Some(row) = row.filter(|row| *row as usize >= rows) {
                return Err(EditError::UnknownReference { what, row });
            }
        }
        let rows = layout.paths.len();
        match self.attributes_of.filter(|path| *path as usize >= rows) {
            Some(path) => Err(EditError::UnknownPath { path, rows }),
            None => Ok(()),
        }
    }
}

/// Accepts rows of paths that exist, by all threads if there are many.
fn check_known<I: Sync>(
    scene: &Scene,
    items: &[I],
    path: impl Fn(&I) -> u32 + Sync,
) -> Result<(), EditError> {
    let rows = scene.row_count();
    // Without an early exit the compiler vectorizes the comparison.
    let is_known = |items: &[I]| {
        let all = items
            .iter()
            .fold(0, |end, item| u64::from(path(item)).max(end));
        items.is_empty() || all < rows as u64
    };
    let are_known = match items.len() {
        0..=TASK_ROWS => is_known(items),
        _ => items.par_chunks(TASK_ROWS).all(is_known),
    };
    if are_known {
        return Ok(());
    }
    let unknown = items.iter().map(&path).find(|path| *path as usize >= rows);
    unknown.map_or(Ok(()), |path| Err(EditError::UnknownPath { path, rows }))
}

/// Box of the control points of paths, by all threads; `None` if they have no points.
pub(super) fn hull_of(scene: &Scene, paths: &[u32]) -> Option<Bounds<f64>> {
    let geometry = scene.layout().paths.geometry();
    if let Some(hulls) = geometry.known_hulls() {
        return hulls.of_rows(paths);
    }
    let tasks = paths.par_chunks(TASK_ROWS);
    let of_task = |paths: &[u32]| geometry.hull_bounds(paths.iter().map(|&path| path as usize));
    tasks.filter_map(of_task).reduce_with(Bounds::union)
}

/// Accepts rows of paths that exist, each once.
pub(super) fn check_rows(scene: &Scene, paths: &[u32]) -> Result<(), EditError> {
    check_known(scene, paths, |path| *path)?;
    match find_duplicate(paths) {
        Some(path) => Err(EditError::DuplicatePath { path }),
        None => Ok(()),
    }
}

/// A row that occurs more than once. Rows in ascending order, as selections have them, need no
/// sort.
fn find_duplicate(rows: &[u32]) -> Option<u32> {
    if rows_ascend(rows, &|row| *row) {
        return None;
    }
    let mut sorted = rows.to_vec();
    sorted.sort_unstable();
    sorted
        .array_windows()
        .find(|[a, b]| a == b)
        .map(|[a, _]| *a)
}

pub(super) fn is_in_bounds(mut points: impl Iterator<Item = Point<f64>>) -> bool {
    points.all(|p| p.x.abs() <= MAX_COORDINATE_M && p.y.abs() <= MAX_COORDINATE_M)
}
