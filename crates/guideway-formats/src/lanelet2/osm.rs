//! The elements of an OSM file by their identifiers, positions in meters.

use std::collections::HashMap;

use guideway_layout::{Code, Place};
use guideway_spline::{Bounds, Point};
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

/// Whether the editor has marked an element as deleted; it is still in the file.
pub(super) fn is_deleted(element: Node<'_, '_>) -> bool {
    element.attribute("action") == Some("delete") || element.attribute("visible") == Some("false")
}

/// Where every node is, in meters; nodes without a sound position are not there.
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
    let sound = |p: &Point<f64>| p.is_finite() && is_lon_lat(*p);
    let all_degrees = found
        .iter()
        .filter_map(|(_, _, degrees)| degrees.filter(sound));
    let frame = Bounds::of_points(all_degrees).map(LocalProjection::centered_on);
    let mut positions = HashMap::with_capacity(found.len());
    for (node, local, degrees) in found {
        let at: PlaceFn<'_> = &|| xml.place(node);
        let projected = || Some(frame?.to_meters(degrees.filter(sound)?));
        let position = if is_local { local } else { projected() };
        let Some(position) = position else {
            let (code, message) = match degrees {
                Some(p) => (
                    Code::OutOfRange,
                    format!("longitude {} and latitude {} are not on Earth", p.x, p.y),
                ),
                None => (Code::MissingField, "there is no `lat` and `lon`".to_owned()),
            };
            let remedy = "What is drawn through it leaves it out; correct its position";
            builder.report(code, at, || message, remedy);
            continue;
        };
        if builder.check_point(position, at)
            && let Some(id) = node.attribute("id")
            && positions.insert(id, position).is_some()
        {
            let message = || format!("the node {id} is there more than once");
            builder.report(
                Code::DuplicateId,
                at,
                message,
                "The last one counts; remove the others",
            );
        }
    }
    if !is_local && frame.is_some() {
        let at: PlaceFn<'_> = &|| Place::element("the positions");
        let message = || {
            "longitude and latitude become meters about the middle of the map, true to scale there"
                .to_owned()
        };
        let remedy = "Nothing to do; with `local_x` and `local_y` at every node, those are drawn";
        builder.report(Code::AssumedUnit, at, message, remedy);
    }
    positions
}
