//! Hit tests: the end of a path, or the handle, under the pointer.

use guideway_document::decorations::{Handle, handles};
use guideway_document::{Document, Hit};
use guideway_scene::View;
use guideway_spline::Point;

/// Greatest distance between the pointer and what it hits, in pixels.
pub(crate) const HIT_RADIUS_PX: f64 = 8.0;
/// Most paths near the pointer for which hovering hits one: for more the exact test would take
/// longer than a frame. A click tests all.
pub(crate) const MAX_HOVER_CANDIDATES: usize = 3_000;

/// The end of the hit path that lies within `radius_m` of the hit.
pub(super) fn hit_end(document: &Document, hit: &Hit, radius_m: f64) -> Option<Point<f64>> {
    let (start, end) = document.layout().paths.get(hit.path as usize).ends()?;
    let distance_m = |end: &Point<f64>| end.distance(hit.point_m);
    let ends = [start, end].into_iter();
    ends.filter(|end| distance_m(end) <= radius_m)
        .min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))
}

/// The handle nearest to the pointer, within the hit radius.
pub(super) fn hit_handle(document: &Document, view: &View, at_px: Point<f64>) -> Option<Handle> {
    let all = handles(document, view).into_iter();
    let distances = all.map(|handle| (handle.at_px.distance(at_px), handle));
    let nearest = distances.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= HIT_RADIUS_PX).then_some(nearest.1)
}
