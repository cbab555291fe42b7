use guideway_layout::Layout;
use guideway_scene::Scene;
use guideway_spline::Bounds;
use rayon::prelude::*;

/// Paths, next to each other in draw order, that are culled together.
pub(super) const CLUSTER_PATHS: usize = 256;

/// Where each cluster of paths lies, in metres; nowhere if its paths have no points.
pub(super) fn cluster_bounds(scene: &Scene) -> Vec<Option<Bounds<f64>>> {
    let bounds = |paths: &[u32]| hull_bounds(scene.layout(), paths);
    scene
        .draw_order()
        .par_chunks(CLUSTER_PATHS)
        .map(bounds)
        .collect()
}

fn hull_bounds(layout: &Layout, paths: &[u32]) -> Option<Bounds<f64>> {
    let hulls = paths
        .iter()
        .filter_map(|&path| layout.paths.get(path as usize).hull_bounds());
    hulls.reduce(Bounds::union)
}

/// The paths of a cluster, by draw order.
pub(super) fn cluster_paths(scene: &Scene, cluster: u32) -> &[u32] {
    let rest = &scene.draw_order()[cluster as usize * CLUSTER_PATHS..];
    &rest[..rest.len().min(CLUSTER_PATHS)]
}
