//! Search: finds paths, nodes, stations, levels and vehicle types by a part of their identifier.

use guideway_layout::Layout;

use crate::element::Element;
use crate::group::Group;

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

/// Levels and vehicle types whose identifier or name contains `text`, ignoring case.
pub fn search_groups(layout: &Layout, text: &str) -> Vec<Group> {
    if text.is_empty() {
        return Vec::new();
    }
    let lowercase = text.to_lowercase();
    let contains = |name: &str| name.to_lowercase().contains(&lowercase);
    let levels = layout.levels.iter().zip(0..);
    let levels = levels.filter(|(l, _)| contains(&l.id) || l.name.as_deref().is_some_and(contains));
    let types = layout.vehicle_type_names().into_iter();
    let types = types.filter(|name| contains(name));
    levels
        .map(|(_, row)| Group::Level(row))
        .chain(types.map(|name| Group::VehicleType(name.to_owned())))
        .collect()
}
