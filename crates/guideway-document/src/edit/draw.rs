//! Refines the selected paths, and draws new ones.

use std::sync::Arc;

use guideway_layout::{Direction, Layout, NewPath, PathRef};
use guideway_scene::{Edit, EditError, Insertion};
use guideway_spline::{Point, Runs};

use super::curves::{curve_along, refined, runs_of};
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

impl Document {
    /// Nearly doubles the control points of the selected paths without changing their curves.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn refine_selection(&mut self) -> Result<(), EditError> {
        let paths: Vec<u32> = self.selection.paths.iter().collect();
        let curves: Vec<Runs> = self
            .selected_paths()
            .map(|path| refined(&runs_of(path)))
            .collect();
        if paths.is_empty() {
            return Ok(());
        }
        self.perform("refine", self.reshape(paths, &curves))
    }

    /// Adds and selects a path from the first to the last point that bends toward those between. An
    /// end within `node_reach_m` meters of a node moves onto it and connects to it.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or with fewer than two distinct points.
    pub fn draw_path(
        &mut self,
        id: String,
        points_m: &[Point<f64>],
        node_reach_m: f64,
    ) -> Result<(), EditError> {
        let node_at = |point: Option<&Point<f64>>| self.node_near(*point?, node_reach_m);
        let (start_node, end_node) = (node_at(points_m.first()), node_at(points_m.last()));
        let mut points_m = points_m.to_vec();
        if let (Some(start), Some(node)) = (points_m.first_mut(), start_node) {
            *start = self.node_position_m(node);
        }
        if let (Some(end), Some(node)) = (points_m.last_mut(), end_node) {
            *end = self.node_position_m(node);
        }
        let runs = curve_along(&points_m).ok_or(EditError::OutOfBounds { path: None })?;
        let row = self.scene.row_count() as u32;
        let path = Insertion {
            id,
            runs,
            start_node,
            end_node,
            direction: Direction::Forward,
            ..Insertion::default()
        };
        self.perform(
            "draw path",
            vec![Change::Scene(Edit::Insert([path].into()))],
        )?;
        self.selection = Arc::new(Elements::of_paths([row]));
        Ok(())
    }

    fn selected_paths(&self) -> impl Iterator<Item = PathRef<'_>> {
        let rows = self.selection.paths.iter();
        rows.map(|path| self.layout().paths.get(path as usize))
    }
}

/// A layout with only the path that [`Document::draw_path`] would add for these points; `None` if
/// it would reject them.
pub fn drawn_path(points_m: &[Point<f64>]) -> Option<Layout> {
    let mut layout = Layout::default();
    layout.paths.push(&NewPath {
        runs: &curve_along(points_m)?,
        ..NewPath::default()
    });
    Some(layout)
}
