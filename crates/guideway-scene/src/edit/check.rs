//! Whether an edit can be done.

use guideway_layout::Layout;
use guideway_spline::{Bounds, Point};

use super::{Edit, EditError, Insertion};
use crate::Scene;

/// Farthest that an edit may put a control point from the origin, in meters.
const REACH_M: f64 = 1e9;

impl Edit {
    /// Whether it can be done.
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
                if let Some(path) = named_twice(paths) {
                    return Err(EditError::Twice { path });
                }
                // Where the corners of a box may go, all in it may.
                let hull = geometry.hull_bounds(paths.iter().map(|&path| path as usize));
                let corners = hull.into_iter().flat_map(Bounds::corners);
                if is_placed(corners.map(|p| by.apply(p))) {
                    return Ok(());
                }
                let misplaced = paths.iter().find(|&&path| {
                    let points = geometry.runs(path as usize).flat_map(|run| run.iter());
                    !is_placed(points.map(|p| by.apply(p)))
                });
                misplaced.map_or(Ok(()), |&path| {
                    Err(EditError::Misplaced { path: Some(path) })
                })
            }
            Self::Reshape { paths, curves } => {
                if paths.len() != curves.path_count() {
                    return Err(EditError::Count);
                }
                let misplaced = curves.first_out_of_range(REACH_M);
                misplaced.map_or(Ok(()), |from| {
                    let path = Some(paths[from]);
                    Err(EditError::Misplaced { path })
                })
            }
            Self::Insert(paths) => paths.iter().try_for_each(|path| path.check(scene.layout())),
            Self::Restyle(_) | Self::SetStates(_) => Ok(()),
        }
    }
}

impl Insertion {
    fn check(&self, layout: &Layout) -> Result<(), EditError> {
        let mut runs = self.runs.iter().peekable();
        if runs.peek().is_none() || !is_placed(runs.flatten().copied()) {
            return Err(EditError::Misplaced { path: None });
        }
        let parts = [
            ("level", self.level, layout.levels.len()),
            ("node", self.start_node, layout.nodes.len()),
            ("node", self.end_node, layout.nodes.len()),
        ];
        for (what, row, rows) in parts {
            if let Some(row) = row.filter(|row| *row as usize >= rows) {
                return Err(EditError::UnknownPart { what, row });
            }
        }
        let rows = layout.paths.len();
        match self.attributes_of.filter(|path| *path as usize >= rows) {
            Some(path) => Err(EditError::UnknownPath { path, rows }),
            None => Ok(()),
        }
    }
}

/// A row that is named more than once; rows in order, as selections have them, are only looked through.
fn named_twice(rows: &[u32]) -> Option<u32> {
    // Without a way out of the loop, many are compared at once.
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

fn is_placed(mut points: impl Iterator<Item = Point<f64>>) -> bool {
    points.all(|p| p.x.abs() <= REACH_M && p.y.abs() <= REACH_M)
}
