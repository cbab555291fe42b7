//! Differences of paths: curves, references, directions, vehicle types, columns and styles.

use std::collections::BTreeSet;

use guideway_spline::Point;

use super::columns::{compare_cells, names};
use super::curve_distance::are_near;
use super::difference::{CompareOptions, Differences};
use super::element_pairs::level_id;
use super::row_pairs::RowPairs;
use crate::{Layout, PathRef};

/// Compares the paths of two layouts.
pub(super) fn compare(
    layouts: [&Layout; 2],
    pairs: &RowPairs,
    nodes: &RowPairs,
    options: &CompareOptions,
    found: &mut Differences,
) {
    let [a, b] = layouts;
    for row in pairs.removed() {
        found.add("paths", || {
            format!("path `{}` is lost", a.paths.id(row as usize))
        });
    }
    for &row in pairs.added() {
        found.add("new paths", || {
            format!("path `{}` is new", b.paths.id(row as usize))
        });
    }
    if a.refused.len() != b.refused.len() {
        found.add("refused paths", || {
            format!("{} instead of {}", b.refused.len(), a.refused.len())
        });
    }
    let columns = Columns::of(layouts);
    for (row_a, row_b) in pairs.pairs() {
        let pair = Pair {
            layouts,
            paths: [a.paths.get(row_a as usize), b.paths.get(row_b as usize)],
        };
        if pairs.is_by_order() {
            let [old, new] = pair.paths.map(PathRef::id);
            found.add("identifiers", || format!("path `{old}` is now `{new}`"));
        }
        pair.compare_geometry(options, found);
        pair.compare_network(nodes, found);
        pair.compare_columns(&columns, options, found);
        pair.compare_styles(found);
    }
}

/// Returns `true` if the curves of a row of both layouts have the same ends, in either direction,
/// or one has none.
pub(super) fn keeps_place([a, b]: [&Layout; 2], row: usize, within_m: f64) -> bool {
    let are_near = |p: [Point<f64>; 2], q: [Point<f64>; 2]| {
        let mut distances = p.iter().zip(q).map(|(p, q)| p.distance(q));
        distances.all(|distance_m| distance_m <= within_m)
    };
    match (a.paths.get(row).ends(), b.paths.get(row).ends()) {
        (Some((start, end)), Some((from, to))) => {
            are_near([start, end], [from, to]) || are_near([start, end], [to, from])
        }
        _ => true,
    }
}

/// Names of the columns of both tables.
struct Columns<'a> {
    of_paths: BTreeSet<&'a str>,
    per_type: BTreeSet<&'a str>,
}

impl<'a> Columns<'a> {
    fn of([a, b]: [&'a Layout; 2]) -> Self {
        let per_type = |layout: &'a Layout| &layout.paths.vehicle_types().attributes;
        Self {
            of_paths: names(&[&a.paths.attributes, &b.paths.attributes]),
            per_type: names(&[per_type(a), per_type(b)]),
        }
    }
}

/// The same path in two layouts.
struct Pair<'a> {
    layouts: [&'a Layout; 2],
    paths: [PathRef<'a>; 2],
}

impl Pair<'_> {
    fn name(&self) -> String {
        format!("path `{}`", self.paths[0].id())
    }

    fn compare_geometry(&self, options: &CompareOptions, found: &mut Differences) {
        let [p, q] = self.paths;
        if !are_near(p, q, options.tolerance_m) {
            let tolerance_m = options.tolerance_m;
            found.add("curves", || {
                format!("{} differs by over {tolerance_m} m", self.name())
            });
        }
        let [a, b] = self.layouts;
        match (
            a.paths.written_curve(p.row()),
            b.paths.written_curve(q.row()),
        ) {
            (None, Some(_)) => found.add("new curves", || {
                format!("{} is written as a curve of its own", self.name())
            }),
            (before, after) if before != after => found.add("curves", || {
                format!("{} is written as another curve", self.name())
            }),
            _ => {}
        }
    }

    fn compare_network(&self, nodes: &RowPairs, found: &mut Differences) {
        let [p, q] = self.paths;
        let ends = |path: PathRef<'_>| [path.start_node(), path.end_node()];
        let expected = ends(p).map(|node| node.map(|node| nodes.partner(node)));
        if expected != ends(q).map(|node| node.map(Some)) {
            found.add("ends", || format!("{} has other nodes", self.name()));
        }
        if p.direction() != q.direction() {
            let [before, after] = self.paths.map(PathRef::direction);
            found.add("directions", || {
                format!("{}: {after:?} was {before:?}", self.name())
            });
        }
        let [before, after] = self.level_ids();
        if before != after {
            found.add("levels", || {
                format!("{} is on {after:?} instead of {before:?}", self.name())
            });
        }
        let [before, after] = self.vehicle_types();
        if before != after {
            found.add("vehicle types", || {
                format!("{} is for {after:?} instead of {before:?}", self.name())
            });
        }
    }

    fn level_ids(&self) -> [Option<&str>; 2] {
        [0, 1].map(|i| level_id(self.layouts[i], self.paths[i].level()))
    }

    fn vehicle_types(&self) -> [BTreeSet<&str>; 2] {
        let types = |i: usize| {
            let types = self.layouts[i].paths.vehicle_types();
            types.of(self.paths[i].row()).collect()
        };
        [types(0), types(1)]
    }

    fn compare_columns(
        &self,
        columns: &Columns<'_>,
        options: &CompareOptions,
        found: &mut Differences,
    ) {
        let [a, b] = self.layouts.map(|layout| &layout.paths);
        let [p, q] = self.paths.map(PathRef::row);
        for name in &columns.of_paths {
            let cells = [a.attributes.value(p, name), b.attributes.value(q, name)];
            compare_cells(cells, name, || self.name(), options, found);
        }
        let [types, _] = self.vehicle_types();
        for name in &columns.per_type {
            for &vehicle_type in &types {
                let cells = [
                    a.value_for(p, vehicle_type, name),
                    b.value_for(q, vehicle_type, name),
                ];
                let element = || format!("{} for `{vehicle_type}`", self.name());
                compare_cells(cells, name, element, options, found);
            }
        }
    }

    fn compare_styles(&self, found: &mut Differences) {
        let [p, q] = self.paths.map(PathRef::row);
        let [a, b] = self.layouts.map(|layout| &layout.paths);
        let [before, after] = [a.own_style(p), b.own_style(q)];
        if before.width_m != after.width_m {
            found.add(
                if before.width_m.is_none() {
                    "new widths"
                } else {
                    "widths"
                },
                || self.name(),
            );
        }
        if before.color_rgba != after.color_rgba {
            let is_new = before.color_rgba.is_none();
            found.add(if is_new { "new colors" } else { "colors" }, || self.name());
        }
        let rank = |column: Option<&[i32]>, row: usize| column.map_or(0, |ranks| ranks[row]);
        if rank(a.rank(), p) != rank(b.rank(), q) {
            found.add("draw ranks", || self.name());
        }
    }
}
