use std::sync::Arc;

use guideway_layout::{Direction, Layout, NewPath, PathRef};
use guideway_scene::{Edit, EditError, Insertion, PathState};
use guideway_spline::{Affine, Point, Runs};

use super::Change;
use super::shape::{geometry_of, refined, runs_of, through_ends, with_ends_moved, with_run};
use crate::index::nodes_of;
use crate::{Document, PathSet};

/// A control point of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointRef {
    /// Row of the path.
    pub path: u32,
    /// Which of its runs.
    pub run: usize,
    /// Which point of the run.
    pub point: usize,
}

impl Document {
    /// Moves, turns, mirrors or scales the selected paths. A node goes with them if all of its paths do;
    /// otherwise it stays, and the paths leave it.
    ///
    /// # Errors
    /// When a path would leave what a layout may reach; so for all of these. Nothing is changed then.
    pub fn transform_selection(&mut self, name: &'static str, by: Affine) -> Result<(), EditError> {
        if self.selection.is_empty() {
            return Ok(());
        }
        let paths: Arc<[u32]> = self.selection.iter().collect();
        let nodes = self.nodes_of_selection_alone();
        let to = |node| (node, by.apply(self.node_position_m(node)));
        let nodes: Arc<[_]> = nodes.iter().map(to).collect();
        let mut changes = vec![Change::Scene(Edit::Transform { paths, by })];
        if !nodes.is_empty() {
            changes.push(Change::MoveNodes(nodes));
        }
        self.perform(name, changes)
    }

    /// Moves a node; the ends of its paths follow.
    ///
    /// # Errors
    /// As [`Self::transform_selection`], or when there is no such node.
    pub fn move_node(&mut self, node: u32, to_m: Point<f64>) -> Result<(), EditError> {
        let rows = self.layout().nodes.len();
        if node as usize >= rows {
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
            curves.push(with_ends_moved(&runs_of(path), start_by, end_by));
        }
        let mut changes = vec![Change::MoveNodes([(node, to_m)].into())];
        if !paths.is_empty() {
            changes.push(reshape(paths, &curves));
        }
        self.perform("move node", changes)
    }

    /// Moves a control point.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn move_point(&mut self, point: PointRef, to_m: Point<f64>) -> Result<(), EditError> {
        self.reshape_run("move point", point, |points| {
            points.get_mut(point.point).is_some_and(|p| {
                *p = to_m;
                true
            })
        })
    }

    /// Puts another control point behind one, halfway to the next. The curve changes a little near by.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
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

    /// Takes a control point away, if more than four are there.
    ///
    /// # Errors
    /// As [`Self::transform_selection`].
    pub fn remove_point(&mut self, point: PointRef) -> Result<(), EditError> {
        self.reshape_run("remove point", point, |points| {
            let is_there = point.point < points.len();
            if is_there {
                points.remove(point.point);
            }
            is_there
        })
    }

    /// Gives the selected paths nearly twice as many control points; their curves stay the same.
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
        let change = Self::states_of(self.selection.iter(), PathState::Removed);
        self.perform("delete", vec![change])
    }

    /// Copies the selected paths `count` times, each `step_m` from the last one, and selects the copies. They
    /// keep attributes and looks, and belong to no node.
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

    /// Adds a path that begins and ends at the first and the last point and bends toward those between, and
    /// selects it. Ends within `node_reach_m` of a node belong to it.
    ///
    /// # Errors
    /// As [`Self::transform_selection`]; and when the points are fewer than two different ones.
    pub fn draw_path(
        &mut self,
        id: String,
        points_m: &[Point<f64>],
        node_reach_m: f64,
    ) -> Result<(), EditError> {
        let runs = through_ends(points_m).ok_or(EditError::OutOfBounds { path: None })?;
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
        match with_run(&old, point.run, change) {
            Some(runs) => self.perform(name, vec![reshape(vec![point.path], &[runs])]),
            None => Ok(()),
        }
    }

    /// Nodes of which all paths are selected.
    fn nodes_of_selection_alone(&self) -> PathSet {
        let nodes: PathSet = self.selected_paths().flat_map(nodes_of).collect();
        let is_alone = |&node: &u32| {
            let mut paths = self.existing_paths_at(node);
            paths.all(|path| self.selection.contains(path))
        };
        nodes.iter().filter(is_alone).collect()
    }

    /// Paths that begin or end at a node, but the removed ones.
    fn existing_paths_at(&self, node: u32) -> impl Iterator<Item = u32> {
        let is_there = |&path: &u32| self.scene.state(path) != PathState::Removed;
        self.index.paths_at(node).filter(is_there)
    }

    fn selected_paths(&self) -> impl Iterator<Item = PathRef<'_>> {
        let rows = self.selection.iter();
        rows.map(|path| self.layout().paths.get(path as usize))
    }
}

fn reshape(paths: Vec<u32>, curves: &[Runs]) -> Change {
    Change::Scene(Edit::Reshape {
        paths: paths.into(),
        curves: Arc::new(geometry_of(curves)),
    })
}

/// A layout of nothing but the path that [`Document::draw_path`] makes of these points; none where it makes none.
pub fn drawn_path(points_m: &[Point<f64>]) -> Option<Layout> {
    let mut layout = Layout::default();
    layout.paths.push(&NewPath {
        runs: &through_ends(points_m)?,
        ..NewPath::default()
    });
    Some(layout)
}
