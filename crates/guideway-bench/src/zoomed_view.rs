//! Computes a view from a scene and a zoom factor: the whole scene, or a part about its densest
//! point.

use std::collections::BTreeMap;

use guideway_scene::{FrameSize, RenderError, Scene, View};
use guideway_spline::{Bounds, Point};

/// The view of the whole scene, magnified `times`; above 1, it is centered on the densest point.
///
/// # Errors
/// When the view is out of range ([`View::fit`], [`View::new`]).
pub fn zoomed_view(size: FrameSize, scene: &Scene, times: f64) -> Result<View, RenderError> {
    let all = View::fit(size, scene.bounds())?;
    if times <= 1.0 {
        return View::new(size, all.center_m(), all.px_per_m() * times);
    }
    let center = densest_point(scene).unwrap_or(all.center_m());
    View::new(size, center, all.px_per_m() * times)
}

/// Splits the bounds of the scene into 16 x 16 cells, takes the cell with most path centers, and
/// returns the center nearest to their mean, so that the view always contains a path.
fn densest_point(scene: &Scene) -> Option<Point<f64>> {
    const PARTS: f64 = 16.0;
    let bounds = scene.bounds()?;
    let part = |at: f64, low: f64, extent: f64| {
        let along = (at - low) / extent.max(f64::MIN_POSITIVE) * PARTS;
        along.clamp(0.0, PARTS - 1.0) as usize
    };
    let hulls = scene
        .layout()
        .paths
        .iter()
        .filter_map(|path| path.hull_bounds());
    let mut parts: BTreeMap<(usize, usize), Vec<Point<f64>>> = BTreeMap::new();
    for middle in hulls.map(Bounds::center) {
        let column = part(middle.x, bounds.min.x, bounds.size().x);
        let row = part(middle.y, bounds.min.y, bounds.size().y);
        parts.entry((column, row)).or_default().push(middle);
    }
    let fullest = parts.into_values().max_by_key(Vec::len)?;
    let sum = fullest.iter().copied().reduce(|a, b| a + b)?;
    let mean = sum * (1.0 / fullest.len() as f64);
    let nearest = |a: &Point<f64>, b: &Point<f64>| a.distance(mean).total_cmp(&b.distance(mean));
    fullest.into_iter().min_by(nearest)
}
