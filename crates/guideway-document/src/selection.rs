//! Selection and visibility: select by rows or box; hide, isolate and show paths.

use std::sync::Arc;

use guideway_layout::PathRef;
use guideway_scene::{Edit, PathState, Table};
use guideway_spline::{Bounds, uniform};

use crate::PathSet;
use crate::document::Document;
use crate::elements::Elements;
use crate::select_mode::SelectMode;

impl Document {
    /// Rows of the selected paths.
    pub fn selection(&self) -> &PathSet {
        &self.selection.paths
    }

    /// Rows of everything that is selected.
    pub fn selected(&self) -> &Elements {
        &self.selection
    }

    /// Selects paths; paths that are not shown are ignored.
    pub fn select(&mut self, paths: PathSet, mode: SelectMode) {
        self.select_elements(&Elements::of_paths(paths), mode);
    }

    /// Selects elements, levels and vehicle types. Elements that are not shown are ignored.
    pub fn select_elements(&mut self, elements: &Elements, mode: SelectMode) {
        self.revision += 1;
        let shown = self.shown_of(elements);
        self.selection = Arc::new(self.selection.combined(shown, mode));
    }

    /// Selects what is inside a box in meters, and paths that cross its border if `crossing` is
    /// set. Nodes at which other paths end are left out, unless the box has no path at all:
    /// deleting a part of a network must not take the rest along.
    pub fn select_in(&mut self, bounds: Bounds<f64>, crossing: bool, mode: SelectMode) {
        let is_chosen = |&(path, of_path): &(u32, Bounds<f64>)| {
            let is_inside = bounds.contains(of_path.min) && bounds.contains(of_path.max);
            let path = self.layout().paths.get(path as usize);
            is_inside || (crossing && intersects(path, bounds))
        };
        let found = self.index.boxes_in(bounds).filter(is_chosen);
        let paths: PathSet = found.map(|(path, _)| path).collect();
        let ends_only = |node: &u32| paths.is_empty() || self.has_only(*node, &paths);
        let nodes = self.index.nodes_in(bounds).filter(ends_only).collect();
        let is_inside = |row: &u32| {
            let at_m = self.station_position_m(*row);
            at_m.is_some_and(|at_m| bounds.contains(at_m))
        };
        let stations = self.existing(Table::Stations).filter(is_inside).collect();
        let found = Elements {
            paths,
            nodes,
            stations,
            ..Elements::default()
        };
        self.select_elements(&found, mode);
    }

    /// Selects all that is shown, but for nodes at which hidden paths end.
    pub fn select_all(&mut self) {
        let paths: PathSet = self.scene.draw_order().iter().copied().collect();
        let ends_only = |node: &u32| self.has_only(*node, &paths);
        let all = Elements {
            nodes: self.existing(Table::Nodes).filter(ends_only).collect(),
            stations: self.existing(Table::Stations).collect(),
            paths,
            ..Elements::default()
        };
        self.select_elements(&all, SelectMode::Replace);
    }

    /// Bounding box of what is selected, in meters; `None` without a selection.
    pub fn selection_bounds(&self) -> Option<Bounds<f64>> {
        self.bounds_of_all(&self.selection)
    }

    /// Hides the selected paths and levels. Visibility is not part of the undo history.
    pub fn hide_selection(&mut self) {
        let selection = std::mem::take(&mut self.selection);
        for level in &selection.levels {
            self.set_level_shown(level, false);
        }
        self.set_visibility(selection.paths.iter(), PathState::Hidden);
    }

    /// Hides all but the selected paths.
    pub fn isolate_selection(&mut self) {
        let all = self.scene.draw_order().iter().copied();
        let others: Vec<u32> = all
            .filter(|&path| !self.selection.paths.contains(path))
            .collect();
        self.set_visibility(others.into_iter(), PathState::Hidden);
    }

    /// Shows only what is on a level or on none, and draws there; `None` shows all levels. Shows
    /// the hidden paths of the level too.
    pub fn show_level(&mut self, level: Option<u32>) {
        self.level = level;
        let all = 0..self.layout().levels.len() as u32;
        let others = all.filter(|row| level.is_some_and(|level| level != *row));
        self.hidden_levels = others.collect();
        self.apply_levels();
    }

    /// Shows or hides a level beside others. Elements are drawn on a shown level: on the first one,
    /// if theirs is hidden.
    pub fn set_level_shown(&mut self, level: u32, is_shown: bool) {
        match is_shown {
            true => self.hidden_levels.remove(level),
            false => self.hidden_levels.insert(level),
        };
        let hidden = &self.hidden_levels;
        let is_drawn = self.level.is_some_and(|level| !hidden.contains(level));
        if !is_drawn && !hidden.is_empty() {
            let mut all = 0..self.layout().levels.len() as u32;
            self.level = all.find(|row| !hidden.contains(*row));
        }
        self.apply_levels();
    }

    /// Hides what is no longer on a shown level, and shows what is.
    pub fn apply_levels(&mut self) {
        self.show_all();
        self.deselect_hidden();
    }

    /// Shows all hidden paths of the shown levels.
    pub fn show_all(&mut self) {
        let mut states: [Vec<u32>; 2] = Default::default();
        for row in self.existing(Table::Paths) {
            let is_here = self.shows_level(self.layout().paths.get(row as usize).level());
            let wanted = if is_here {
                PathState::Shown
            } else {
                PathState::Hidden
            };
            if self.scene.state(row) != wanted {
                states[usize::from(is_here)].push(row);
            }
        }
        let [hidden, shown] = states;
        self.set_visibility(hidden.into_iter(), PathState::Hidden);
        self.set_visibility(shown.into_iter(), PathState::Shown);
    }

    fn set_visibility(&mut self, paths: impl Iterator<Item = u32>, state: PathState) {
        self.revision += 1;
        let states: Arc<[_]> = paths.map(|path| (path, state)).collect();
        if !states.is_empty() {
            // Cannot fail: all rows exist.
            let _ = self
                .scene
                .edit_with_undo(&Edit::SetStates(states), |edit| self.observer.notify(edit));
        }
    }

    /// Removes what is not shown from the selection.
    pub(crate) fn deselect_hidden(&mut self) {
        let is_shown = |of| {
            let mut rows = self.selection.rows(of).iter();
            rows.all(|row| self.is_shown(of, row))
        };
        let mut groups = self.selection.groups();
        if !(Table::ALL.into_iter().all(is_shown) && groups.all(|g| self.contains_group(&g))) {
            drop(groups);
            self.selection = Arc::new(self.shown_of(&self.selection));
        }
    }

    /// The elements that are shown, and the levels and vehicle types that exist.
    fn shown_of(&self, all: &Elements) -> Elements {
        let rows = |of: Table| -> PathSet {
            let rows = all.rows(of).iter();
            rows.filter(|&row| self.is_shown(of, row)).collect()
        };
        let [paths, nodes, stations] = Table::ALL.map(rows);
        let mut shown = Elements {
            paths,
            nodes,
            stations,
            ..Elements::default()
        };
        for group in all.groups().filter(|group| self.contains_group(group)) {
            shown.insert_group(group);
        }
        shown
    }

    /// Returns `true` if a path is shown, or a node or station exists on a level that is shown.
    fn is_shown(&self, of: Table, row: u32) -> bool {
        let exists = (row as usize) < of.row_count(self.layout()) && self.scene.exists(of, row);
        exists
            && match of {
                Table::Paths => self.scene.state(row) == PathState::Shown,
                Table::Nodes | Table::Stations => self.shows_level(of.level(self.layout(), row)),
            }
    }
}

/// Returns `true` if a curve intersects a box. Halves segments until the box of a part lies inside
/// the selection box, or is small against it.
fn intersects(path: PathRef<'_>, bounds: Bounds<f64>) -> bool {
    /// Bisection depth at which a part counts as a point: below the resolution of `f64`.
    const MAX_HALVINGS: u32 = 40;
    let mut parts: Vec<_> = path
        .runs()
        .flat_map(|run| run.segments())
        .map(|segment| (segment, 0))
        .collect();
    let size_m = bounds.size().norm();
    while let Some((part, halvings)) = parts.pop() {
        let part_bounds = Bounds::of_segment(&part);
        if !part_bounds.intersects(bounds) {
            continue;
        }
        let is_small = part_bounds.size().norm() <= size_m / 256.0;
        if is_small
            || halvings == MAX_HALVINGS
            || bounds.contains(part_bounds.min) && bounds.contains(part_bounds.max)
        {
            return true;
        }
        parts.extend(uniform::halves(&part).map(|half| (half, halvings + 1)));
    }
    false
}
