//! [`pick_element`]: the station, node or path at a pixel of a picture.

use guideway_scene::{LineRule, Scene, Table, View};
use guideway_spline::{Bounds, Point};

use crate::element::Element;
use crate::index::Index;
use crate::pick::pick;

/// The element at a pixel of a view, within `reach_px` pixels: a station, then a node, then a path.
/// See [`pick`] for paths and `max_candidates`.
pub fn pick_element(
    (scene, index): (&Scene, &Index),
    line_rule: LineRule,
    view: &View,
    pixel: Point<f64>,
    reach_px: f64,
    max_candidates: usize,
) -> Option<Element> {
    let point_m = view.world_from_pixel(pixel);
    let scale = view.px_per_m();
    node_or_station((scene, index), point_m, reach_px / scale, max_candidates).or_else(|| {
        let place = (scene, index);
        let hit = pick(place, line_rule, scale, point_m, reach_px, max_candidates)?;
        Some(Element::Path(hit.path))
    })
}

/// The nearest node within reach, or its station.
fn node_or_station(
    (scene, index): (&Scene, &Index),
    point_m: Point<f64>,
    reach_m: f64,
    max_candidates: usize,
) -> Option<Element> {
    let layout = scene.layout();
    let spot = Bounds {
        min: point_m,
        max: point_m,
    };
    let distance_m = |node: &u32| layout.nodes.position_m(*node).distance(point_m);
    let near = index.nodes_in(spot.inflated(reach_m));
    let near = near.filter(|node| scene.shows_level(Table::Nodes.level(layout, *node)));
    let node = near
        .take(max_candidates)
        .min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)));
    let node = node.filter(|node| distance_m(node) <= reach_m)?;
    let station = index.stations_at(node).next();
    Some(station.map_or(Element::Node(node), Element::Station))
}
