//! Losses of the VDA 5050 writer: the parts of a layout that an order does not hold, or holds in
//! another form.

use std::collections::HashSet;

use guideway_layout::{Attributes, Direction};

use super::objects::{Objects, Part};
use crate::Losses;
use crate::losses::common_losses;

/// Lists the losses, after all objects were written.
pub(super) fn losses(objects: &Objects<'_, '_>) -> Losses {
    let (layout, route) = (objects.layout, objects.route);
    let mut losses = common_losses(layout);
    let between = (0..route.edges.len()).filter(|&edge| route.is_between_maps(edge));
    let between: HashSet<usize> = between.map(|edge| route.edges[edge].row).collect();
    let detail = "paths between maps: readers treat them as lifts and do not draw them";
    losses.add("paths", between.len(), detail);
    losses.add("refused paths", between.len(), detail);
    losses.add_stations(layout);
    losses.add_blocks(layout);
    losses.add_groups(layout);
    let rows = route.edges.iter().map(|edge| edge.row);
    let rows: Vec<usize> = rows.filter(|row| !between.contains(row)).collect();
    add_styles(objects, &rows, &mut losses);
    add_network(objects, &rows, &mut losses);
    let scaled = rows
        .iter()
        .filter(|&&row| objects.trajectories.is_rewritten(row));
    let detail = "curves: written with knots from 0 to 1";
    losses.add("curves", scaled.count(), detail);
    add_levels(objects, &rows, &mut losses);
    add_columns(objects, Part::Paths, &rows, &mut losses);
    let of_types = layout.paths.vehicle_types();
    let entries = rows.iter().flat_map(|&row| of_types.entries(row));
    let entries: Vec<usize> = entries.collect();
    for column in of_types.attributes.iter() {
        let values = entries
            .iter()
            .filter(|&&entry| column.values.get(entry).is_some());
        let detail = "values of vehicle types on paths: those of the first type are written";
        losses.add(format!("column {}", column.name), values.count(), detail);
    }
    let nodes = route.places.iter().filter(|place| !place.is_repeated);
    let nodes: Vec<usize> = nodes.filter_map(|place| place.node).collect();
    add_columns(objects, Part::Nodes, &nodes, &mut losses);
    let columns = layout.attributes.iter();
    let all = columns
        .filter(|column| column.values.get(0).is_some())
        .count();
    let held = objects
        .held
        .iter()
        .filter(|((part, _), _)| *part == Part::Layout);
    let detail = "properties of the layout as a whole";
    losses.add("layout properties", all - held.count(), detail);
    losses
}

/// Adds widths, colors and draw ranks.
fn add_styles(objects: &Objects<'_, '_>, rows: &[usize], losses: &mut Losses) {
    let paths = &objects.layout.paths;
    let styles = || rows.iter().map(|&row| paths.own_style(row));
    let widths = styles().filter(|style| style.width_m.is_some());
    losses.add("widths", widths.count(), "widths of paths");
    let colors = styles().filter(|style| style.color_rgba.is_some());
    losses.add("colors", colors.count(), "colors of paths");
    let ranks = paths.rank().unwrap_or_default();
    let ranks = rows
        .iter()
        .filter(|&&row| ranks.get(row).is_some_and(|&rank| rank != 0));
    losses.add("draw ranks", ranks.count(), "draw ranks of paths");
}

/// Adds nodes, path ends, directions and vehicle types.
fn add_network(objects: &Objects<'_, '_>, rows: &[usize], losses: &mut Losses) {
    let (layout, route) = (objects.layout, objects.route);
    let passed: HashSet<usize> = route.places.iter().filter_map(|place| place.node).collect();
    let left_out = layout.nodes.len() - passed.len();
    losses.add("nodes", left_out, "nodes that the route does not pass");
    let new = route.places.iter().filter(|place| place.node.is_none());
    let detail = "new nodes: written at path ends without a node";
    losses.add("nodes", new.count(), detail);
    let detail = "nodes with a repeated name: written with a number at the end";
    losses.add("nodes", route.renamed, detail);
    let paths = || rows.iter().map(|&row| layout.paths.get(row));
    let ends = paths().flat_map(|path| [path.start_node(), path.end_node()]);
    let detail = "path ends without a node: written with one";
    losses.add("ends", ends.filter(Option::is_none).count(), detail);
    let both = paths().filter(|path| path.direction() == Direction::Both);
    let detail = "two-way paths: written in the direction of the route";
    losses.add("directions", both.count(), detail);
    let types = layout.paths.vehicle_types();
    let limited = rows.iter().filter(|&&row| types.of(row).len() > 0);
    let detail = "paths for certain vehicle types: the types";
    losses.add("vehicle types", limited.count(), detail);
    let types = layout.nodes.vehicle_types();
    let limited = passed.iter().filter(|&&node| types.of(node).len() > 0);
    let detail = "nodes with properties of vehicle types: the properties";
    losses.add("vehicle types", limited.count(), detail);
}

/// Adds the levels that are no maps of the order, and what maps do not hold.
fn add_levels(objects: &Objects<'_, '_>, rows: &[usize], losses: &mut Losses) {
    let (layout, route) = (objects.layout, objects.route);
    let id = |level: Option<u32>| Some(layout.levels.get(level? as usize)?.id.as_str());
    let places = route.places.iter().filter(|place| !place.is_repeated);
    let moved = places.filter(|place| {
        let node = place.node.map(|node| node as u32);
        node.is_some_and(|node| id(layout.nodes.level(node)) != place.map)
    });
    losses.add("levels", moved.count(), "nodes that are on another map");
    let moved = route.edges.iter().enumerate().filter(|(i, edge)| {
        let maps = [&route.places[*i], &route.places[i + 1]].map(|place| place.map);
        let level = layout.paths.get(edge.row).level();
        rows.contains(&edge.row) && id(level) != maps[0].or(maps[1])
    });
    losses.add("levels", moved.count(), "paths that are on another map");
    let maps: HashSet<&str> = route.places.iter().filter_map(|place| place.map).collect();
    let mut seen = HashSet::new();
    let is_written = |id: &str| maps.contains(id);
    let lost = layout.levels.iter().filter(|level| {
        let is_first = seen.insert(level.id.as_str());
        let has_more = level.name.is_some() || level.elevation_m.is_some();
        has_more || !is_first || !is_written(&level.id)
    });
    let detail = "levels: unused ones, and names and elevations";
    losses.add("levels", lost.count(), detail);
    let is_any_written = layout.levels.iter().any(|level| is_written(&level.id));
    for (i, level) in layout.levels.iter().enumerate() {
        let is_compared = match is_any_written {
            true => is_written(&level.id),
            false => i < maps.len(),
        };
        if is_compared {
            losses.add_columns(&level.attributes, "levels", |_| false);
        }
    }
}

/// Adds the values of columns that a reader does not get back.
fn add_columns(objects: &Objects<'_, '_>, part: Part, rows: &[usize], losses: &mut Losses) {
    let (attributes, of): (&Attributes, _) = match part {
        Part::Nodes => (&objects.layout.nodes.attributes, "nodes"),
        Part::Paths => (&objects.layout.paths.attributes, "paths"),
        Part::Layout => return,
    };
    for column in attributes.iter() {
        let values = rows.iter().filter(|&&row| column.values.get(row).is_some());
        let mut held = objects.held.iter();
        let held = held.find(|((of, name), _)| *of == part && *name == column.name);
        let held = held.map_or(0, |(_, count)| *count);
        let lost = values.count().saturating_sub(held);
        let detail = format!("values of {of} that the format cannot hold, or that change");
        losses.add(format!("column {}", column.name), lost, detail);
    }
}
