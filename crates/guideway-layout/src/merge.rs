//! Merge: joins several layouts into one.

use guideway_spline::Runs;

use crate::{Attributes, Diagnostics, Layout, Level, NewPath, Provenance, Value};

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
    fn add(&mut self, mut other: Layout) {
        let levels = self.add_levels(&other.levels);
        let level = |level: Option<u32>| level.map(|level| levels[level as usize]);
        let all = &mut self.layout;
        let source = Value::Text(&other.provenance.source);
        let label = |attributes: &mut Attributes, first: usize, from: &Attributes, count: usize| {
            attributes.extend(first, from);
            for row in first..first + count {
                attributes.set(row, self.source, source);
            }
        };

        let first_node = all.nodes.len() as u32;
        for node in 0..other.nodes.len() as u32 {
            let nodes = &other.nodes;
            all.nodes.push(
                nodes.id(node),
                nodes.position_m(node),
                level(nodes.level(node)),
            );
        }
        let (nodes, first) = (&other.nodes, first_node as usize);
        label(
            &mut all.nodes.attributes,
            first,
            &nodes.attributes,
            nodes.len(),
        );
        let node = |node: u32| first_node + node;

        let first = all.stations.len();
        for station in 0..other.stations.len() as u32 {
            let stations = &other.stations;
            let nodes = stations.nodes(station).iter().map(|&n| node(n)).collect();
            let position_m = stations.position_m(station);
            let level = level(stations.level(station));
            all.stations
                .push(stations.id(station), position_m, nodes, level);
        }
        let stations = &other.stations;
        label(
            &mut all.stations.attributes,
            first,
            &stations.attributes,
            stations.len(),
        );

        let first = all.paths.len();
        let mut runs = Runs::default();
        for path in other.paths.iter() {
            path.copy_runs(&mut runs);
            let types: Vec<&str> = other.paths.vehicle_types().of(path.row()).collect();
            all.paths.push(&NewPath {
                id: path.id(),
                runs: &runs,
                start_node: path.start_node().map(node),
                end_node: path.end_node().map(node),
                direction: path.direction(),
                level: level(path.level()),
                vehicle_types: &types,
            });
        }
        let paths = &other.paths;
        label(
            &mut all.paths.attributes,
            first,
            &paths.attributes,
            paths.len(),
        );
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

/// Whether two levels have the same identifier or the same name.
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
