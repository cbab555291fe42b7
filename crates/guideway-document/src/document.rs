//! The document: a scene with its index, selection, undo history and observer.

use std::sync::Arc;

use guideway_layout::Layout;
use guideway_scene::{Coloring, LayoutCopy, LineRule, Scene, SceneError, SceneOptions};
use guideway_spline::{Bounds, Point};

use crate::PathSet;
use crate::edit_observer::{EditObserver, SceneChange};
use crate::elements::Elements;
use crate::history::{History, Preview};
use crate::index::Index;
use crate::journal::JournalEntry;
use crate::pick::{Hit, pick};

/// A layout under inspection and editing.
///
/// Rows are those of the scene and stable under edits; see
/// [`guideway_scene::Edit`].
#[derive(Debug)]
pub struct Document {
    pub(crate) scene: Scene,
    /// Shared until an edit changes it.
    pub(crate) index: Arc<Index>,
    /// Shared with the undo steps, most of which do not change it.
    pub(crate) selection: Arc<Elements>,
    /// The level on which elements are drawn; with `None` their nodes decide.
    pub(crate) level: Option<u32>,
    /// Rows of the levels that are not shown.
    pub(crate) hidden_levels: PathSet,
    pub(crate) history: History,
    pub(crate) observer: EditObserver,
    /// Entries since the last [`Document::take_journal_entries`].
    pub(crate) journal_entries: Vec<JournalEntry>,
    /// Incremented by every visible change.
    pub(crate) revision: u64,
    /// Incremented by every change of values.
    pub(crate) values_revision: u64,
    /// An edit that is shown, but does not count.
    pub(crate) preview: Option<Preview>,
}

impl Document {
    /// A document of a layout, with the colors that the options select.
    ///
    /// # Errors
    /// When the options name a level or a column that the layout does not have.
    pub fn new(layout: Arc<Layout>, options: &SceneOptions) -> Result<Self, SceneError> {
        Ok(Self::from_scene(Scene::new(layout, options)?))
    }

    /// A document of a scene.
    pub fn from_scene(scene: Scene) -> Self {
        let index = Arc::new(Index::of_scene(&scene));
        Self::with_index(scene, index)
    }

    /// A document of a scene without edits, with the index of its layout: an index serves many
    /// documents, and takes longer than all else of a document.
    pub fn with_index(scene: Scene, index: Arc<Index>) -> Self {
        Self {
            scene,
            index,
            selection: Arc::default(),
            level: None,
            hidden_levels: PathSet::new(),
            history: History::default(),
            observer: EditObserver::default(),
            journal_entries: Vec::new(),
            revision: 0,
            values_revision: 0,
            preview: None,
        }
    }

    /// The scene to draw.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The layout, with the rows of removed elements; see [`Scene::exists`].
    pub fn layout(&self) -> &Layout {
        self.scene.layout()
    }

    /// The level on which elements are drawn; with `None` their nodes decide. See
    /// [`Self::show_level`].
    pub fn level(&self) -> Option<u32> {
        self.level
    }

    /// Returns `true` if elements of a level are shown. Elements without a level belong to all.
    pub fn shows_level(&self, level: Option<u32>) -> bool {
        let is_here = level.is_none_or(|level| !self.hidden_levels.contains(level));
        is_here && self.scene.shows_level(level)
    }

    /// The spatial index of paths and nodes.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// Position of a node, in meters.
    ///
    /// # Panics
    /// When the node is unknown.
    pub fn node_position_m(&self, node: u32) -> Point<f64> {
        self.layout().nodes.position_m(node)
    }

    /// Position of a station, in meters: its own, or that of its first node. `None` without either.
    ///
    /// # Panics
    /// When the station is unknown.
    pub fn station_position_m(&self, station: u32) -> Option<Point<f64>> {
        self.layout().station_position_m(station)
    }

    /// Sets the observer of the scene. It is called in order, once per edit, after the edit is
    /// accepted and before it is applied here. A renderer that applies them shows this scene.
    pub fn on_edit(&mut self, observer: impl Fn(SceneChange<'_>) + Send + Sync + 'static) {
        self.observer = EditObserver::new(observer);
    }

    /// Returns the journal entries since the last call. See [`replay`](crate::replay).
    pub fn take_journal_entries(&mut self) -> Vec<JournalEntry> {
        std::mem::take(&mut self.journal_entries)
    }

    /// A number that differs after every visible change, including changes of the selection.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// A number that differs after every change of properties, which may change the colors of a
    /// scene that a column colors.
    pub fn values_revision(&self) -> u64 {
        self.values_revision
    }

    /// Replaces the shared layout by an unshared copy. See [`Scene::adopt_copy`].
    pub fn adopt_copy(&mut self, copy: LayoutCopy) {
        self.scene.adopt_copy(copy);
    }

    /// Takes the colors of a layout. Returns false, and changes nothing, if this one was edited
    /// since.
    pub fn recolor(&mut self, layout: &Arc<Layout>, coloring: &Coloring) -> bool {
        let is_same = Arc::ptr_eq(&self.scene.shared_layout(), layout);
        if is_same {
            self.scene.recolor(coloring);
            self.revision += 1;
        }
        is_same
    }

    /// The path under the pointer. See [`pick`].
    pub fn pick(
        &self,
        rule: LineRule,
        px_per_m: f64,
        at_m: Point<f64>,
        reach_px: f64,
        max_candidates: usize,
    ) -> Option<Hit> {
        let place = (&self.scene, &*self.index);
        pick(place, rule, px_per_m, at_m, reach_px, max_candidates)
    }

    /// Bounding box of all shown curves, in meters; `None` without curves.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        let shown = self.scene.draw_order().iter();
        let boxes = shown.filter_map(|&path| self.index.path_bounds(path));
        boxes.reduce(Bounds::union)
    }
}
