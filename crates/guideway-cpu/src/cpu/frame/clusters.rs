//! The prepared scene: clusters of paths, their cached lines, and the styles that decide how they
//! are drawn. Keeps all three up to date over edits.

use guideway_scene::cluster::{
    AppliedEdit, CLUSTER_LEN, ClusterIndex, ClusterOrder, Members, PendingEdit, RowHulls,
};
use guideway_scene::{Cancel, GesturePaths, PathState, Rgba, Scene, Shading, Strip, Style};
use guideway_spline::{Affine, Bounds, Point};
use rayon::prelude::*;

use crate::cpu::flatten::line_cache::LineCache;
use crate::cpu::ground::frame_context::{FrameContext, OwnWidths};
use crate::cpu::ground::gesture::ShownGesture;
use crate::cpu::ground::scene_hulls::SceneHulls;
use crate::cpu::ground::simd::SimdLevel;
use crate::cpu::ground::snapped_view::SnappedTransform;

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
        let ranks = (!scene.draws_by_rows()).then(|| {
            let mut ranks = vec![0; scene.row_count()];
            for (&path, rank) in scene.draw_order().iter().zip(0..) {
                ranks[path as usize] = rank;
            }
            ranks
        });
        Self {
            ranks,
            own_widths: scene.own_widths_m(),
            solid: scene.common_color().filter(|color| color.is_opaque()),
        }
    }

    /// A strip of the scene, with the gesture that is shown, as one frame draws it.
    pub(crate) fn frame_context<'a>(
        &self,
        (scene, gesture): (&'a Scene, Option<&'a ShownGesture>),
        simd: SimdLevel,
        (strip, style, cancel): (&'a Strip, &'a Style, &'a Cancel),
    ) -> FrameContext<'a> {
        let is_density = style.shading != Shading::Color;
        FrameContext {
            scene,
            gesture,
            strip,
            view: strip.view(),
            transform: SnappedTransform::new(strip.view()),
            style,
            cancel,
            own_widths: self.own_widths,
            simd,
            solid: self.solid.filter(|_| !is_density),
            inset_for_zoom: None,
        }
    }
}

impl PreparedClusters {
    /// Sorts the paths of a scene into clusters. All threads share the work.
    ///
    /// Curves of one cluster are drawn as one where they go on from each other, so pictures depend
    /// on the clusters. Rows in Hilbert order are not sorted again: then a part of a file, which
    /// has whole clusters, gives the bits of all of it.
    pub(crate) fn new(scene: &Scene) -> Self {
        let hulls = scene.hulls();
        let center = |row: usize| hulls.of([row]).map(Bounds::center);
        let order = match scene.layout().paths.is_hilbert_ordered() {
            true => ClusterOrder::of_sorted_rows(hulls.len()),
            false => ClusterOrder::sorted(hulls.len(), hulls.all(), center),
        };
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

    /// Begins a gesture: paths that share a cluster with others get clusters of their own.
    pub(crate) fn begin_gesture(
        &mut self,
        scene: &Scene,
        paths: GesturePaths,
        rows: &[u32],
    ) -> ShownGesture {
        let (hulls, clusters) = (SceneHulls(scene), self.index.order().cluster_count());
        let members = self.index.order().members_by_cluster(rows);
        let is_whole = |&(cluster, members): &(u32, Members)| {
            let of_cluster = self.index.rows_of(cluster).iter().enumerate();
            let mut others = of_cluster.filter(|(member, _)| members >> member & 1 == 0);
            others.all(|(_, &row)| scene.state(row) != PathState::Shown)
        };
        let (whole, parts): (Vec<_>, Vec<_>) = members.into_par_iter().partition(is_whole);
        let mut is_split = Vec::new();
        let mut split = Vec::new();
        if !parts.is_empty() {
            is_split.resize(scene.row_count(), false);
        }
        for &(cluster, members) in &parts {
            let of_cluster = self.index.rows_of(cluster).iter().enumerate();
            split.extend(of_cluster.filter_map(|(i, &row)| (members >> i & 1 == 1).then_some(row)));
            self.cache.states[cluster as usize].invalidate();
        }
        split.iter().for_each(|&row| is_split[row as usize] = true);
        let own = self.index.append_copies(split, |rows| hulls.hull(rows));
        self.cache.grow(self.index.order().cluster_count());
        let mapped = whole.iter().map(|(cluster, _)| *cluster).chain(own);
        let bounds = self.index.bounds();
        let at_rest = mapped.filter_map(|at| Some((at, bounds[at as usize]?)));
        let shown = rows
            .par_iter()
            .filter(|&&row| scene.state(row) == PathState::Shown);
        ShownGesture {
            paths,
            by: Affine::IDENTITY,
            shift_m: Point::default(),
            moves_all: shown.count() == scene.shown_count(),
            at_rest: at_rest.collect(),
            is_split,
            thinned: parts.iter().map(|(cluster, _)| *cluster).collect(),
            clusters,
        }
    }

    /// Shows the paths of a gesture where a map leaves them. Returns the boxes, in meters, where
    /// their clusters were and are.
    pub(crate) fn map_gesture(
        &mut self,
        gesture: &mut ShownGesture,
        by: Affine,
    ) -> Vec<Bounds<f64>> {
        let (shift_m, by) = gesture.split(by);
        gesture.shift_m = shift_m;
        if by == gesture.by {
            return Vec::new();
        }
        let keeps_lines = gesture.by.x == by.x && gesture.by.y == by.y;
        gesture.by = by;
        let mut changed = Vec::with_capacity(2 * gesture.at_rest.len());
        for (cluster, at_rest) in &gesture.at_rest {
            let after = at_rest.shown(by);
            let before = self.index.bounds()[*cluster as usize];
            changed.extend(before.map(|before| before.bounds));
            changed.push(after.bounds);
            self.index.set_bounds(*cluster, after);
            if !keeps_lines {
                self.cache.states[*cluster as usize].invalidate();
            }
        }
        changed
    }

    /// Ends a gesture: the clusters are as before. Returns the boxes, in meters, where those of the
    /// gesture were and are.
    pub(crate) fn end_gesture(&mut self, mut gesture: ShownGesture) -> Vec<Bounds<f64>> {
        let mut changed = self.map_gesture(&mut gesture, Affine::IDENTITY);
        changed.extend(self.boxes_of(&gesture.thinned));
        for (cluster, at_rest) in &gesture.at_rest {
            self.index.set_bounds(*cluster, *at_rest);
        }
        for cluster in &gesture.thinned {
            self.cache.states[*cluster as usize].invalidate();
        }
        self.index.drop_copies();
        self.cache.truncate(gesture.clusters);
        changed
    }

    /// The boxes, in meters, of some clusters.
    pub(crate) fn boxes_of(&self, clusters: &[u32]) -> Vec<Bounds<f64>> {
        let bounds = clusters
            .iter()
            .filter_map(|&at| self.index.bounds()[at as usize]);
        bounds.map(|cluster| cluster.bounds).collect()
    }

    /// The boxes, in meters, of the clusters of some paths.
    pub(crate) fn bounds_of(&self, paths: &[u32]) -> Vec<Bounds<f64>> {
        let clusters = self.index.order().members_by_cluster(paths).into_iter();
        let bounds = clusters.filter_map(|(cluster, _)| self.index.bounds()[cluster as usize]);
        bounds.map(|cluster| cluster.bounds).collect()
    }
}
