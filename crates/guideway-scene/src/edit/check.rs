//! Checks an edit against a scene before it is applied, so that a rejected edit changes nothing.

use guideway_layout::Layout;
use guideway_spline::{Bounds, Point};

use super::error::EditError;
use super::operation::{Edit, Insertion};
use crate::scene::Scene;

/// Largest coordinate of a control point after an edit, in meters: far beyond any site, and still
/// with a resolution of 1e-7 m in `f64`.
pub(super) const MAX_COORDINATE_M: f64 = 1e9;

impl Edit {
    /// Accepts the edit or returns the reason for rejecting it.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), EditError> {
        let rows = scene.row_count();
        let is_unknown = |&path: &u32| path as usize >= rows;
        let greatest = self.paths().max().filter(is_unknown);
        if let Some(path) = greatest.and_then(|_| self.paths().find(is_unknown)) {
            return Err(EditError::UnknownPath { path, rows });
        }
        let geometry = scene.layout().paths.geometry();
        match self {
            Self::Transform { paths, by } => {
                check_rows(scene, paths)?;
                // A map that keeps the corners of a box in bounds keeps all points inside it in
                // bounds.
                let hull = geometry.hull_bounds(paths.iter().map(|&path| path as usize));
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

/// Accepts rows of paths that exist, each once.
pub(super) fn check_rows(scene: &Scene, paths: &[u32]) -> Result<(), EditError> {
    let rows = scene.row_count();
    // Without an early exit the compiler vectorizes the comparison.
    let greatest = paths.iter().copied().fold(0, u32::max);
    if let Some(path) = (!paths.is_empty() && greatest as usize >= rows).then_some(greatest) {
        return Err(EditError::UnknownPath { path, rows });
    }
    match find_duplicate(paths) {
        Some(path) => Err(EditError::DuplicatePath { path }),
        None => Ok(()),
    }
}

/// A row that occurs more than once. Rows in ascending order, as selections have them, need no
/// sort.
fn find_duplicate(rows: &[u32]) -> Option<u32> {
    // Without an early exit the compiler vectorizes the comparison.
    let pairs = rows.array_windows();
    if pairs.fold(true, |is_sorted, [a, b]| is_sorted & (a < b)) {
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
