//! The scene: its queries and the state that edits change.

use std::sync::{Arc, OnceLock};

use guideway_layout::{Hulls, Layout};
use guideway_spline::Bounds;

use super::bounds::curve_bounds;
use super::census::StyleCensus;
use super::coloring::Coloring;
use super::draw_order::{draw_order, states};
use super::error::SceneError;
use super::level::visible_level;
use super::options::SceneOptions;
use super::path_state::PathState;
use crate::color::Rgba;
use crate::color_by::Legend;
use crate::table::Table;

/// A layout with every path's style resolved. Only [`Scene::edit`] changes its paths.
#[derive(Clone, Debug)]
pub struct Scene {
    pub(crate) layout: Arc<Layout>,
    pub(crate) coloring: Coloring,
    /// State per row; empty while all paths are shown.
    pub(crate) states: Vec<PathState>,
    pub(super) removed_count: usize,
    pub(super) shown_count: usize,
    /// Removed nodes and stations, by row; rows past the end exist.
    pub(super) removed_places: [Vec<bool>; 2],
    /// The only visible level; `None` shows all.
    pub(crate) level: Option<u32>,
    /// Computed on first use after a change.
    pub(super) draw_order: OnceLock<Vec<u32>>,
    /// Computed on first use, and kept up to date by edits of styles and states.
    pub(super) census: OnceLock<StyleCensus>,
    /// Computed on first use after a change.
    bounds: OnceLock<Option<Bounds<f64>>>,
}

/// A copy of a scene's shared layout, made in the background before an edit needs it. See
/// [`Scene::adopt_copy`].
#[derive(Debug)]
pub struct LayoutCopy {
    of: Arc<Layout>,
    copy: Arc<Layout>,
}

impl LayoutCopy {
    /// Copies a layout, in time proportional to its size.
    pub fn new(of: Arc<Layout>) -> Self {
        let copy = Arc::new(Layout::clone(&of));
        Self { of, copy }
    }
}

impl Scene {
    /// Resolves the styles of a layout.
    ///
    /// # Errors
    /// When the options name a level or a column that the layout does not have.
    pub fn new(layout: Arc<Layout>, options: &SceneOptions) -> Result<Self, SceneError> {
        let level = visible_level(&layout, options.level.as_deref())?;
        let states = states(&layout, level);
        let coloring = Coloring::of(&layout, options, &states)?;
        let draw_order = draw_order(&layout, &states, coloring.structure_below);
        Ok(Self {
            layout,
            coloring,
            states,
            removed_count: 0,
            shown_count: draw_order.len(),
            removed_places: [Vec::new(), Vec::new()],
            level,
            draw_order: draw_order.into(),
            census: OnceLock::new(),
            bounds: OnceLock::new(),
        })
    }

    /// Returns `true` if elements of a level are visible. Elements without a level belong to all.
    pub fn shows_level(&self, level: Option<u32>) -> bool {
        level.is_none() || self.level.is_none() || level == self.level
    }

    /// The layout.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The layout, shared with the caller.
    pub fn shared_layout(&self) -> Arc<Layout> {
        Arc::clone(&self.layout)
    }

    /// Returns `true` if other owners share the layout, so that the next edit copies it.
    pub fn is_layout_shared(&self) -> bool {
        Arc::strong_count(&self.layout) > 1
    }

    /// Replaces the shared layout by a copy that only this scene owns. A copy of another layout, or
    /// of an earlier state of this one, is dropped.
    pub fn adopt_copy(&mut self, copy: LayoutCopy) {
        if Arc::ptr_eq(&self.layout, &copy.of) {
            self.layout = copy.copy;
        }
    }

    /// Rows of the shown paths, lowest draw rank first. Computed on first use after a change of
    /// states, by all threads.
    pub fn draw_order(&self) -> &[u32] {
        let order = || draw_order(&self.layout, &self.states, self.coloring.structure_below);
        self.draw_order.get_or_init(order)
    }

    /// Number of shown paths.
    pub fn shown_count(&self) -> usize {
        self.shown_count
    }

    /// Number of path rows, including removed paths.
    pub fn row_count(&self) -> usize {
        self.layout.paths.len()
    }

    /// Number of paths of the layout: with refused ones, without removed ones.
    pub fn path_count(&self) -> usize {
        self.layout.path_count() - self.removed_count
    }

    /// Number of hidden paths.
    pub fn hidden_count(&self) -> usize {
        self.row_count() - self.removed_count - self.shown_count
    }

    /// Visibility of a path, by row.
    pub fn state(&self, path: u32) -> PathState {
        self.states.get(path as usize).copied().unwrap_or_default()
    }

    /// Returns `true` if an element is part of the layout: it has a row and is not removed.
    pub fn exists(&self, of: Table, row: u32) -> bool {
        let row = row as usize;
        let is_removed = match of {
            Table::Paths => self.states.get(row) == Some(&PathState::Removed),
            Table::Nodes => self.removed_places[0].get(row) == Some(&true),
            Table::Stations => self.removed_places[1].get(row) == Some(&true),
        };
        row < of.row_count(&self.layout) && !is_removed
    }

    /// Rows of the removed paths, nodes or stations, in increasing order.
    pub fn removed(&self, of: Table) -> impl Iterator<Item = u32> {
        let (states, places): (&[PathState], &[bool]) = match of {
            Table::Paths => (&self.states, &[]),
            Table::Nodes => (&[], &self.removed_places[0]),
            Table::Stations => (&[], &self.removed_places[1]),
        };
        let states = states.iter().map(|state| *state == PathState::Removed);
        let all = states.chain(places.iter().copied());
        let removed = (0..).zip(all).filter(|(_, is_removed)| *is_removed);
        removed.map(|(row, _)| row)
    }

    /// Removes and restores nodes or stations.
    pub(crate) fn set_exists(&mut self, of: Table, rows: &[(u32, bool)]) {
        let removed = match of {
            Table::Paths => return,
            Table::Nodes => &mut self.removed_places[0],
            Table::Stations => &mut self.removed_places[1],
        };
        for &(row, exists) in rows {
            let row = row as usize;
            if removed.len() <= row {
                removed.resize(row + 1, false);
            }
            removed[row] = !exists;
        }
    }

    /// The colors of all paths.
    pub fn coloring(&self) -> &Coloring {
        &self.coloring
    }

    /// Color of a path, by row.
    pub fn color(&self, path: u32) -> Rgba {
        self.coloring.color(path)
    }

    /// Meaning of the colors, if a column decides them.
    pub fn legend(&self) -> Option<&Legend> {
        self.coloring.legend.as_ref()
    }

    /// Color of a path when no column decides it.
    pub(crate) fn own_color(&self, path: u32) -> Rgba {
        self.coloring.own_color(&self.layout, path)
    }

    /// Returns `true` if a path is a wall or a door that is drawn below all ways of vehicles.
    pub fn is_below_ways(&self, path: u32) -> bool {
        self.coloring.is_below_ways(&self.layout, path)
    }

    /// The path's own width in meters, if it has one.
    pub fn width_m(&self, path: u32) -> Option<f32> {
        let width_m = *self.layout.paths.width_m()?.get(path as usize)?;
        (width_m.is_finite() && width_m >= 0.0).then_some(width_m)
    }

    /// Bounding box of all shown curves, in meters; `None` without curves. Computed on first use
    /// after a change.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        *self
            .bounds
            .get_or_init(|| curve_bounds(&self.layout, self.hulls(), self.draw_order()))
    }

    /// Bounding box of the control points of each path. Computed on first use after curves change.
    pub fn hulls(&self) -> &Hulls {
        self.layout.paths.geometry().hulls()
    }

    /// Drops the cached bounds; call after curves change.
    pub(crate) fn invalidate_bounds(&mut self) {
        self.bounds = OnceLock::new();
    }
}
