use guideway_layout::{Layout, Place};
use guideway_spline::Bounds;

use crate::{Document, Element};

/// What a finding of [`guideway_layout::check`] is about: the path, node or station of the name that its place
/// gives, or of the number where it has no name. None for a place in a file.
pub fn locate(layout: &Layout, place: &Place) -> Option<Element> {
    let (kind, rest) = place.element.split_once(' ')?;
    let (count, of): (usize, fn(u32) -> Element) = match kind {
        "path" => (layout.paths.len(), Element::Path),
        "node" => (layout.nodes.len(), Element::Node),
        "station" => (layout.stations.len(), Element::Station),
        _ => return None,
    };
    let row = if let Some(number) = rest.strip_prefix("number ") {
        number.parse::<usize>().ok()?.checked_sub(1)?
    } else {
        let id = rest.strip_prefix('"')?.strip_suffix('"')?;
        (0..count).find(|&row| of(row as u32).id(layout) == id)?
    };
    (row < count).then(|| of(row as u32))
}

impl Document {
    /// Where something is; none if it is nowhere.
    pub fn bounds_of(&self, what: Element) -> Option<Bounds<f64>> {
        let spot = match what {
            Element::Path(path) => return self.index.path_bounds(path),
            Element::Node(node) => self.node_position_m(node),
            Element::Station(station) => self.station_position_m(station)?,
        };
        Some(Bounds {
            min: spot,
            max: spot,
        })
    }
}
