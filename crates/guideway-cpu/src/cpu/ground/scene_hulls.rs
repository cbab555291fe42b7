//! Hulls of the shown paths of a scene, for the cluster index.

use guideway_scene::cluster::{MemberHull, RowHulls};
use guideway_scene::{PathState, Scene};
use guideway_spline::{Affine, Bounds};

/// A scene as the cluster index sees it: hidden paths have no hull.
pub(crate) struct SceneHulls<'a>(pub(crate) &'a Scene);

impl SceneHulls<'_> {
    /// Hull of the shown paths, from the stored hull of each, which are computed if unknown.
    pub(crate) fn stored_hull(&self, paths: &[u32]) -> MemberHull {
        self.0.hulls().of(self.shown(paths))
    }

    fn shown<'p>(&'p self, paths: &'p [u32]) -> impl Iterator<Item = usize> + Clone + 'p {
        let shown = paths.iter().copied();
        let shown = shown.filter(|&path| self.0.state(path) == PathState::Shown);
        shown.map(|path| path as usize)
    }
}

impl RowHulls for SceneHulls<'_> {
    fn hull(&self, paths: &[u32]) -> MemberHull {
        let geometry = self.0.layout().paths.geometry();
        // Edits keep known hulls up to date: a box is a fifth of the points of a usual path.
        if let Some(hulls) = geometry.known_hulls() {
            return hulls.of(self.shown(paths));
        }
        prefetch_paths(self.0, self.shown(paths));
        geometry.hull_bounds(self.shown(paths))
    }

    fn map_bounds(&self, bounds: Bounds<f64>, by: Affine) -> Bounds<f64> {
        self.0.layout().paths.geometry().mapped_bounds(bounds, by)
    }
}

/// Prefetches the control points of paths: they lie anywhere in memory, and their cache misses
/// overlap.
pub(crate) fn prefetch_paths(scene: &Scene, paths: impl Iterator<Item = usize>) {
    let geometry = scene.layout().paths.geometry();
    paths.for_each(|path| geometry.prefetch(path));
}
