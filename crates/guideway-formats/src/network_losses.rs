//! Losses of formats that hold a network of straight edges: the parts of a layout for which such a
//! format has no place.

use std::ops::Range;

use guideway_layout::{Attributes, Direction, Layout, PathRef, TypeEntries, Value};

use crate::Losses;

impl Losses {
    /// Adds the vehicle types, and their properties per type, of the elements that are written.
    pub(crate) fn add_types(
        &mut self,
        types: &TypeEntries,
        is_written: impl Fn(usize) -> bool,
        (of, detail): (&str, &str),
    ) {
        let rows = (0..types.len()).filter(|&row| is_written(row));
        let limited: Vec<Range<usize>> = rows.map(|row| types.entries(row)).collect();
        let count = limited.iter().filter(|entries| !entries.is_empty()).count();
        self.add("vehicle types", count, format!("{of}: {detail}"));
        for column in types.attributes.iter() {
            let entries = limited.iter().cloned().flatten();
            let count = entries.filter(|&entry| column.values.get(entry).is_some());
            let what = format!("column {}", column.name);
            self.add(
                what,
                count.count(),
                format!("values of vehicle types of {of}"),
            );
        }
    }

    /// Adds widths, colors and draw ranks of the paths that are written.
    pub(crate) fn add_styles(&mut self, layout: &Layout, is_written: impl Fn(usize) -> bool) {
        let paths = &layout.paths;
        let rows = (0..paths.len()).filter(|&row| is_written(row));
        let styles: Vec<_> = rows.clone().map(|row| paths.own_style(row)).collect();
        let widths = styles.iter().filter(|style| style.width_m.is_some());
        self.add("widths", widths.count(), "widths of paths");
        let colors = styles.iter().filter(|style| style.color_rgba.is_some());
        self.add("colors", colors.count(), "colors of paths");
        let ranks = paths.rank().unwrap_or_default();
        let ranks = rows.filter(|&row| ranks.get(row).is_some_and(|&rank| rank != 0));
        self.add("draw ranks", ranks.count(), "draw ranks of paths");
    }

    /// Adds two-way paths among those that are written, as two edges.
    pub(crate) fn add_two_way(
        &mut self,
        layout: &Layout,
        is_written: impl Fn(&PathRef<'_>) -> bool,
    ) {
        let two_way = layout.paths.iter().filter(is_written);
        let two_way = two_way.filter(|path| path.direction() == Direction::Both);
        let detail = "two-way paths: written as two edges";
        self.add("directions", two_way.count(), detail);
    }

    /// Adds the values of columns that are not held.
    pub(crate) fn add_values(
        &mut self,
        attributes: &Attributes,
        detail: &str,
        is_lost: impl Fn(usize, &str, Value<'_>) -> bool,
    ) {
        for column in attributes.iter() {
            let is_lost = |row: &usize| {
                let value = column.values.get(*row);
                value.is_some_and(|value| is_lost(*row, &column.name, value))
            };
            let count = (0..column.values.len()).filter(is_lost).count();
            self.add(format!("column {}", column.name), count, detail);
        }
    }

    /// Adds everything but the paths and their own columns, for a drawing: nodes, stations,
    /// directions, vehicle types with their properties, levels, groups. A reader gives all paths
    /// the direction `read_as`.
    pub(crate) fn add_network_and_groups(&mut self, layout: &Layout, read_as: Direction) {
        self.add("nodes", layout.nodes.len(), "nodes");
        self.add_stations(layout);
        let drawn = || layout.paths.iter().filter(|path| path.runs().len() > 0);
        let changed = drawn().filter(|path| path.direction() != read_as);
        let detail = match read_as {
            Direction::Both => "one-way paths: a drawing has no directions",
            _ => "two-way paths: a drawing has no directions",
        };
        self.add("directions", changed.count(), detail);
        let types = layout.paths.vehicle_types();
        let limited = drawn().filter(|path| types.of(path.row()).len() > 0);
        let detail = "paths for certain vehicle types: the types";
        self.add("vehicle types", limited.count(), detail);
        self.add_columns(&types.attributes, "vehicle types on paths", |_| false);
        self.add(
            "levels",
            layout.levels.len(),
            "levels: written as groups of paths",
        );
        self.add_blocks(layout);
        self.add_groups(layout);
        let columns = layout.attributes.iter();
        let properties = columns.filter(|column| column.values.get(0).is_some());
        let detail = "properties of the layout as a whole";
        self.add("layout properties", properties.count(), detail);
    }

    /// Adds zones, the place on earth, and properties of vehicle types.
    pub(crate) fn add_groups(&mut self, layout: &Layout) {
        self.add("zones", layout.zones.len(), "zones");
        let has_origin = usize::from(layout.geo_origin.is_some());
        self.add("geo origin", has_origin, "the place of the layout on earth");
        let detail = "vehicle types: their own properties";
        self.add("vehicle types", layout.vehicle_types.len(), detail);
    }
}
