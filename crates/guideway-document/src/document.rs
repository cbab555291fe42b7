use std::sync::Arc;

use guideway_layout::Layout;
use guideway_scene::{Edit, LayoutCopy, LineRule, PathState, Scene, SceneError, SceneOptions};
use guideway_spline::{Bounds, Point};

use crate::edit::History;
use crate::edit_observer::EditObserver;
use crate::moved_nodes::MovedNodes;
use crate::{Hit, Index, JournalEntry, PathSet, pick};

/// A layout that is being looked at and edited: what is shown of it, what is selected, and what was done.
///
/// PathSet are those of the scene; see [`Edit`] for what becomes of them.
#[derive(Debug)]
pub struct Document {
    pub(crate) scene: Scene,
    pub(crate) index: Index,
    /// Shared with the steps that can be undone, for it stays the same through most of them.
    pub(crate) selection: Arc<PathSet>,
    /// Nodes that are not where the layout of the scene has them.
    pub(crate) moved_nodes: MovedNodes,
    pub(crate) history: History,
    pub(crate) observer: EditObserver,
    /// What was done since it was last taken, for a journal.
    pub(crate) acts: Vec<JournalEntry>,
    /// Changes with everything that can be seen.
    pub(crate) revision: u64,
}

/// What a selection does with the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SelectMode {
    /// It takes its place.
    #[default]
    Replace,
    /// It is added.
    Add,
    /// It is taken away.
    Remove,
}

impl Document {
    /// A document of a layout, in the colors that the options say.
    ///
    /// # Errors
    /// When the options name a level or a column that the layout has not.
    pub fn new(layout: Arc<Layout>, options: &SceneOptions) -> Result<Self, SceneError> {
        Ok(Self::from_scene(Scene::new(layout, options)?))
    }

    /// A document of a scene.
    pub fn from_scene(scene: Scene) -> Self {
        Self {
            index: Index::new(scene.layout()),
            scene,
            selection: Arc::default(),
            moved_nodes: MovedNodes::default(),
            history: History::default(),
            observer: EditObserver::default(),
            acts: Vec::new(),
            revision: 0,
        }
    }

    /// What is drawn.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The layout; nodes are where [`Self::node_position_m`] says.
    pub fn layout(&self) -> &Layout {
        self.scene.layout()
    }

    /// Where its paths are.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// Where a node is now.
    ///
    /// # Panics
    /// When there is no such node.
    pub fn node_position_m(&self, node: u32) -> Point<f64> {
        self.moved_nodes.node_position_m(self.layout(), node)
    }

    /// Where a station is: where the file says, or at the first node that serves it. It goes along if all of its nodes do.
    ///
    /// # Panics
    /// When there is no such station.
    pub fn station_position_m(&self, station: u32) -> Option<Point<f64>> {
        self.moved_nodes.station_position_m(self.layout(), station)
    }

    /// Tells of each edit of the scene from now on, in order, as soon as it is certain and before it is done here. A
    /// renderer that does them shows this scene.
    pub fn on_edit(&mut self, observer: impl Fn(&Edit) + Send + Sync + 'static) {
        self.observer = EditObserver::new(observer);
    }

    /// What was done since this was last asked, for a journal: see [`replay`](crate::replay).
    pub fn take_journal_entries(&mut self) -> Vec<JournalEntry> {
        std::mem::take(&mut self.acts)
    }

    /// A number that is another one after any change of what can be seen, the selection included.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Takes a copy of the layout that is its own: see [`Scene::adopt_copy`].
    pub fn adopt_copy(&mut self, copy: LayoutCopy) {
        self.scene.adopt_copy(copy);
    }

    /// Takes the colors of another scene of the same layout; false, and nothing is changed, if that is of another
    /// one: the layout was edited since.
    pub fn adopt_colors(&mut self, mut scene: Scene) -> bool {
        let old = &self.scene;
        if !Arc::ptr_eq(&old.shared_layout(), &scene.shared_layout()) {
            return false;
        }
        let rows = 0..old.row_count() as u32;
        let states = rows.map(|path| (path, old.state(path)));
        let not_shown: Arc<[_]> = states.filter(|(_, s)| *s != PathState::Shown).collect();
        if !not_shown.is_empty() {
            // It names rows of the scene itself.
            let _ = scene.edit(&Edit::SetStates(not_shown));
        }
        self.scene = scene;
        self.revision += 1;
        true
    }

    /// The path that a person points at: see [`pick`].
    pub fn pick(
        &self,
        rule: LineRule,
        px_per_m: f64,
        at_m: Point<f64>,
        reach_px: f64,
        most: usize,
    ) -> Option<Hit> {
        let place = (&self.scene, &self.index);
        pick(place, rule, px_per_m, at_m, reach_px, most)
    }

    /// PathSet of the selected paths.
    pub fn selection(&self) -> &PathSet {
        &self.selection
    }

    /// Selects paths; those that are not shown are left out.
    pub fn select(&mut self, paths: PathSet, how: SelectMode) {
        self.revision += 1;
        let shown: PathSet = paths
            .into_iter()
            .filter(|&path| self.is_shown(path))
            .collect();
        self.selection = Arc::new(match how {
            SelectMode::Replace => shown,
            SelectMode::Add => &*self.selection | shown,
            SelectMode::Remove => &*self.selection - shown,
        });
    }

    /// Selects the paths whose curve is inside a box or, if they may reach out of it, meets it.
    pub fn select_in(&mut self, bounds: Bounds<f64>, may_reach_out: bool, how: SelectMode) {
        let is_chosen = |&(path, of_path): &(u32, Bounds<f64>)| {
            let is_inside = bounds.contains(of_path.min) && bounds.contains(of_path.max);
            let path = self.layout().paths.get(path as usize);
            is_inside || (may_reach_out && meets(path, bounds))
        };
        let found = self.index.boxes_in(bounds).filter(is_chosen);
        let found = found.map(|(path, _)| path).collect();
        self.select(found, how);
    }

    /// Selects everything that is shown.
    pub fn select_all(&mut self) {
        self.revision += 1;
        self.selection = Arc::new(self.scene.draw_order().iter().copied().collect());
    }

    /// The box of the selected curves; none if nothing is selected.
    pub fn selection_bounds(&self) -> Option<Bounds<f64>> {
        let boxes = self
            .selection
            .iter()
            .filter_map(|path| self.index.path_bounds(path));
        boxes.reduce(Bounds::union)
    }

    /// The box of all curves that are shown; none if there are none.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        let shown = self.scene.draw_order().iter();
        let boxes = shown.filter_map(|&path| self.index.path_bounds(path));
        boxes.reduce(Bounds::union)
    }

    /// Hides the selected paths. It changes what is seen, not the layout, so it is not undone.
    pub fn hide_selection(&mut self) {
        let paths = std::mem::take(&mut self.selection);
        self.set_hidden(paths.iter(), PathState::Hidden);
    }

    /// Hides everything but the selected paths.
    pub fn isolate_selection(&mut self) {
        let all = self.scene.draw_order().iter().copied();
        let others: Vec<u32> = all.filter(|&path| !self.selection.contains(path)).collect();
        self.set_hidden(others.into_iter(), PathState::Hidden);
    }

    /// Shows only the paths of a level, or those of all.
    pub fn show_level(&mut self, level: Option<u32>) {
        self.show_all();
        if level.is_some() {
            let all = self.scene.draw_order().iter().copied();
            let is_elsewhere =
                |&path: &u32| self.layout().paths.get(path as usize).level() != level;
            let others: Vec<u32> = all.filter(is_elsewhere).collect();
            self.set_hidden(others.into_iter(), PathState::Hidden);
        }
        self.drop_hidden_from_selection();
    }

    /// Shows everything again.
    pub fn show_all(&mut self) {
        let rows = 0..self.scene.row_count() as u32;
        let hidden = rows.filter(|&path| self.scene.state(path) == PathState::Hidden);
        let hidden: Vec<u32> = hidden.collect();
        self.set_hidden(hidden.into_iter(), PathState::Shown);
    }

    fn set_hidden(&mut self, paths: impl Iterator<Item = u32>, state: PathState) {
        self.revision += 1;
        let states: Arc<[_]> = paths.map(|path| (path, state)).collect();
        let edit = Edit::SetStates(states);
        if edit.paths().next().is_some() {
            // It names rows of the scene itself.
            let _ = self
                .scene
                .edit_with_undo(&edit, |edit| self.observer.notify(edit));
        }
    }

    /// Only what is shown is selected.
    pub(crate) fn drop_hidden_from_selection(&mut self) {
        if !self.selection.iter().all(|path| self.is_shown(path)) {
            let selection = std::mem::take(&mut self.selection);
            let shown = selection.iter().filter(|&path| self.is_shown(path));
            self.selection = Arc::new(shown.collect());
        }
    }

    pub(crate) fn is_shown(&self, path: u32) -> bool {
        (path as usize) < self.scene.row_count() && self.scene.state(path) == PathState::Shown
    }
}

/// Whether a curve meets a box: some part of it that is small against the box, or inside of it, does.
fn meets(path: guideway_layout::PathRef<'_>, bounds: Bounds<f64>) -> bool {
    let mut parts: Vec<_> = path
        .runs()
        .flat_map(|run| run.segments())
        .map(|s| (s, 0))
        .collect();
    let size_m = bounds.size().norm();
    while let Some((part, halvings)) = parts.pop() {
        let part_bounds = Bounds::of_segment(&part);
        if !part_bounds.intersects(bounds) {
            continue;
        }
        let is_small = part_bounds.size().norm() <= size_m / 256.0;
        if is_small
            || halvings == 40
            || bounds.contains(part_bounds.min) && bounds.contains(part_bounds.max)
        {
            return true;
        }
        parts.extend(guideway_spline::uniform::halves(&part).map(|half| (half, halvings + 1)));
    }
    false
}
