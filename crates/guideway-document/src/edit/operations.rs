//! Edits of the selected paths, of nodes, and of new paths.

use std::sync::Arc;

use guideway_layout::{Direction, Layout, NewPath, PathRef};
use guideway_scene::{Edit, EditError, Insertion, PathState, Table};
use guideway_spline::{Affine, Point, Runs};

use super::curves::{curve_along, refined, runs_of, with_moved_ends};
use super::perform::set_states;
use super::points::reshape;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::index::nodes_of;

impl Document {
    /// Translates, rotates, mirrors or scales the selected paths. A node moves along if all of its
    /// paths are selected.
    ///
    /// # Errors
    /// When a path would exceed the coordinate limit; the document is unchanged.
    pub fn transform_selection(&mut self, name: &'static str, by: Affine) -> Result<(), EditError> {
        if self.selection.is_empty() {
            return Ok(());
        }
        let paths: Arc<[u32]> = self.selection.iter().collect();
        let nodes = self.nodes_of_only_selected_paths();
        let to = |node| (node, by.apply(self.node_position_m(node)));
        let nodes: Arc<[_]> = nodes.iter().map(to).collect();
        let mut changes = vec![Change::Scene(Edit::Transform { paths, by })];
        if !nodes.is_empty() {
            changes.push(Change::MoveNodes(nodes));
        }
        self.perform(name, changes)
    }

    /// Moves a node and the ends of its paths.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or when the node is unknown.
    pub fn move_node(&mut self, node: u32, to_m: Point<f64>) -> Result<(), EditError> {
        if !self.scene.exists(Table::Nodes, node) {
            return Err(EditError::UnknownReference {
                what: "node",
                row: node,
            });
        }
        let by = to_m - self.node_position_m(node);
        let zero = Point::new(0.0, 0.0);
        let shift = |end: Option<u32>| if end == Some(node) { by } else { zero };
        let mut paths = Vec::new();
        let mut curves = Vec::new();
        for row in self.existing_paths_at(node) {
            let path = self.layout().paths.get(row as usize);
            let (start_by, end_by) = (shift(path.start_node()), shift(path.end_node()));
            paths.push(row);
            curves.push(with_moved_ends(&runs_of(path), start_by, end_by));
        }
        let mut changes = vec![Change::MoveNodes([(node, to_m)].into())];
        if !paths.is_empty() {
            changes.push(reshape(paths, &curves));
        }
        self.perform("move node", changes)
    }

    /// Nearly doubles the control points of the selected paths without changing their curves.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn refine_selection(&mut self) -> Result<(), EditError> {
        let paths: Vec<u32> = self.selection.iter().collect();
        let curves: Vec<Runs> = self
            .selected_paths()
            .map(|path| refined(&runs_of(path)))
            .collect();
        if paths.is_empty() {
            return Ok(());
        }
        self.perform("refine", vec![reshape(paths, &curves)])
    }

    /// Removes the selected paths.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn delete_selection(&mut self) -> Result<(), EditError> {
        if self.selection.is_empty() {
            return Ok(());
        }
        let change = set_states(self.selection.iter(), PathState::Removed);
        self.perform("delete", vec![change])
    }

    /// Copies the selected paths `count` times, each copy `step_m` from the previous one, and
    /// selects the copies. They keep attributes and style, but connect to no node.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn copy_selection(&mut self, count: u32, step_m: Point<f64>) -> Result<(), EditError> {
        let first = self.scene.row_count() as u32;
        let mut copies = Vec::new();
        for number in 1..=count {
            let shift = step_m * f64::from(number);
            let selected = self.selected_paths();
            copies.extend(selected.map(|path| self.copy_of(path, shift, number)));
        }
        if copies.is_empty() {
            return Ok(());
        }
        let rows = first..first + copies.len() as u32;
        self.perform("copy", vec![Change::Scene(Edit::Insert(copies.into()))])?;
        self.selection = Arc::new(rows.collect());
        Ok(())
    }

    /// Adds and selects a path from the first to the last point that bends toward those between. An
    /// end within `node_reach_m` meters of a node connects to it.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or with fewer than two distinct points.
    pub fn draw_path(
        &mut self,
        id: String,
        points_m: &[Point<f64>],
        node_reach_m: f64,
    ) -> Result<(), EditError> {
        let runs = curve_along(points_m).ok_or(EditError::OutOfBounds { path: None })?;
        let node_at = |point: Option<&Point<f64>>| self.node_near(*point?, node_reach_m);
        let row = self.scene.row_count() as u32;
        let path = Insertion {
            id,
            runs,
            start_node: node_at(points_m.first()),
            end_node: node_at(points_m.last()),
            direction: Direction::Forward,
            ..Insertion::default()
        };
        self.perform(
            "draw path",
            vec![Change::Scene(Edit::Insert([path].into()))],
        )?;
        self.selection = Arc::new(PathSet::from_iter([row]));
        Ok(())
    }

    fn copy_of(&self, path: PathRef<'_>, shift: Point<f64>, number: u32) -> Insertion {
        let row = path.row();
        let paths = &self.layout().paths;
        let mut runs = Runs::default();
        for run in path.runs() {
            runs.push(&run.iter().map(|p| p + shift).collect::<Vec<_>>());
        }
        Insertion {
            id: format!("{} copy {number}", path.id()),
            runs,
            start_node: None,
            end_node: None,
            direction: path.direction(),
            level: path.level(),
            vehicle_types: paths.vehicle_types().of(row).map(str::to_owned).collect(),
            style: paths.own_style(row),
            attributes_of: Some(row as u32),
        }
    }

    /// Nodes whose paths are all selected.
    fn nodes_of_only_selected_paths(&self) -> PathSet {
        let nodes: PathSet = self.selected_paths().flat_map(nodes_of).collect();
        let are_all_selected = |&node: &u32| {
            let mut paths = self.existing_paths_at(node);
            paths.all(|path| self.selection.contains(path))
        };
        nodes.iter().filter(are_all_selected).collect()
    }

    /// Paths that start or end at a node, without removed ones.
    fn existing_paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        let exists = |&path: &u32| self.scene.state(path) != PathState::Removed;
        self.index.paths_at(node).filter(exists)
    }

    fn selected_paths(&self) -> impl Iterator<Item = PathRef<'_>> {
        let rows = self.selection.iter();
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
