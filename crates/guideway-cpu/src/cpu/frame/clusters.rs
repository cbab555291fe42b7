//! The prepared scene: clusters of paths, their cached lines, and the styles that decide how they
//! are drawn. Keeps all three up to date over edits.

use guideway_scene::cluster::{AppliedEdit, CLUSTER_LEN, ClusterIndex, ClusterOrder, PendingEdit};
use guideway_scene::{Rgba, Scene};
use guideway_spline::{Affine, Bounds};

use crate::cpu::flatten::line_cache::LineCache;
use crate::cpu::ground::frame_context::OwnWidths;
use crate::cpu::ground::scene_hulls::SceneHulls;

/// The clusters of a scene with all that outlasts a frame.
pub(crate) struct PreparedClusters {
    pub(crate) index: ClusterIndex,
    pub(crate) cache: LineCache,
    pub(crate) style: StyleSummary,
}

/// Styles of all drawn paths, as far as stages choose their work by them.
#[derive(Clone, Debug, Default)]
pub(crate) struct StyleSummary {
    /// Draw rank of each path; `None` if ranks are rows.
    pub(crate) ranks: Option<Vec<u32>>,
    pub(crate) own_widths: OwnWidths,
    /// The color of all paths, if it is one and opaque.
    pub(crate) solid: Option<Rgba>,
}

impl StyleSummary {
    pub(crate) fn of(scene: &Scene) -> Self {
        let order = scene.draw_order();
        let ranks = (!order.is_sorted()).then(|| {
            let mut ranks = vec![0; scene.row_count()];
            for (&path, rank) in order.iter().zip(0..) {
                ranks[path as usize] = rank;
            }
            ranks
        });
        Self {
            ranks,
            own_widths: own_widths(scene),
            solid: scene.common_color().filter(|color| color.is_opaque()),
        }
    }
}

/// Least and greatest own width of the drawn paths.
fn own_widths(scene: &Scene) -> OwnWidths {
    scene.layout().paths.width_m()?;
    let own = scene
        .draw_order()
        .iter()
        .filter_map(|&path| scene.width_m(path));
    own.map(|width_m| (width_m, width_m))
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
}

impl PreparedClusters {
    /// Sorts the paths of a scene into clusters. All threads share the work.
    pub(crate) fn new(scene: &Scene) -> Self {
        let hulls = scene.hulls();
        let center = |row: usize| hulls.of([row]).map(Bounds::center);
        let order = ClusterOrder::sorted(hulls.len(), hulls.all(), center);
        let scene_hulls = SceneHulls(scene);
        let index = ClusterIndex::new(order, |paths| scene_hulls.stored_hull(paths));
        let mut cache = LineCache::default();
        cache.grow(index.order().cluster_count());
        Self {
            index,
            cache,
            style: StyleSummary::of(scene),
        }
    }

    /// Heap bytes of a scene of `rows` paths, before any line is cached.
    pub(crate) fn planned_bytes(rows: usize) -> u64 {
        let cache = LineCache::planned_table_bytes(rows.div_ceil(CLUSTER_LEN));
        let ranks = rows * size_of::<u32>();
        (ClusterIndex::planned_bytes(rows) + ranks) as u64 + cache
    }

    /// Heap bytes held, without the cached lines.
    pub(crate) fn bytes(&self) -> u64 {
        let ranks = self.style.ranks.as_ref().map_or(0, Vec::capacity) * size_of::<u32>();
        (self.index.heap_bytes() + ranks) as u64 + self.cache.table_bytes()
    }

    /// Records where some paths are before their curves or states change.
    pub(crate) fn begin_edit(&self, scene: &Scene, paths: &[u32]) -> Vec<PendingEdit> {
        self.index.begin_edit(paths, &SceneHulls(scene))
    }

    /// Updates bounds and cached lines after paths have changed: by the map `by`, or in any way.
    /// Returns the boxes, in meters, where their clusters were and are.
    pub(crate) fn apply_edit(
        &mut self,
        scene: &Scene,
        pending: &[PendingEdit],
        by: Option<Affine>,
    ) -> Vec<Bounds<f64>> {
        let applied = self.index.apply_edit(pending, by, &SceneHulls(scene));
        let is_translation = by.and_then(Affine::as_translation).is_some();
        self.update_lines(scene, &applied, is_translation)
    }

    /// Appends the paths behind the last known one. Returns the boxes of their clusters, in meters.
    pub(crate) fn append(&mut self, scene: &Scene) -> Vec<Bounds<f64>> {
        let count = scene.row_count() - self.index.order().rows().len();
        let applied = self.index.append(count, &SceneHulls(scene));
        self.cache.grow(self.index.order().cluster_count());
        self.update_lines(scene, &applied, false)
    }

    /// Invalidates the lines of edited clusters. A cluster that was translated as a whole keeps
    /// them: they move with its origin, and drift by the rounding of its control points.
    fn update_lines(
        &mut self,
        scene: &Scene,
        applied: &[AppliedEdit],
        is_translation: bool,
    ) -> Vec<Bounds<f64>> {
        let geometry = scene.layout().paths.geometry();
        let mut changed = Vec::with_capacity(2 * applied.len());
        for edit in applied {
            changed.extend(edit.boxes());
            let state = &mut self.cache.states[edit.cluster as usize];
            match edit.after.filter(|_| is_translation && edit.is_whole) {
                Some(after) => state.drift_m += geometry.rounding_m(after.bounds),
                None => state.invalidate(),
            }
        }
        changed
    }

    /// The boxes, in meters, of the clusters of some paths.
    pub(crate) fn bounds_of(&self, paths: &[u32]) -> Vec<Bounds<f64>> {
        let clusters = self.index.order().members_by_cluster(paths).into_iter();
        let bounds = clusters.filter_map(|(cluster, _)| self.index.bounds()[cluster as usize]);
        bounds.map(|cluster| cluster.bounds).collect()
    }
}
