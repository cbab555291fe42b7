//! Merge: joins several layouts into one.

use guideway_spline::Runs;

use crate::{
    Attributes, Diagnostics, Layout, Level, NewPath, Nodes, Paths, Provenance, Stations, Value,
};

/// Names for the column with the source of each row; the first one that no input uses applies.
const SOURCE: [&str; 2] = ["source", "source_file"];

/// Merges layouts in their order: at equal rank, paths of later layouts cover those of earlier
/// ones.
///
/// Identifiers do not change, even if several layouts use the same; paths refer to the nodes of
/// their own layout. Levels of different layouts with the same identifier or name become one. The
/// column `source` of paths, nodes and stations states [`Provenance::source`]. Columns of the same
/// name become one, in the narrowest type that can represent all values. A single layout is
/// returned unchanged.
pub fn merge(layouts: Vec<Layout>) -> Layout {
    let layouts = match <[Layout; 1]>::try_from(layouts) {
        Ok([one]) => return one,
        Err(layouts) => layouts,
    };
    let has_column = |name: &str| layouts.iter().any(|layout| layout.has_column(name));
    let source = SOURCE.into_iter().find(|name| !has_column(name));
    let mut merged = Merged {
        layout: Layout {
            provenance: provenance(&layouts),
            diagnostics: Diagnostics::default(),
            ..Layout::default()
        },
        source: source.unwrap_or(SOURCE[0]),
        styles: Styles::default(),
    };
    for layout in layouts {
        merged.add(layout);
    }
    merged.finish()
}

/// The merge of the layouts so far.
struct Merged {
    layout: Layout,
    source: &'static str,
    styles: Styles,
}

/// The optional columns of paths.
#[derive(Default)]
struct Styles {
    width_m: Vec<f32>,
    color_rgba: Vec<u32>,
    rank: Vec<i32>,
}

impl Merged {
    /// Appends all elements of a layout; their references keep pointing to their own elements.
    fn add(&mut self, mut other: Layout) {
        let offsets = Offsets {
            levels: self.add_levels(&other.levels),
            first_node: self.layout.nodes.len() as u32,
        };
        let source = (self.source, other.provenance.source.as_str());
        let all = &mut self.layout;
        add_nodes(&mut all.nodes, &other.nodes, &offsets, source);
        add_stations(&mut all.stations, &other.stations, &offsets, source);
        add_paths(&mut all.paths, &other.paths, &offsets, source);
        self.styles.add(&other);
        for refused in other.refused.iter() {
            all.refused.push(refused.id, refused.code, refused.detail);
        }
        all.diagnostics
            .append(std::mem::take(&mut other.diagnostics));
    }

    /// Adds the new levels of another layout and returns the merged row of each. Levels of one
    /// layout stay separate, even if they have the same name.
    fn add_levels(&mut self, others: &[Level]) -> Vec<u32> {
        let known = self.layout.levels.len();
        let levels = &mut self.layout.levels;
        let row = |level: &Level| {
            let same = levels[..known].iter().position(|l| is_same(l, level));
            let row = same.unwrap_or_else(|| {
                levels.push(level.clone());
                levels.len() - 1
            });
            let elevation_m = &mut levels[row].elevation_m;
            *elevation_m = elevation_m.or(level.elevation_m);
            row as u32
        };
        others.iter().map(row).collect()
    }

    fn finish(self) -> Layout {
        let (mut layout, styles) = (self.layout, self.styles);
        let paths = &mut layout.paths;
        if styles.width_m.iter().any(|w| !w.is_nan()) {
            paths.set_width_m(styles.width_m);
        }
        if styles.color_rgba.iter().any(|&c| c != 0) {
            paths.set_color_rgba(styles.color_rgba);
        }
        if styles.rank.iter().any(|&r| r != 0) {
            paths.set_rank(styles.rank);
        }
        layout
    }
}

/// Maps the rows of one layout to those of the merge.
struct Offsets {
    /// Merged row of each level.
    levels: Vec<u32>,
    /// Merged row of the first node.
    first_node: u32,
}

impl Offsets {
    fn level(&self, level: Option<u32>) -> Option<u32> {
        level.map(|level| self.levels[level as usize])
    }

    fn node(&self, node: u32) -> u32 {
        self.first_node + node
    }
}

fn add_nodes(all: &mut Nodes, other: &Nodes, offsets: &Offsets, source: (&str, &str)) {
    let first = all.len();
    for node in 0..other.len() as u32 {
        let level = offsets.level(other.level(node));
        all.push(other.id(node), other.position_m(node), level);
    }
    let attributes = &mut all.attributes;
    add_attributes(attributes, first, &other.attributes, other.len(), source);
}

fn add_stations(all: &mut Stations, other: &Stations, offsets: &Offsets, source: (&str, &str)) {
    let first = all.len();
    for station in 0..other.len() as u32 {
        let nodes = other.nodes(station).iter();
        let nodes = nodes.map(|&node| offsets.node(node)).collect();
        let level = offsets.level(other.level(station));
        all.push(other.id(station), other.position_m(station), nodes, level);
    }
    let attributes = &mut all.attributes;
    add_attributes(attributes, first, &other.attributes, other.len(), source);
}

fn add_paths(all: &mut Paths, other: &Paths, offsets: &Offsets, source: (&str, &str)) {
    let first = all.len();
    let node = |node: Option<u32>| node.map(|node| offsets.node(node));
    let mut runs = Runs::default();
    for path in other.iter() {
        path.copy_runs(&mut runs);
        let types: Vec<&str> = other.vehicle_types().of(path.row()).collect();
        all.push(&NewPath {
            id: path.id(),
            runs: &runs,
            start_node: node(path.start_node()),
            end_node: node(path.end_node()),
            direction: path.direction(),
            level: offsets.level(path.level()),
            vehicle_types: &types,
        });
    }
    let attributes = &mut all.attributes;
    add_attributes(attributes, first, &other.attributes, other.len(), source);
}

/// Appends the attributes of `rows` rows, and sets the column of the source for them.
fn add_attributes(
    all: &mut Attributes,
    first: usize,
    other: &Attributes,
    rows: usize,
    (column, source): (&str, &str),
) {
    all.extend(first, other);
    for row in first..first + rows {
        all.set(row, column, Value::Text(source));
    }
}

impl Styles {
    fn add(&mut self, layout: &Layout) {
        fn extend<T: Copy>(all: &mut Vec<T>, own: Option<&[T]>, none: T, rows: usize) {
            match own {
                Some(own) => all.extend_from_slice(own),
                None => all.extend(std::iter::repeat_n(none, rows)),
            }
        }
        let (paths, rows) = (&layout.paths, layout.paths.len());
        extend(&mut self.width_m, paths.width_m(), f32::NAN, rows);
        extend(&mut self.color_rgba, paths.color_rgba(), 0, rows);
        extend(&mut self.rank, paths.rank(), 0, rows);
    }
}

impl Layout {
    fn has_column(&self, name: &str) -> bool {
        let tables = [
            &self.paths.attributes,
            &self.nodes.attributes,
            &self.stations.attributes,
        ];
        tables.into_iter().any(|table| table.get(name).is_some())
    }
}

/// Returns `true` if two levels have the same identifier or the same name.
fn is_same(a: &Level, b: &Level) -> bool {
    a.id == b.id || a.name.is_some() && a.name == b.name
}

/// Provenance of several sources: each distinct name once, and the sums of the counts.
fn provenance(layouts: &[Layout]) -> Provenance {
    let of = |part: fn(&Provenance) -> &str, separator: &str| {
        let mut parts: Vec<&str> = Vec::new();
        for layout in layouts {
            let part = part(&layout.provenance);
            if !parts.contains(&part) {
                parts.push(part);
            }
        }
        parts.join(separator)
    };
    let mut counts: Vec<(String, u64)> = Vec::new();
    for (name, count) in layouts.iter().flat_map(|l| &l.provenance.counts) {
        match counts.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += count,
            None => counts.push((name.clone(), *count)),
        }
    }
    Provenance {
        source: of(|p| &p.source, ", "),
        format: of(|p| &p.format, " + "),
        format_version: of(|p| &p.format_version, " + "),
        counts,
        // A writer could copy the fields of one source only.
        text: None,
    }
}
