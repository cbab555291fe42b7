//! Changes of a scene. Each costs as much as it touches, but for one pass over a number a path where the draw
//! order changes.

mod check;

use std::fmt;
use std::sync::Arc;

use guideway_layout::{Direction, Geometry, NewPath, OwnStyle};
use guideway_spline::{Affine, Runs};

use crate::scene::Colors;
use crate::{PathState, Rgba, Scene};

/// A change of a scene. Rows stay what they are: a removed path keeps its row, an inserted one gets a new one.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Maps the curves of paths: moves, turns, mirrors or scales them.
    Transform {
        /// Rows of paths, each once.
        paths: Arc<[u32]>,
        /// Where each of their points goes.
        by: Affine,
    },
    /// Gives paths other curves. Costs least where the numbers of control points stay.
    Reshape {
        /// Rows of paths.
        paths: Arc<[u32]>,
        /// Their new curves, in the same order.
        curves: Arc<Geometry>,
    },
    /// Gives paths another width and color of their own. A scene colored by a column keeps its colors.
    Restyle(Arc<[(u32, OwnStyle)]>),
    /// Shows, hides, removes or brings back paths.
    SetStates(Arc<[(u32, PathState)]>),
    /// Adds paths behind the last row, drawn above all others of their rank.
    Insert(Arc<[Insertion]>),
}

/// A path to be added.
#[derive(Clone, Debug, Default)]
pub struct Insertion {
    /// Identifier.
    pub id: String,
    /// The curve, in meters.
    pub runs: Runs,
    /// Row of the node where it begins.
    pub start_node: Option<u32>,
    /// Row of the node where it ends.
    pub end_node: Option<u32>,
    /// Which way vehicles go.
    pub direction: Direction,
    /// Index in [`guideway_layout::Layout::levels`].
    pub level: Option<u32>,
    /// Vehicle types that may use it; none means all.
    pub vehicle_types: Vec<String>,
    /// Width and color of its own.
    pub style: OwnStyle,
    /// Row of the path whose attributes it gets; none if it has none.
    pub attributes_of: Option<u32>,
}

/// Why an edit cannot be done. The scene is then as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EditError {
    /// There is no such row.
    UnknownPath {
        /// The row asked for.
        path: u32,
        /// Number of rows.
        rows: usize,
    },
    /// A curve would have a point that is not finite, or too far away to be one of a layout.
    Misplaced {
        /// The path, or none where it is not a path of the scene yet.
        path: Option<u32>,
    },
    /// There is no such level or node.
    UnknownPart {
        /// `level` or `node`.
        what: &'static str,
        /// The row asked for.
        row: u32,
    },
    /// An edit brings as many curves as it names paths.
    Count,
    /// A path that is moved is named once.
    Twice {
        /// The row that is named again.
        path: u32,
    },
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownPath { path, rows } => {
                write!(f, "there is no path in row {path}: there are {rows} rows")
            }
            Self::Misplaced { path: Some(path) } => {
                write!(
                    f,
                    "the path in row {path} would leave what a layout may reach"
                )
            }
            Self::Misplaced { path: None } => {
                write!(f, "a new path lies outside of what a layout may reach")
            }
            Self::UnknownPart { what, row } => write!(f, "there is no {what} in row {row}"),
            Self::Count => write!(f, "there are not as many curves as paths"),
            Self::Twice { path } => write!(f, "the path in row {path} is named twice"),
        }
    }
}

impl std::error::Error for EditError {}

impl Edit {
    /// Rows of existing paths that it changes.
    pub fn paths(&self) -> impl Iterator<Item = u32> {
        let (paths, styles, states): (&[u32], &[_], &[_]) = match self {
            Self::Transform { paths, .. } | Self::Reshape { paths, .. } => (paths, &[], &[]),
            Self::Restyle(styles) => (&[], styles, &[]),
            Self::SetStates(states) => (&[], &[], states),
            Self::Insert(_) => (&[], &[], &[]),
        };
        let styled = styles.iter().map(|(path, _)| *path);
        let set = states.iter().map(|(path, _)| *path);
        paths.iter().copied().chain(styled).chain(set)
    }

    /// Heap bytes held; clones share them.
    pub fn heap_bytes(&self) -> usize {
        match self {
            Self::Transform { paths, .. } => size_of_val(&**paths),
            Self::Reshape { paths, curves } => size_of_val(&**paths) + curves.heap_bytes(),
            Self::Restyle(styles) => size_of_val(&**styles),
            Self::SetStates(states) => size_of_val(&**states),
            Self::Insert(paths) => {
                let all = paths.iter().map(Insertion::heap_bytes).sum::<usize>();
                size_of_val(&**paths) + all
            }
        }
    }
}

impl Insertion {
    fn heap_bytes(&self) -> usize {
        let points: usize = self.runs.iter().map(size_of_val).sum();
        let types: usize = self.vehicle_types.iter().map(String::capacity).sum();
        self.id.capacity() + points + types
    }
}

impl Scene {
    /// Changes the scene. The layout is copied first if others hold it.
    ///
    /// # Errors
    /// When the edit names what is not there, or would put a path where none may be; nothing is changed then.
    pub fn edit(&mut self, edit: &Edit) -> Result<(), EditError> {
        edit.check(self)?;
        self.perform(edit);
        Ok(())
    }

    /// The same, and returns what undoes it, which holds as much as the edit changes. `tell` is called as soon as
    /// nothing can keep the edit from being done, before most of the work for it.
    ///
    /// # Errors
    /// As [`Self::edit`].
    pub fn edit_and_tell(
        &mut self,
        edit: &Edit,
        tell: impl FnOnce(&Edit),
    ) -> Result<Edit, EditError> {
        edit.check(self)?;
        if !matches!(edit, Edit::SetStates(_)) {
            // Whoever is told and held the layout too has it alone then, and need not copy it as well.
            Arc::make_mut(&mut self.layout);
        }
        tell(edit);
        let undo = self.undo_of(edit);
        self.perform(edit);
        Ok(undo)
    }

    /// What undoes an edit that is still to be done.
    fn undo_of(&self, edit: &Edit) -> Edit {
        match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => {
                let rows = paths.iter().map(|&path| path as usize);
                Edit::Reshape {
                    paths: Arc::clone(paths),
                    curves: Arc::new(self.layout.paths.geometry().select(rows)),
                }
            }
            Edit::Restyle(styles) => {
                let own_style = |path: u32| self.layout.paths.own_style(path as usize);
                Edit::Restyle(
                    styles
                        .iter()
                        .map(|&(path, _)| (path, own_style(path)))
                        .collect(),
                )
            }
            Edit::SetStates(states) => {
                let before = states.iter().map(|&(path, _)| (path, self.state(path)));
                Edit::SetStates(before.collect())
            }
            Edit::Insert(paths) => {
                let first = self.row_count() as u32;
                let rows = first..first + paths.len() as u32;
                Edit::SetStates(rows.map(|path| (path, PathState::Removed)).collect())
            }
        }
    }

    /// Does an edit that can be done.
    fn perform(&mut self, edit: &Edit) {
        match edit {
            Edit::Transform { paths, by } => {
                let layout = Arc::make_mut(&mut self.layout);
                let rows = paths.iter().map(|&path| path as usize);
                layout.paths.transform(rows, *by);
                self.forget_bounds();
            }
            Edit::Reshape { paths, curves } => {
                let layout = Arc::make_mut(&mut self.layout);
                layout.paths.replace_curves(paths, curves);
                self.forget_bounds();
            }
            Edit::Restyle(styles) => self.restyle(styles),
            Edit::SetStates(states) => self.set_states(states),
            Edit::Insert(paths) => self.insert(paths),
        }
    }

    fn restyle(&mut self, styles: &[(u32, OwnStyle)]) {
        let layout = Arc::make_mut(&mut self.layout);
        for &(path, style) in styles {
            layout.paths.set_own_style(path as usize, style);
        }
        if self.legend().is_none() {
            for &(path, _) in styles {
                self.set_color(path, self.own_color(path));
            }
        }
    }

    fn set_color(&mut self, path: u32, color: Rgba) {
        let rows = self.row_count();
        match &mut self.colors {
            Colors::One(one) if *one == color => {}
            Colors::One(one) => {
                let mut colors = vec![*one; rows];
                colors[path as usize] = color;
                self.colors = Colors::Each(colors);
            }
            Colors::Each(colors) => colors[path as usize] = color,
        }
    }

    fn set_states(&mut self, states: &[(u32, PathState)]) {
        self.states.resize(self.row_count(), PathState::Shown);
        for &(path, state) in states {
            self.states[path as usize] = state;
        }
        self.order_anew();
    }

    fn insert(&mut self, paths: &[Insertion]) {
        let first = self.row_count() as u32;
        let layout = Arc::make_mut(&mut self.layout);
        for path in paths {
            let vehicle_types: Vec<&str> = path.vehicle_types.iter().map(String::as_str).collect();
            let row = layout.paths.push(&NewPath {
                id: &path.id,
                runs: &path.runs,
                start_node: path.start_node,
                end_node: path.end_node,
                direction: path.direction,
                level: path.level,
                vehicle_types: &vehicle_types,
            });
            layout.paths.set_own_style(row, path.style);
            if let Some(from) = path.attributes_of {
                layout.paths.attributes.copy_row(from as usize, row);
            }
        }
        let rows = self.row_count();
        if let Colors::Each(colors) = &mut self.colors {
            colors.resize(rows, Rgba::BLACK);
        }
        for (row, path) in (first..).zip(paths) {
            // What decides the colors decides them of a copy as well.
            let color = match path.attributes_of.filter(|_| self.legend().is_some()) {
                Some(from) => self.color(from),
                None => self.own_color(row),
            };
            self.set_color(row, color);
        }
        if !self.states.is_empty() {
            self.states.resize(rows, PathState::Shown);
        }
        self.order_anew();
    }
}
