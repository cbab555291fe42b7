//! Finds the path, node or station whose object in the file holds the place of a finding, such as
//! `layouts[0].edges[3].trajectory`, by their lines.

use std::cmp::Reverse;

use guideway::document::Element;
use guideway::layout::{Layout, LineIndex, Place, SourceSpans};

/// Names that formats have for a list of elements, and an element of it by its row.
type List = (&'static [&'static str], fn(u32) -> Element);

const LISTS: [List; 3] = [
    (&["edges[", "lanes["], Element::Path),
    (&["nodes[", "vertices["], Element::Node),
    (&["stations["], Element::Station),
];

/// The first line of each element of a file, in the order of [`LISTS`], sorted. Of elements that
/// begin on one line, the first one is the last one here.
pub(super) struct Holders([Vec<(u32, Reverse<u32>)>; 3]);

impl Holders {
    pub(super) fn of(layout: &Layout) -> Self {
        let text = layout.provenance.text.as_deref();
        let lines = text.map(LineIndex::new);
        let begins = |source: &SourceSpans, count: usize| {
            let line = |row| Some(source.position(row, lines.as_ref())?.line);
            let all = (0..count).filter_map(|row| Some((line(row)?, Reverse(row as u32))));
            let mut all: Vec<_> = all.collect();
            all.sort_unstable();
            all
        };
        Self([
            begins(&layout.paths.source, layout.paths.len()),
            begins(&layout.nodes.source, layout.nodes.len()),
            begins(&layout.stations.source, layout.stations.len()),
        ])
    }

    /// The element of the list that a place names which begins last at or before its line.
    pub(super) fn holder(&self, place: &Place) -> Option<Element> {
        let line = place.line?;
        let is_in = |names: &[&str]| names.iter().any(|name| place.element.contains(name));
        let list = LISTS.iter().position(|(names, _)| is_in(names))?;
        let begins = &self.0[list];
        let after = begins.partition_point(|(begin, _)| *begin <= line);
        let (_, Reverse(row)) = begins[..after].last()?;
        Some(LISTS[list].1(*row))
    }
}

#[cfg(test)]
mod tests {
    use guideway::layout::TextPosition;
    use guideway::spline::Point;

    use super::*;

    #[test]
    fn element_that_begins_last_before_a_line_holds_it() {
        let mut layout = Layout::default();
        for row in 0..4 {
            let node = layout.nodes.push("", Point::new(0.0, 0.0), None);
            let at = TextPosition::line([10, 20, 20, 30][row]);
            layout.nodes.source.set_position(node as usize, at);
        }
        let holders = Holders::of(&layout);
        let on_line = |list: &str, line| {
            let place = Place::on_line(format!("layouts[0].{list}[7].nodeId"), line);
            holders.holder(&place)
        };
        for (line, row) in [
            (9, None),
            (10, Some(0)),
            (19, Some(0)),
            (25, Some(1)),
            (99, Some(3)),
        ] {
            assert_eq!(on_line("nodes", line), row.map(Element::Node), "{line}");
        }
        assert_eq!(on_line("edges", 25), None);
        assert_eq!(on_line("origins", 25), None);
        assert_eq!(holders.holder(&Place::element("nodes[0]")), None);
    }
}
