//! Reads tags and node positions of an OSM file. Positions are in meters, projected about the
//! center of the map or taken from local coordinates.

use std::collections::HashMap;

use guideway_layout::{Code, Place};
use guideway_spline::Point;
use roxmltree::Node;

use crate::builder::{Builder, PlaceFn};
use crate::wgs84::{LocalProjection, is_lon_lat};
use crate::xml::{Xml, children};

/// The value of a tag of an element.
pub(super) fn tag<'d>(element: Node<'d, '_>, key: &str) -> Option<&'d str> {
    let mut tags = children(element, "tag");
    tags.find(|tag| tag.attribute("k") == Some(key))?
        .attribute("v")
}

/// Tells if the editor marked an element as deleted. Deleted elements stay in the file.
pub(super) fn is_deleted(element: Node<'_, '_>) -> bool {
    element.attribute("action") == Some("delete") || element.attribute("visible") == Some("false")
}

/// Position per node identifier, in meters. Uses `local_x` and `local_y` if all nodes have both,
/// else longitude and latitude. Omits and reports nodes without a valid position.
pub(super) fn positions<'d>(
    builder: &mut Builder<'_>,
    xml: &Xml<'_>,
    root: Node<'d, '_>,
) -> HashMap<&'d str, Point<f64>> {
    let number = |text: Option<&str>| text?.trim().parse::<f64>().ok();
    let mut found = Vec::new();
    let mut is_local = true;
    for node in children(root, "node").filter(|&node| !is_deleted(node)) {
        let local = || Some([number(tag(node, "local_x"))?, number(tag(node, "local_y"))?]);
        let degrees = || {
            Some([
                number(node.attribute("lon"))?,
                number(node.attribute("lat"))?,
            ])
        };
        let [local, degrees] = [local(), degrees()].map(|p| p.map(|[x, y]| Point::new(x, y)));
        is_local &= local.is_some();
        found.push((node, local, degrees));
    }
    let is_valid = |p: &Point<f64>| p.is_finite() && is_lon_lat(*p);
    let projection = LocalProjection::centered_on(|| {
        let degrees = found.iter().map(|(_, _, degrees)| *degrees);
        degrees.flatten().filter(is_valid)
    });
    if is_local {
        let stated: Vec<_> = found
            .iter()
            .filter_map(|(node, local, degrees)| Some((*node, (*local)?, *degrees)))
            .collect();
        report_far_nodes(builder, xml, &stated, projection);
    }
    let mut positions = HashMap::with_capacity(found.len());
    for (node, local, degrees) in found {
        let at: PlaceFn<'_> = &|| xml.place(node);
        let projected = || Some(projection?.to_meters(degrees.filter(is_valid)?));
        let position = if is_local { local } else { projected() };
        let Some(position) = position else {
            let (code, message) = match degrees {
                Some(p) => (
                    Code::OutOfRange,
                    format!("longitude {} or latitude {} is out of range", p.x, p.y),
                ),
                None => (Code::MissingField, "`lat` or `lon` is missing".to_owned()),
            };
            let remedy = "Ways are drawn without this node; correct its position";
            builder.report(code, at, || message, remedy);
            continue;
        };
        if builder.check_point(position, at)
            && let Some(id) = node.attribute("id")
            && positions.insert(id, position).is_some()
        {
            let message = || format!("the node {id} occurs more than once");
            let remedy = "The last one is used; remove the others";
            builder.report(Code::DuplicateId, at, message, remedy);
        }
    }
    if let Some(projection) = projection.filter(|_| !is_local) {
        builder.layout.geo_origin = Some(projection.origin());
        let at: PlaceFn<'_> = &|| Place::element("the positions");
        let message = || {
            "longitude and latitude are projected to meters about the center of the map, which is \
             true to scale there"
                .to_owned()
        };
        let remedy = "Nothing to do; give every node `local_x` and `local_y` to avoid this";
        builder.report(Code::AssumedUnit, at, message, remedy);
    }
    positions
}

/// Distance by which a node must be off to be reported, in meters. Local coordinates that begin
/// again at the border of a grid square are off by its size, 100 km.
const FAR_M: f64 = 50_000.0;

/// A node, its local position, and its degrees if it has them.
type PlacedNode<'d, 't> = (Node<'d, 't>, Point<f64>, Option<Point<f64>>);

/// Reports nodes whose local coordinates are far from those of most others: from where longitude
/// and latitude place them, or from the middle of the map if they have none.
fn report_far_nodes<'d, 't>(
    builder: &mut Builder<'_>,
    xml: &Xml<'_>,
    nodes: &[PlacedNode<'d, 't>],
    projection: Option<LocalProjection>,
) {
    let all_degrees = nodes.iter().all(|(_, _, degrees)| degrees.is_some());
    let expected = |degrees: Option<Point<f64>>| match (projection, degrees) {
        (Some(projection), Some(degrees)) if all_degrees => projection.to_meters(degrees),
        _ => Point::new(0.0, 0.0),
    };
    let offsets = nodes
        .iter()
        .map(|(_, local, degrees)| *local - expected(*degrees));
    let offsets: Vec<Point<f64>> = offsets.collect();
    let median = |axis: fn(&Point<f64>) -> f64| {
        let mut values: Vec<f64> = offsets.iter().map(axis).collect();
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or_default()
    };
    let middle = Point::new(median(|p| p.x), median(|p| p.y));
    for ((node, ..), offset) in nodes.iter().zip(&offsets) {
        let off_m = offset.distance(middle);
        if off_m > FAR_M {
            let at: PlaceFn<'_> = &|| xml.place(*node);
            let message = || {
                format!(
                    "its `local_x` and `local_y` are {:.0} km off those of the other nodes",
                    off_m / 1e3
                )
            };
            let remedy = "Use one origin for all nodes: local coordinates may have begun again at \
                          the border of an MGRS square, after 100 km";
            builder.report(Code::Implausible, at, message, remedy);
        }
    }
}
