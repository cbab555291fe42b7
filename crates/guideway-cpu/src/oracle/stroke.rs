//! A path as it is drawn.

use guideway_layout::PathRef;
use guideway_scene::{Rgba, View, density};
use guideway_spline::{Bounds, Point};

/// A path that may be visible.
pub(super) struct Stroke {
    pub(super) path: u32,
    pub(super) color: Rgba,
    pub(super) radius_px: f64,
    /// Bounding box of all that the path covers.
    pub(super) bounds_px: Bounds<f64>,
    /// Start and end, within the radius of which it counts half; `None` for a closed path.
    pub(super) ends_px: Option<[Point<f64>; 2]>,
}

/// Start and end of a path, by equation 3.2 of the thesis at t = 0; `None` for a closed path.
pub(super) fn open_ends(path: PathRef<'_>, view: &View) -> Option<[Point<f64>; 2]> {
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let ([a, b, c, _], [_, d, e, f]) = (segments.first()?, segments.last()?);
    let ends = [[a, b, c], [d, e, f]].map(|[a, b, c]| (*a + *b * 4.0 + *c) * (1.0 / 6.0));
    let is_open = ends[0].distance(ends[1]) > density::CLOSED_M;
    is_open.then(|| ends.map(|end| view.pixel_from_world(end)))
}
