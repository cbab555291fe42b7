//! Locates the elements that findings name, and the position of elements.

use guideway_layout::{Layout, Member, Origin, Place};
use guideway_spline::Bounds;

use crate::document::Document;
use crate::element::Element;

/// The path, node or station that a finding is about: by its row, else by identifier or number.
/// `None` for a place in a file.
pub fn locate(layout: &Layout, place: &Place) -> Option<Element> {
    located(place).or_else(|| named(layout, place))
}

/// The path, node or station whose row a finding knows.
pub fn located(place: &Place) -> Option<Element> {
    match place.origin? {
        Origin::Member(Member::Path(row)) => Some(Element::Path(row)),
        Origin::Member(Member::Node(row)) => Some(Element::Node(row)),
        Origin::Member(Member::Station(row)) => Some(Element::Station(row)),
        Origin::Byte(_) => None,
    }
}

fn named(layout: &Layout, place: &Place) -> Option<Element> {
    let (kind, rest) = place.element.split_once(' ')?;
    let (count, element): (usize, fn(u32) -> Element) = match kind {
        "path" => (layout.paths.len(), Element::Path),
        "node" => (layout.nodes.len(), Element::Node),
        "station" => (layout.stations.len(), Element::Station),
        _ => return None,
    };
    let row = if let Some(number) = rest.strip_prefix("number ") {
        number.parse::<usize>().ok()?.checked_sub(1)?
    } else {
        let id = rest.strip_prefix('"')?.strip_suffix('"')?;
        (0..count).find(|&row| element(row as u32).id(layout) == id)?
    };
    (row < count).then(|| element(row as u32))
}

impl Document {
    /// Returns `true` if an element exists and is not removed.
    pub fn contains(&self, element: Element) -> bool {
        let (of, row) = element.table_row();
        self.scene.exists(of, row)
    }

    /// Bounding box of an element, in meters; `None` for one that has no row, for a path without a
    /// curve and for a station without a position.
    pub fn bounds_of(&self, element: Element) -> Option<Bounds<f64>> {
        let (of, row) = element.table_row();
        if row as usize >= of.row_count(self.layout()) {
            return None;
        }
        let at = match element {
            Element::Path(path) => return self.index.path_bounds(path),
            Element::Node(node) => self.node_position_m(node),
            Element::Station(station) => self.station_position_m(station)?,
        };
        Some(Bounds { min: at, max: at })
    }
}
