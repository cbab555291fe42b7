//! Search: finds paths, nodes and stations by a part of their identifier.

use guideway_layout::Layout;

use crate::element::Element;

/// Number of rows of a table, and the constructor of its elements.
type Table = (usize, fn(u32) -> Element);

/// Nodes, stations and paths whose identifier contains `text`, ignoring case. Exact matches come
/// first. Returns at most `limit` exact and `limit` other matches per table.
pub fn search(layout: &Layout, text: &str, limit: usize) -> Vec<Element> {
    if text.is_empty() {
        return Vec::new();
    }
    let lowercase = text.to_lowercase();
    let tables: [Table; 3] = [
        (layout.nodes.len(), Element::Node),
        (layout.stations.len(), Element::Station),
        (layout.paths.len(), Element::Path),
    ];
    let tables = tables.map(|(count, element)| (0..count as u32).map(element));
    let is_exact = |element: &Element| element.id(layout) == text;
    let contains = |element: &Element| element.id(layout).to_lowercase().contains(&lowercase);
    let exact = tables
        .clone()
        .into_iter()
        .flat_map(|table| table.filter(is_exact).take(limit));
    let mut found: Vec<Element> = exact.collect();
    for table in tables {
        let others = table.filter(|element| contains(element) && !is_exact(element));
        found.extend(others.take(limit));
    }
    found
}
